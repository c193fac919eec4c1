// The parts of a MatchSight that do not depend on where the match is played.
#pragma once

#include <cstdint>
#include <vector>

#include "game/match/match_source.h"
#include "game/match/predicted_rink.h"
#include "game/physics/movers.h"

namespace rink::game {

/// A sight of `scene` before anything has moved: its bats, then its pucks, then its posts, numbered
/// in this order.
MatchSight sight_of(const Scene& scene);

/// Drops the pucks that have left the field, into a goal.
void drop_scored(MatchSight& sight);

/// How far the own bat is shown ahead of all else, by `delay_s` [s], and how it was corrected.
void show_prediction(const PredictedRink& rink, double delay_s, LinkFigures& figures);

/// Shows time, score, the last seconds of a possession and bodies of a game; of pucks, those in
/// play, and once the match is over all. A body at rest where it was shown last costs nothing.
class GameSight {
 public:
  /// `sight` must be the one of the last call, if any, but for its `things` if these were changed
  /// in number.
  void show(const Game& game, MatchSight& sight);

  /// Asserts that every thing of `sight`, which was shown last, is at its noted place.
  void check(const MatchSight& sight) const;

 private:
  static constexpr std::uint32_t nowhere = 0xffffffff;
  void show_all(const Game& game, MatchSight& sight);

  physics::Movers movers_;
  std::vector<std::uint32_t> place_of_;  ///< by body: its place among the things that are shown
  std::size_t shown_ = 0;
  bool is_over_ = false;  ///< of the match that is shown
};

/// Notices when a puck goes to the other side because its time was over, by what is shown alone.
class ServeWatch {
 public:
  /// Nobody holds the puck but while it is played. Fills in `served` from `holder`, `possession_s`
  /// and the pucks of the `sight` of real time `now_s`.
  void look(MatchSight& sight, double now_s);

 private:
  static constexpr double shown_s = 1.8;
  std::vector<Thing> pucks_;
  std::optional<Team> ending_, served_;
  double ending_real_s_ = 0.0, served_real_s_ = 0.0;
};

/// Keeps the last scorer and the time since the goal until the puck is in play again. Keeps also
/// the side to which a puck was served when its time in one half was over.
class GoalWatch {
 public:
  /// Fills in `scorer`, `since_goal_s` and `served` from score, time and phase of the `sight` of
  /// real time `now_s`; a face-off follows `face_off_delay` [s] after its goal.
  void look(MatchSight& sight, double now_s, double face_off_delay);

 private:
  Score score_;
  std::optional<Team> scorer_;
  double goal_time_ = 0.0, goal_real_s_ = 0.0;
  ServeWatch serves_;
};

}  // namespace rink::game
