// Gaps between shapes and relative motion.
#include "game/physics/impact_time.h"

#include <algorithm>

namespace rink::physics {

Gap RoundedBox::gap(const Vector2& offset) const {
  const Vector2 outside(std::abs(offset.x()) - half_extent.x(), std::abs(offset.y()) - half_extent.y());
  if (outside.x() > 0.0 && outside.y() > 0.0) {
    const double length = std::sqrt(outside.squaredNorm());
    return {length - radius, {std::copysign(outside.x() / length, offset.x()), std::copysign(outside.y() / length, offset.y())}, -1};
  }
  const int face = outside.x() >= outside.y() ? 0 : 1;
  Vector2 normal(0.0, 0.0);
  normal[face] = offset[face] < 0.0 ? -1.0 : 1.0;
  return {outside[face] - radius, normal, face};
}

RelativeMotion::Sample RelativeMotion::at(double time) const {
  const Motion there = b.at(time), here = a.at(time);
  return {there.position - here.position, there.velocity - here.velocity, here.acceleration - here.drag.cwiseProduct(here.velocity),
          there.acceleration - there.drag.cwiseProduct(there.velocity)};
}

double closing_acceleration_max(const RelativeMotion& motion, const RelativeMotion::Sample& sample, const Vector2& normal) {
  double sum = 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double away_b = normal[axis] * sample.acceleration_b[axis], towards_a = normal[axis] * sample.acceleration_a[axis];
    if (motion.a.drag[axis] == motion.b.drag[axis]) sum += std::max(0.0, towards_a - away_b);
    else sum += std::max(0.0, towards_a) + std::max(0.0, -away_b);
  }
  return sum;
}

}  // namespace rink::physics
