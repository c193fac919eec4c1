// Derives the sounds of a match from its picture alone, so that local and networked matches sound
// alike.
#pragma once

#include <vector>

#include "game/match/match_source.h"

namespace rink::game {

/// Compares one sight with the next. Pure.
class NoiseDetector {
 public:
  /// Replaces `sight.noises` by what happened since the last call.
  void listen(MatchSight& sight);

 private:
  void hear_pucks(MatchSight& sight) const;
  void hear_rules(MatchSight& sight) const;

  std::vector<Thing> before_;
  Score score_;
  MatchPhase phase_ = MatchPhase::waiting;
  int count_ = 0;  ///< whole seconds that were left of a countdown
  bool has_listened_ = false;
};

}  // namespace rink::game
