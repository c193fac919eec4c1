// Warped time and the motion under thrust and linear drag.
#include "game/physics/flight/motion.h"

#include <cassert>
#include <cmath>

namespace rink::physics::inline RINK_PRECISION {

namespace {

/// (1/2 - y/6 + y^2/24 - ...), the q of unit time: for y = g t below 0.4 where (t - s)/g would lose
/// up to all digits.
Real stretched_square(Real y) {
  constexpr int last = std::numeric_limits<Real>::digits > 53 ? 19 : 15;
  Real sum = 0.0;
  for (int n = last; n >= 2; --n) sum = (1.0 - y * sum) / n;
  return sum;
}

/// q of WarpedTime, given its s.
Real warped_square(Real elapsed, Real drag, Real s) {
  if (elapsed == 0.0) return 0.0;
  if (drag == 0.0) return 0.5 * elapsed * elapsed;
  const Real y = drag * elapsed;
  return y < 0.4 ? elapsed * elapsed * stretched_square(y) : (elapsed - s) / drag;
}

}  // namespace

WarpedTime warp(Real elapsed, Real drag) {
  WarpedTime warped = warp_unaccelerated(elapsed, drag);
  warped.q = warped_square(elapsed, drag, warped.s);
  return warped;
}

Motion Motion::at(Real instant) const {
  Motion moved = *this;
  moved.time = instant;
  const RealVector zero(0.0, 0.0);
  if (velocity == zero && acceleration == zero) {
    // Nothing is to be multiplied; only the signs of zeros come out as they do below.
    moved.velocity += acceleration, moved.position += moved.velocity;
    if (instant >= rest_time) moved.rest_time = std::numeric_limits<Real>::infinity();
    return moved;
  }
  const bool is_at_rest = instant >= rest_time;
  const Real elapsed = (is_at_rest ? rest_time : instant) - time;
  WarpedTime w{};
  for (int axis = 0; axis < 2; ++axis) {
    if (axis == 0 || drag[axis] != drag[0]) w = warp_unaccelerated(elapsed, drag[axis]);
    if (acceleration[axis] != 0.0 && w.q == 0.0) w.q = warped_square(elapsed, drag[axis], w.s);
    moved.position[axis] = position[axis] + velocity[axis] * w.s + acceleration[axis] * w.q;
    moved.velocity[axis] = velocity[axis] * w.e + acceleration[axis] * w.s;
  }
  if (is_at_rest) {
    moved.velocity = moved.acceleration = RealVector(0.0, 0.0);
    moved.rest_time = std::numeric_limits<Real>::infinity();
  }
  return moved;
}

void Motion::slide(Real friction) {
  assert(friction > 0.0);
  acceleration = RealVector(0.0, 0.0);
  rest_time = std::numeric_limits<Real>::infinity();
  if (velocity == acceleration) return;
  rest_time = time;
  const Real speed = std::sqrt(velocity.squaredNorm()),
             rate = velocity.x() != 0.0 ? drag.x() : drag.y();
  if (speed == 0.0) return;  // its square is below what a scalar holds: at rest at once
  acceleration = -friction * (velocity / speed);
  rest_time += rate == 0.0 ? speed / friction : log1p_of(rate * speed / friction) / rate;
}

}  // namespace rink::physics::inline RINK_PRECISION
