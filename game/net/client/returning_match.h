// A network match that its player returns to after the connection was lost.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "game/net/client/joined_match.h"

namespace rink::game {

/// Shows the match of a connection. Once that was in the match and is lost, another is tried every
/// second until one is in the match again, for as long as a host waits for an absent player; only
/// then the phase is `lost`. The player asks for the seat that was theirs. Reads no clock.
class ReturningMatch final : public MatchSource {
 public:
  static constexpr double try_every_s = 1.0;

  /// The arguments of JoinedMatch, which throws what it throws.
  ReturningMatch(const std::string& place, const NetworkMatchSettings& settings,
                 const std::string& key_file = "");

  void advance(double now_s) override;
  const MatchSight& sight() const override { return lost_s_ ? lost_ : match_->sight(); }
  std::uint32_t hand_count() const override { return settings_.only_watches ? 0 : 1; }
  void press(std::uint32_t hand, Key key, bool is_down) override;
  void reach(std::uint32_t hand, const std::optional<Vector2>& place) override {
    if (match_) match_->reach(hand, place);
  }
  std::string why_keys_alone() const override {
    return match_ ? match_->why_keys_alone() : "The connection is interrupted";
  }
  void pause(bool is_wanted) override {
    if (match_) match_->pause(is_wanted);
  }
  void rematch() override {
    if (match_) match_->rematch();
  }
  void inspect(std::uint32_t thing) override {
    if (match_) match_->inspect(thing);
  }

 private:
  void follow(double now_s);
  void try_again(double now_s);
  void return_to_match();

  std::string place_, key_file_;
  NetworkMatchSettings settings_;
  std::unique_ptr<JoinedMatch> match_;  ///< null between two tries
  bool was_in_match_ = false;
  std::optional<double> lost_s_;  ///< real time of the lost connection's last word
  double tried_s_ = 0.0, silent_s_ = 0.0;
  MatchSight lost_;  ///< of the lost connection
  std::string why_;  ///< it was lost
  std::array<bool, 4> held_{};
};

}  // namespace rink::game
