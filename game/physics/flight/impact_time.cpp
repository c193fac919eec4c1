// Gaps between shapes and relative motion.
#include "game/physics/flight/impact_time.h"

#include <algorithm>
#include <limits>

namespace rink::physics {

template <class Real>
BasicGap<Real> BasicRoundedBox<Real>::gap(const BasicVector2<Real>& offset) const {
  const BasicVector2<Real> outside(std::abs(offset.x()) - half_extent.x(),
                                   std::abs(offset.y()) - half_extent.y());
  if (outside.x() > 0.0 && outside.y() > 0.0) {
    const Real length = std::sqrt(outside.squaredNorm());
    const BasicVector2<Real> line(std::copysign(outside.x(), offset.x()),
                                  std::copysign(outside.y(), offset.y()));
    return {length - radius, line / length, -1, line};
  }
  const int face = outside.x() >= outside.y() ? 0 : 1;
  BasicVector2<Real> normal(0.0, 0.0);
  normal[face] = offset[face] < 0.0 ? -1.0 : 1.0;
  return {outside[face] - radius, normal, face, normal};
}

template <class Real>
auto BasicRelativeMotion<Real>::at(Real time) const -> Sample {
  const BasicMotion<Real> there = b.at(time), here = a.at(time);
  return {there.position - here.position, there.velocity - here.velocity,
          here.acceleration - here.drag.cwiseProduct(here.velocity),
          there.acceleration - there.drag.cwiseProduct(there.velocity)};
}

template <class Real>
Real closing_acceleration_max(const BasicRelativeMotion<Real>& motion,
                              const typename BasicRelativeMotion<Real>::Sample& sample,
                              const BasicVector2<Real>& normal) {
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

template <class Real>
Real slowest_fading(const BasicRelativeMotion<Real>& motion) {
  Real slowest = std::numeric_limits<Real>::infinity();
  for (const BasicMotion<Real>* body : {&motion.a, &motion.b})
    for (int axis = 0; axis < 2; ++axis)
      if (body->acceleration[axis] != 0.0 ||
          (body->drag[axis] != 0.0 && body->velocity[axis] != 0.0))
        slowest = std::min(slowest, body->drag[axis]);
  return slowest;
}

template double slowest_fading(const RelativeMotion&);
template long double slowest_fading(const BasicRelativeMotion<long double>&);
template struct BasicRoundedBox<double>;
template struct BasicRoundedBox<long double>;
template struct BasicRelativeMotion<double>;
template struct BasicRelativeMotion<long double>;
template double closing_acceleration_max(const RelativeMotion&, const RelativeMotion::Sample&,
                                         const Vector2&);
template long double closing_acceleration_max(const BasicRelativeMotion<long double>&,
                                              const BasicRelativeMotion<long double>::Sample&,
                                              const BasicVector2<long double>&);

}  // namespace rink::physics
