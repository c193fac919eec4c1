// The extremes of a path.
#include "game/peer/box.h"

#include <cassert>
#include <cmath>

namespace rink::peer {

namespace {

/// The time at which v0 e + a s, the velocity along an axis, is 0 [s after the motion's own time];
/// NaN or infinite if it never is.
double turning_time(double velocity, double acceleration, double drag) {
  return drag == 0.0 ? -velocity / acceleration
                     : -std::log(acceleration / (acceleration - velocity * drag)) / drag;
}

}  // namespace

Box swept(const physics::Motion& motion, double begin, double end, const Vector2& extent) {
  assert(extent.x() >= 0.0 && extent.y() >= 0.0);
  begin = std::max(begin, motion.time), end = std::max(begin, end);
  Box box = Box::around(motion.at(begin).position, extent)
                .with(Box::around(motion.at(end).position, extent));
  for (int axis = 0; axis < 2; ++axis) {
    if (motion.acceleration[axis] == 0.0) continue;
    const double turn = motion.time + turning_time(motion.velocity[axis], motion.acceleration[axis],
                                                   motion.drag[axis]);
    if (turn > begin && turn < end) box = box.with(Box::around(motion.at(turn).position, extent));
  }
  return box;
}

}  // namespace rink::peer
