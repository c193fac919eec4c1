// When do two shapes first touch that move under thrust and drag? The general case of
// dynamic_tests.h, by the engine's own safe steps (impact_time.h).
//
// All of these answer with the first instant of a span at which the shapes touch and close or are
// pressed together; nothing if there is none. Contact::time is on the clock of the motions, as the
// span is. A motion carries the shape's centre.
#pragma once

#include <limits>

#include "game/physics/collision/shapes.h"
#include "game/physics/flight/impact_time.h"

namespace rink::physics::collision {

/// What is looked at, both ends included; it begins no earlier than either motion's last event.
struct TimeSpan {
  Real start, limit;
};

/// Two motions told from where the second was at its last event: what both share, up to 1e6 m and
/// more, then costs no digits.
struct Rebased {
  Motion first, second;
  Real tolerance;  ///< rounding error of an offset [m]; `reach` [m] is the size of the shapes

  Rebased(const Motion& a, const Motion& b, Real reach) : first(a), second(b) {
    first.position -= second.position;
    second.position.setZero();
    tolerance = std::numeric_limits<Real>::epsilon() * (first.position.lpNorm<1>() + reach);
  }
  RelativeMotion relative() const { return {second, first}; }
};

/// The first motion's centre against the box around the second's, of `half_extent` grown by
/// `radius` with rounded corners: every pair of discs and boxes comes down to this.
inline MaybeContact<Real> meet_rounded_box(const Motion& a, const Motion& b,
                                           const RealVector& half_extent, Real radius,
                                           const TimeSpan& span) {
  const RoundedBox shape{half_extent, radius};
  const Rebased rebased(a, b, half_extent.sum() + radius);
  const auto time =
      first_contact(rebased.relative(), shape, span.start, span.limit, rebased.tolerance);
  if (!time) return std::nullopt;
  return Contact<Real>{*time, shape.gap(rebased.relative().at(*time).offset).normal};
}

inline MaybeContact<Real> time_disc_meets_disc(const Motion& a, Real radius_a, const Motion& b,
                                               Real radius_b, const TimeSpan& span) {
  return meet_rounded_box(a, b, RealVector::Zero(), radius_a + radius_b, span);
}

inline MaybeContact<Real> time_disc_meets_rounded_box(const Motion& disc, Real radius,
                                                      const Motion& box,
                                                      const RealVector& half_extent,
                                                      const TimeSpan& span) {
  return meet_rounded_box(disc, box, half_extent, radius, span);
}

/// With the errors at corners of its namesake in dynamic_tests.h.
inline MaybeContact<Real> time_disc_meets_sharp_box(const Motion& disc, Real radius,
                                                    const Motion& box,
                                                    const RealVector& half_extent,
                                                    const TimeSpan& span) {
  return meet_rounded_box(disc, box, half_extent + RealVector::Constant(radius), Real(0), span);
}

inline MaybeContact<Real> time_box_meets_box(const Motion& a, const RealVector& half_extent_a,
                                             const Motion& b, const RealVector& half_extent_b,
                                             const TimeSpan& span) {
  return meet_rounded_box(a, b, half_extent_a + half_extent_b, Real(0), span);
}

/// A moving point against an edge that moves without turning; `edge` is given relative to the
/// position of its motion. A point may pass the edge's line beyond its ends, come back and meet the
/// edge later: up to three crossings when the drags differ.
inline MaybeContact<Real> time_point_meets_moving_edge(const Motion& point,
                                                       const Motion& edge_motion,
                                                       const Edge<Real>& edge,
                                                       const TimeSpan& span) {
  const RealVector along = edge.to - edge.from,
                   normal = RealVector(along.y(), -along.x()).normalized();
  const HalfPlane inside{normal, normal.dot(edge.from)}, outside{-normal, -inside.limit};
  const Rebased rebased(point, edge_motion, edge.from.lpNorm<1>() + edge.to.lpNorm<1>());
  const RelativeMotion motion = rebased.relative();
  constexpr int crossing_max = 16;
  std::optional<Real> time = span.start;
  if (inside.gap(motion.at(span.start).offset).distance < -rebased.tolerance)
    time = first_contact(motion, outside, span.start, span.limit, rebased.tolerance);
  for (int crossing = 0; time && crossing < crossing_max; ++crossing) {
    time = first_contact(motion, inside, *time, span.limit, rebased.tolerance);
    if (!time) break;
    const Real place = along.dot(RealVector(motion.at(*time).offset - edge.from));
    if (place >= Real(0) && place <= along.squaredNorm()) return Contact<Real>{*time, normal};
    time = first_contact(motion, outside, *time, span.limit, rebased.tolerance);
  }
  return std::nullopt;
}

}  // namespace rink::physics::collision
