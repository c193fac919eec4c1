// The parts of a MatchSight that do not depend on where the match is played.
#pragma once

#include "game/match/match_source.h"

namespace rink::game {

/// A sight of `scene` before anything has moved: its bats, then its pucks, then its posts, numbered
/// in this order.
MatchSight sight_of(const Scene& scene);

/// Shows time, score and bodies of `game`; of pucks, those in play, and once the match is over all.
void show_game(const Game& game, MatchSight& sight);

/// Follows who scored last and how long ago, until the puck is in play again.
class GoalWatch {
 public:
  /// Fills in `scorer` and `since_goal_s` from score, time and phase of the `sight` of real time
  /// `now_s`; a face-off follows `face_off_delay` [s] after its goal.
  void look(MatchSight& sight, double now_s, double face_off_delay);

 private:
  Score score_;
  std::optional<Team> scorer_;
  double goal_time_ = 0.0, goal_real_s_ = 0.0;
};

}  // namespace rink::game
