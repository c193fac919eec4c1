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

/// q of WarpedTime, given its s.
double warped_square(double elapsed, double drag, double s) {
  if (drag == 0.0) return 0.5 * elapsed * elapsed;
  const double y = drag * elapsed;
  return y < 0.4 ? elapsed * elapsed * stretched_square(y) : (elapsed - s) / drag;
}

}  // namespace

WarpedTime warp_unaccelerated(double elapsed, double drag) {
  if (drag == 0.0) return {elapsed, 0.0, 1.0};
  const double lost = expm1_of(-drag * elapsed);
  return {-lost / drag, 0.0, 1.0 + lost};
}

WarpedTime warp(double elapsed, double drag) {
  WarpedTime warped = warp_unaccelerated(elapsed, drag);
  warped.q = warped_square(elapsed, drag, warped.s);
  return warped;
}

Motion Motion::at(double instant) const {
  Motion moved = *this;
  moved.time = instant;
  const double elapsed = instant - time;
  WarpedTime w{};
  for (int axis = 0; axis < 2; ++axis) {
    if (axis == 0 || drag[axis] != drag[0]) w = warp_unaccelerated(elapsed, drag[axis]);
    if (acceleration[axis] != 0.0 && w.q == 0.0) w.q = warped_square(elapsed, drag[axis], w.s);
    moved.position[axis] = position[axis] + velocity[axis] * w.s + acceleration[axis] * w.q;
    moved.velocity[axis] = velocity[axis] * w.e + acceleration[axis] * w.s;
  }
  return moved;
}

}  // namespace rink::physics
