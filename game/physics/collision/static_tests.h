// Do two shapes overlap where they stand? Shapes are closed: touching is overlap. How near to
// touching an answer may be wrong stands in docs/collision.md.
#pragma once

#include "game/physics/collision/shapes.h"

namespace rink::physics::collision {

/// Signed distance [m] of `point` from `plane`: above 0 outside.
template <class Real>
Real point_plane_distance(const Given<Vector<Real>>& point, const Plane<Real>& plane) {
  return plane.normal.dot(point - plane.point);
}

template <class Real>
bool is_point_in_circle(const Given<Vector<Real>>& point, const Disc<Real>& circle) {
  return (point - circle.center).squaredNorm() <= circle.radius * circle.radius;
}

/// The smallest circle around `box`.
template <class Real>
Disc<Real> bounding_circle(const Box<Real>& box) {
  return {box.center, box.half_extent.norm()};
}

template <class Real>
bool do_bounding_circles_overlap(const Disc<Real>& a, const Disc<Real>& b) {
  const Real reach = a.radius + b.radius;
  return (b.center - a.center).squaredNorm() <= reach * reach;
}

/// By the point of the box nearest to the centre (Arvo 1990, "A simple method for box-sphere
/// intersection testing").
template <class Real>
bool does_disc_overlap_box(const Disc<Real>& disc, const Box<Real>& box) {
  const Vector<Real> outside =
      ((disc.center - box.center).cwiseAbs() - box.half_extent).cwiseMax(Real(0));
  return outside.squaredNorm() <= disc.radius * disc.radius;
}

template <class Real>
bool do_boxes_overlap(const Box<Real>& a, const Box<Real>& b) {
  return ((b.center - a.center).cwiseAbs().array() <= (a.half_extent + b.half_extent).array())
      .all();
}

}  // namespace rink::physics::collision
