// The last second before a goal, shown again slowly in a corner while the match goes on.
#pragma once

#include <optional>
#include <vector>

#include "game/view/match_source.h"

namespace rink::view {

/// Keeps what was seen, and knows no rules: it is a picture of pictures.
class GoalReplay {
 public:
  static constexpr double kept_s = 1.1, slowness = 2.5, begins_after_s = 0.3,
                          shown_s = kept_s * slowness;

  /// Takes up `sight`, which is of `now_s` [s]; a goal in it begins a replay.
  void look(const MatchSight& sight, double now_s);
  /// What to show now, with things alone; nothing if there is nothing to show.
  const MatchSight* shown() const { return shown_ ? &*shown_ : nullptr; }
  void skip();

 private:
  struct Frame {
    double time;
    std::vector<Thing> things;
  };
  void show(double instant, const MatchSight& sight);

  std::vector<Frame> past_;  ///< of the last kept_s
  std::vector<Frame> clip_;  ///< of the goal that is shown
  std::optional<double> begin_s_;
  std::optional<MatchSight> shown_;
};

}  // namespace rink::view
