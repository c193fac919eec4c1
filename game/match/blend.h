// Blends a wrongly predicted place into the right one without a jump.
#pragma once

#include <cassert>

#include "game/physics/body.h"

namespace rink::game {

/// The difference between where a body was shown and where it should have been, on its way to zero
/// within `duration`: smoothly, so that speed does not jump either (docs/play.md, "Prediction and
/// reconciliation").
class Blend {
 public:
  static constexpr double duration = 0.1;  ///< s

  /// Makes `offset` [m] vanish from `now` [s] on; it must include the rest of an earlier one.
  void begin(const physics::Vector2& offset, double now) {
    assert(now >= since_);
    offset_ = offset;
    since_ = now;
  }
  physics::Vector2 at(double now) const {
    assert(now >= since_ && "before it begins there is nothing to leave behind");
    const double u = (now - since_) / duration;
    if (u >= 1.0) return {0.0, 0.0};
    return offset_ * ((1.0 - u) * (1.0 - u) * (1.0 + 2.0 * u));
  }

 private:
  physics::Vector2 offset_{0.0, 0.0};
  double since_ = -duration;
};

}  // namespace rink::game
