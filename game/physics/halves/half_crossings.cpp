// Between its turns a course along x is monotonic, so a change of sides brackets the crossing.
#include "game/physics/halves/half_crossings.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rink::physics::inline RINK_PRECISION {
namespace {

constexpr Real never = std::numeric_limits<Real>::infinity();

int sign_of(Real value) { return (value > 0.0) - (value < 0.0); }

Half half_of(int sign) { return sign < 0 ? Half::left : sign > 0 ? Half::right : Half::both; }

int side_at(const Motion& motion, Real time, Real line) {
  return sign_of(motion.at(time).position.x() - line);
}

int side_after(const Motion& motion, Real line) {
  if (const int side = sign_of(motion.position.x() - line); side != 0) return side;
  const Real speed = motion.velocity.x();
  return sign_of(speed != 0.0 ? speed : motion.acceleration.x());
}

/// Where x = x0 + v s crosses, of a motion without acceleration along x.
void cross_straight(const Motion& motion, Real line, HalfCrossings& crossings) {
  const Real speed = motion.velocity.x(), gap = line - motion.position.x();
  if (speed == 0.0 || gap == 0.0 || (gap > 0.0) != (speed > 0.0)) return;
  const Real s = gap / speed, drag = motion.drag.x();
  if (drag * s >= 1.0) return;  // it comes to rest before
  const Real elapsed = drag == 0.0 ? s : -log1p_of(-drag * s) / drag;
  if (std::isfinite(elapsed))
    crossings.all[crossings.count++] = {motion.time + elapsed, half_of(sign_of(speed))};
}

/// When the speed along x is 0 after the last event; infinite if never.
Real turn_time(const Motion& motion) {
  const Real speed = motion.velocity.x(), push = motion.acceleration.x(), drag = motion.drag.x();
  if (speed == 0.0 || (speed > 0.0) == (push > 0.0)) return never;
  const Real s = speed / (drag * speed - push);
  return motion.time + (drag == 0.0 ? s : -log1p_of(-drag * s) / drag);
}

/// The first double in (low, high] at which the body is on `side`, as it is at `high` and not at
/// `low`.
Real first_on(int side, const Motion& motion, Real line, Real low, Real high) {
  for (;;) {
    const Real middle = low + 0.5 * (high - low);
    if (middle <= low || middle >= high) return high;
    (side_at(motion, middle, line) == side ? high : low) = middle;
  }
}

/// An instant from which on the body, which goes on to `side` for ever, is there [s]; infinite if
/// no clock shows one.
Real instant_beyond(int side, const Motion& motion, Real line, Real low) {
  constexpr Real longest = 1e12;
  for (Real ahead = 1e-3; ahead < longest; ahead *= 2.0)
    if (side_at(motion, low + ahead, line) == side) return low + ahead;
  return never;
}

}  // namespace

Half half_after(const Motion& motion, Real line) { return half_of(side_after(motion, line)); }

HalfCrossings half_crossings(const Motion& motion, Real line) {
  HalfCrossings crossings;
  if (motion.acceleration.x() == 0.0) {
    cross_straight(motion, line, crossings);
    return crossings;
  }
  const Real turn = std::min(turn_time(motion), motion.rest_time);
  int side = side_after(motion, line);
  const auto cross = [&](Real low, Real high) {
    if (side == 0 || high == never || side_at(motion, high, line) != -side) return;
    side = -side;
    crossings.all[crossings.count++] = {first_on(side, motion, line, low, high), half_of(side)};
  };
  const auto cross_beyond = [&](Real low) {
    const int goal = sign_of(motion.acceleration.x());
    if (side == -goal) cross(low, instant_beyond(goal, motion, line, low));
  };
  if (turn == never) {
    cross_beyond(motion.time);
  } else {
    cross(motion.time, turn);
    if (turn < motion.rest_time && motion.rest_time == never) cross_beyond(turn);
  }
  assert(crossings.count <= crossings.all.size());
  return crossings;
}

}  // namespace rink::physics::inline RINK_PRECISION
