// Warped time and the motion under thrust and linear drag.
#include "game/physics/motion.h"

namespace rink::physics {

namespace {

/// (1/2 - y/6 + y^2/24 - ...), the q of unit time: for y = g t below 0.4 where (t - s)/g would lose up to all digits.
double stretched_square(double y) {
  double sum = 0.0;
  for (int n = 15; n >= 2; --n) sum = (1.0 - y * sum) / n;
  return sum;
}

}  // namespace

WarpedTime warp(double elapsed, double drag) {
  if (drag == 0.0) return {elapsed, 0.5 * elapsed * elapsed, 1.0};
  const double y = drag * elapsed;
  const double lost = expm1_of(-y);
  const double s = -lost / drag;
  const double q = y < 0.4 ? elapsed * elapsed * stretched_square(y) : (elapsed - s) / drag;
  return {s, q, 1.0 + lost};
}

Motion Motion::at(double instant) const {
  Motion moved = *this;
  moved.time = instant;
  for (int axis = 0; axis < 2; ++axis) {
    const WarpedTime w = warp(instant - time, drag[axis]);
    moved.position[axis] = position[axis] + velocity[axis] * w.s + acceleration[axis] * w.q;
    moved.velocity[axis] = velocity[axis] * w.e + acceleration[axis] * w.s;
  }
  return moved;
}

}  // namespace rink::physics
