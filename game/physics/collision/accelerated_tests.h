// When do two shapes first touch that move under thrust and drag? The general case of
// dynamic_tests.h, by the engine's own safe steps (impact_time.h).
//
// All of these answer with the first instant, from `start` on and no later than `limit` (both on
// the clock of the motions, not before either of their last events), at which the shapes touch and
// close or are pressed together; nothing if there is none. Contact::time is on that clock too. A
// motion carries the shape's centre.
#pragma once

#include <limits>

#include "game/physics/collision/shapes.h"
#include "game/physics/flight/impact_time.h"

namespace rink::physics::collision {

/// Two motions told from where the second was at its last event: what both share, up to 1e6 m and
/// more, then costs no digits.
template <class Real>
struct Rebased {
  BasicMotion<Real> first, second;
  Real tolerance;  ///< rounding error of an offset [m]; `reach` [m] is the size of the shapes

  Rebased(const BasicMotion<Real>& a, const BasicMotion<Real>& b, Real reach)
      : first(a), second(b) {
    first.position -= second.position;
    second.position.setZero();
    tolerance =
        std::numeric_limits<Real>::epsilon() * (first.position.template lpNorm<1>() + reach);
  }
  BasicRelativeMotion<Real> relative() const { return {second, first}; }
};

/// The first motion's centre against the box around the second's, of `half_extent` grown by
/// `radius` with rounded corners: every pair of discs and boxes comes down to this.
template <class Real>
MaybeContact<Real> meet_rounded_box(const BasicMotion<Real>& a, const BasicMotion<Real>& b,
                                    const Vector<Real>& half_extent, Real radius, Real start,
                                    Real limit) {
  const BasicRoundedBox<Real> shape{half_extent, radius};
  const Rebased<Real> rebased(a, b, half_extent.sum() + radius);
  const auto time = first_contact(rebased.relative(), shape, start, limit, rebased.tolerance);
  if (!time) return std::nullopt;
  return Contact<Real>{*time, shape.gap(rebased.relative().at(*time).offset).normal};
}

template <class Real>
MaybeContact<Real> time_disc_meets_disc(const BasicMotion<Real>& a, Given<Real> radius_a,
                                        const BasicMotion<Real>& b, Given<Real> radius_b,
                                        Given<Real> start, Given<Real> limit) {
  return meet_rounded_box<Real>(a, b, Vector<Real>::Zero(), radius_a + radius_b, start, limit);
}

template <class Real>
MaybeContact<Real> time_disc_meets_rounded_box(const BasicMotion<Real>& disc, Given<Real> radius,
                                               const BasicMotion<Real>& box,
                                               const Given<Vector<Real>>& half_extent,
                                               Given<Real> start, Given<Real> limit) {
  return meet_rounded_box<Real>(disc, box, half_extent, radius, start, limit);
}

/// With the errors at corners of its namesake in dynamic_tests.h.
template <class Real>
MaybeContact<Real> time_disc_meets_sharp_box(const BasicMotion<Real>& disc, Given<Real> radius,
                                             const BasicMotion<Real>& box,
                                             const Given<Vector<Real>>& half_extent,
                                             Given<Real> start, Given<Real> limit) {
  return meet_rounded_box<Real>(disc, box, half_extent + Vector<Real>::Constant(radius), Real(0),
                                start, limit);
}

template <class Real>
MaybeContact<Real> time_box_meets_box(const BasicMotion<Real>& a,
                                      const Given<Vector<Real>>& half_extent_a,
                                      const BasicMotion<Real>& b,
                                      const Given<Vector<Real>>& half_extent_b, Given<Real> start,
                                      Given<Real> limit) {
  return meet_rounded_box<Real>(a, b, half_extent_a + half_extent_b, Real(0), start, limit);
}

/// A moving point against an edge that moves without turning; `edge` is given relative to the
/// position of its motion. A point may pass the edge's line beyond its ends, come back and meet the
/// edge later: up to three crossings when the drags differ.
template <class Real>
MaybeContact<Real> time_point_meets_moving_edge(const BasicMotion<Real>& point,
                                                const BasicMotion<Real>& edge_motion,
                                                const Edge<Real>& edge, Given<Real> start,
                                                Given<Real> limit) {
  const Vector<Real> along = edge.to - edge.from,
                     normal = Vector<Real>(along.y(), -along.x()).normalized();
  const BasicHalfPlane<Real> inside{normal, normal.dot(edge.from)}, outside{-normal, -inside.limit};
  const Rebased<Real> rebased(point, edge_motion,
                              edge.from.template lpNorm<1>() + edge.to.template lpNorm<1>());
  const BasicRelativeMotion<Real> motion = rebased.relative();
  constexpr int crossing_max = 16;
  std::optional<Real> time = start;
  if (inside.gap(motion.at(start).offset).distance < -rebased.tolerance)
    time = first_contact(motion, outside, start, limit, rebased.tolerance);
  for (int crossing = 0; time && crossing < crossing_max; ++crossing) {
    time = first_contact(motion, inside, *time, limit, rebased.tolerance);
    if (!time) break;
    const Real place = along.dot(Vector<Real>(motion.at(*time).offset - edge.from));
    if (place >= Real(0) && place <= along.squaredNorm()) return Contact<Real>{*time, normal};
    time = first_contact(motion, outside, *time, limit, rebased.tolerance);
  }
  return std::nullopt;
}

}  // namespace rink::physics::collision
