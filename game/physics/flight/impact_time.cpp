// Gaps between shapes and relative motion.
#include "game/physics/flight/impact_time.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace rink::physics::inline RINK_PRECISION {

Gap RoundedBox::gap(const RealVector& offset) const {
  assert(!(radius < 0.0) && !(half_extent.minCoeff() < 0.0));
  const RealVector outside(std::abs(offset.x()) - half_extent.x(),
                           std::abs(offset.y()) - half_extent.y());
  if (outside.x() > 0.0 && outside.y() > 0.0) {
    const Real length = std::sqrt(outside.squaredNorm());
    const RealVector line(std::copysign(outside.x(), offset.x()),
                          std::copysign(outside.y(), offset.y()));
    return {length - radius, line / length, -1, line};
  }
  const int face = outside.x() >= outside.y() ? 0 : 1;
  RealVector normal(0.0, 0.0);
  normal[face] = offset[face] < 0.0 ? -1.0 : 1.0;
  return {outside[face] - radius, normal, face, normal};
}

auto RelativeMotion::at(Real time) const -> Sample {
  const Motion there = b.at(time), here = a.at(time);
  return {there.position - here.position, there.velocity - here.velocity,
          here.acceleration - here.drag.cwiseProduct(here.velocity),
          there.acceleration - there.drag.cwiseProduct(there.velocity)};
}

Real closing_acceleration_max(const RelativeMotion& motion, const RelativeMotion::Sample& sample,
                              const RealVector& normal) {
  const bool rests_first_a = motion.a.rest_time < motion.b.rest_time,
             rests_first_b = motion.b.rest_time < motion.a.rest_time;
  Real sum = 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    const Real away_b = normal[axis] * sample.acceleration_b[axis],
               towards_a = normal[axis] * sample.acceleration_a[axis];
    if (motion.a.drag[axis] == motion.b.drag[axis])
      sum += std::max<Real>({0.0, towards_a - away_b, rests_first_a ? -away_b : 0.0,
                             rests_first_b ? towards_a : 0.0});
    else sum += std::max<Real>(0.0, towards_a) + std::max<Real>(0.0, -away_b);
  }
  return sum;
}

Real slowest_fading(const RelativeMotion& motion) {
  Real slowest = std::numeric_limits<Real>::infinity();
  for (const Motion* body : {&motion.a, &motion.b})
    for (int axis = 0; axis < 2; ++axis)
      if (body->acceleration[axis] != 0.0 ||
          (body->drag[axis] != 0.0 && body->velocity[axis] != 0.0))
        slowest = std::min(slowest, body->drag[axis]);
  return slowest;
}

std::optional<Real> time_near(const Motion& moving, const HalfPlane& plane, Real start, Real limit,
                              Real slack) {
  assert(slack > 0.0);
  constexpr int step_max = 4000, few_steps = 8;  // as of first_contact()
  const Motion still;
  Real time = start;
  for (int step = 0; step < step_max && time <= limit; ++step) {
    const Motion there = moving.at(time);
    const Real distance = std::max<Real>(0.0, plane.gap(there.position).distance),
               rate = plane.normal.dot(there.velocity);
    if (distance <= slack && rate < 0.0) return time;
    const RealVector acceleration = there.acceleration - there.drag.cwiseProduct(there.velocity);
    const Real closing = std::max<Real>(0.0, -plane.normal.dot(acceleration));
    if (step > few_steps && rate > 0.0 &&
        rate * slowest_fading(RelativeMotion{still, moving}) > 1.01 * closing)
      return std::nullopt;
    const Real wait = detail::safe_step(distance, rate, closing);
    if (wait == std::numeric_limits<Real>::infinity()) return std::nullopt;
    if (!(time + wait > time)) return time;
    time += wait;
  }
  return std::nullopt;
}

}  // namespace rink::physics::inline RINK_PRECISION
