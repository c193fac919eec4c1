// Lets a server show a mobility trace instead of a game that it simulates.
#pragma once

#include <utility>

#include "game/net/server/shared_play.h"
#include "loadgen/mobility/trace_follower.h"

namespace rink::loadgen {

/// For the server that `play` is handed to, somebody else plays; here that is a trace. All seats
/// are this server's, and keys change nothing.
class TracePlay : public game::SharedPlay {
 public:
  explicit TracePlay(MobilityTrace trace) : follower_(std::move(trace)) {}

  std::uint32_t first_player() const override { return 0; }
  std::uint32_t player_count() const override { return follower_.agent_count(); }
  void check() override {}
  bool may_begin() override { return true; }
  double begin() override { return 0.0; }
  bool has_begun() const override { return false; }
  void ask_seat(const SeatQuestion&) override {}
  std::optional<SeatAnswer> next_seat() override { return std::nullopt; }
  void keep_seat(std::uint32_t, std::uint64_t) override {}
  void leave_seat(std::uint32_t, std::uint64_t) override {}
  void press(std::uint32_t, game::Key, bool, double) override {}
  void look(std::span<const im::Region>, bool) override {}
  bool has_come(double) const override { return true; }
  std::optional<game::ShownWindow> show_next(double until, game::Game& game) override;
  bool has_shown_all() const override { return false; }
  std::vector<rti::TransportCounters> sent() const override { return {}; }
  game::SharedMatch* match() override { return nullptr; }

 private:
  TraceFollower follower_;
  double shown_s_ = -1.0;  ///< below 0: nothing yet
};

}  // namespace rink::loadgen
