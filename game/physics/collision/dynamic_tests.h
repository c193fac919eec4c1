// When do two shapes in straight flight first touch? Derivations, sources and measured errors:
// docs/collision.md.
//
// All of these answer with the first instant, from now on and no later than `limit` [s], at which
// the shapes touch and close; nothing if there is none. Velocities are in m/s. Shapes that already
// touch or overlap give 0 if they close along the contact's normal and nothing if they part, so a
// contact that has been answered by an impulse is not found again, and nothing is ever moved apart.
#pragma once

#include <cassert>

#include "game/physics/collision/shapes.h"
#include "game/physics/collision/straight_flight.h"

namespace rink::physics::collision {

/// A moving point against a plane at rest. Behind the plane counts as touching.
template <class Real>
MaybeContact<Real> time_point_meets_plane(const Given<Vector<Real>>& point,
                                          const Given<Vector<Real>>& velocity,
                                          const Plane<Real>& plane,
                                          Given<Real> limit = never<Real>) {
  const Real closing = -plane.normal.dot(velocity), gap = plane.normal.dot(point - plane.point);
  if (!(closing > Real(0))) return std::nullopt;
  const Real time = gap > Real(0) ? gap / closing : Real(0);
  return time <= limit ? MaybeContact<Real>({time, plane.normal}) : std::nullopt;
}

/// A moving point against an edge at rest, from its outside; both ends belong to it. A point behind
/// the edge, by however little, or one that flies along it, never meets it. Which side of an end
/// the point passes is decided by that end alone, so nothing slips between two edges that share
/// one.
template <class Real>
MaybeContact<Real> time_point_meets_edge(const Given<Vector<Real>>& point,
                                         const Given<Vector<Real>>& velocity,
                                         const Edge<Real>& edge, Given<Real> limit = never<Real>) {
  assert(edge.from != edge.to);
  const Vector<Real> along = edge.to - edge.from, from = edge.from - point, to = edge.to - point;
  const Real gap = cross<Real>(along, from),
             closing = cross<Real>(along, velocity);  // both times the edge's length
  if (!(closing > Real(0)) || gap < Real(0)) return std::nullopt;
  if (cross<Real>(velocity, from) < Real(0) || cross<Real>(velocity, to) > Real(0))
    return std::nullopt;
  const Real time = gap / closing;
  if (time > limit) return std::nullopt;
  return Contact<Real>{time, Vector<Real>(along.y(), -along.x()) / along.norm()};
}

/// A moving point against an edge that moves without turning.
template <class Real>
MaybeContact<Real> time_point_meets_moving_edge(const Given<Vector<Real>>& point,
                                                const Given<Vector<Real>>& velocity,
                                                const Edge<Real>& edge,
                                                const Given<Vector<Real>>& edge_velocity,
                                                Given<Real> limit = never<Real>) {
  return time_point_meets_edge<Real>(point, velocity - edge_velocity, edge, limit);
}

/// Two moving discs; the sum of the radii is above 0.
template <class Real>
MaybeContact<Real> time_disc_meets_disc(const Disc<Real>& a, const Given<Vector<Real>>& velocity_a,
                                        const Disc<Real>& b, const Given<Vector<Real>>& velocity_b,
                                        Given<Real> limit = never<Real>) {
  return meet_disc<Real>(a.center - b.center, velocity_a - velocity_b, a.radius + b.radius, limit);
}

/// A moving disc against one at rest.
template <class Real>
MaybeContact<Real> time_disc_meets_disc(const Disc<Real>& moving,
                                        const Given<Vector<Real>>& velocity,
                                        const Disc<Real>& still, Given<Real> limit = never<Real>) {
  return meet_disc<Real>(moving.center - still.center, velocity, moving.radius + still.radius,
                         limit);
}

/// A moving disc against a moving box: exact, hence the box grown by the radius with rounded
/// corners.
template <class Real>
MaybeContact<Real> time_disc_meets_rounded_box(const Disc<Real>& disc,
                                               const Given<Vector<Real>>& disc_velocity,
                                               const Box<Real>& box,
                                               const Given<Vector<Real>>& box_velocity,
                                               Given<Real> limit = never<Real>) {
  return meet_rounded_box<Real>(disc.center - box.center, disc_velocity - box_velocity,
                                box.half_extent, disc.radius, limit);
}

/// The same with sharp corners: the disc's centre against the box's four edges, moved outwards by
/// the radius until they meet again. It errs at corners only: too early by up to a radius of
/// flight, with a normal up to a right angle off, and sometimes where there is no contact at all
/// (docs/collision.md, "Sharp corners"). For comparison.
template <class Real>
MaybeContact<Real> time_disc_meets_sharp_box(const Disc<Real>& disc,
                                             const Given<Vector<Real>>& disc_velocity,
                                             const Box<Real>& box,
                                             const Given<Vector<Real>>& box_velocity,
                                             Given<Real> limit = never<Real>) {
  return meet_box<Real>(disc.center - box.center, disc_velocity - box_velocity,
                        box.half_extent + Vector<Real>::Constant(disc.radius), limit);
}

/// Two moving boxes. If both axes touch at once (corner on corner), the normal is along x.
template <class Real>
MaybeContact<Real> time_box_meets_box(const Box<Real>& a, const Given<Vector<Real>>& velocity_a,
                                      const Box<Real>& b, const Given<Vector<Real>>& velocity_b,
                                      Given<Real> limit = never<Real>) {
  return meet_box<Real>(a.center - b.center, velocity_a - velocity_b, a.half_extent + b.half_extent,
                        limit);
}

}  // namespace rink::physics::collision
