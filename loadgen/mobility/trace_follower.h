// Shows in a game of a trace's scene where the trace's agents are; nothing is simulated.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/control/game.h"
#include "loadgen/mobility/mobility_trace.h"

namespace rink::loadgen {

/// Player k's bat is agent k. What is shown at an instant depends on that instant alone, and only
/// agents whose leg has ended are looked at.
class TraceFollower {
 public:
  /// `trace` counts time from the game's beginning.
  explicit TraceFollower(MobilityTrace trace);

  /// Shows all agents at `until_s` [s], not before the game's now() (asserted).
  void show(double until_s, game::Game& game);

  std::uint32_t agent_count() const { return static_cast<std::uint32_t>(is_there_.size()); }
  bool is_there(std::uint32_t agent) const { return is_there_[agent]; }
  /// Agents that have come, or gone, since the show before; the first show names all who are away.
  std::span<const std::uint32_t> came() const { return came_; }
  std::span<const std::uint32_t> left() const { return left_; }

 private:
  /// An agent whose leg ends at `time_s`.
  struct Due {
    double time_s;
    std::uint32_t agent;
    friend bool operator<(const Due& a, const Due& b) {
      return a.time_s != b.time_s ? a.time_s > b.time_s : a.agent > b.agent;
    }
  };

  void follow(std::uint32_t agent, double until_s, const game::Game& game);

  MobilityTrace trace_;
  std::vector<Due> due_;  ///< a heap, the earliest first
  std::vector<bool> is_there_;
  std::vector<std::uint32_t> came_, left_;
  std::vector<game::Game::ShownBody> shown_;
};

}  // namespace rink::loadgen
