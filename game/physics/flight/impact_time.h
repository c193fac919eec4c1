// When two shapes first touch that move on curves, or have corners: safe steps along the outward
// normal.
#pragma once

#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "game/physics/flight/motion.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// How far B's centre is from touching A (negative: overlap), and the direction in which it would
/// have to go.
struct Gap {
  Real distance = 0.0;          ///< m
  RealVector normal{1.0, 0.0};  ///< unit, from A to B
  int face = -1;  ///< the axis of the face that is touched, 0 or 1; -1 for rounded contact
  RealVector line{1.0, 0.0};  ///< along the normal, as it was before it was divided by its
                              ///< length: an impulse along it knows nothing of that rounding
};

/// The set of offsets at which two bodies overlap: a rectangle of `half_extent` (the sum of both),
/// grown by `radius` (the sum of both). Two discs have no extent, two rectangles no radius, a disc
/// and a rectangle both: rounded corners.
struct RoundedBox {
  RealVector half_extent{0.0, 0.0};
  Real radius = 0.0;
  Gap gap(const RealVector& offset) const;
};

/// The half-plane of offsets with `normal` . offset < `limit`, for walls.
struct HalfPlane {
  RealVector normal{1.0, 0.0};
  Real limit = 0.0;
  Gap gap(const RealVector& offset) const {
    return {normal.dot(offset) - limit, normal, normal.x() != 0.0 ? 0 : 1, normal};
  }
};

/// The motion of B seen from A, both from their own last events.
struct RelativeMotion {
  const Motion& a;
  const Motion& b;

  struct Sample {
    RealVector offset, velocity;
    RealVector acceleration_a, acceleration_b;
  };
  Sample at(Real time) const;
};

/// The first instant from `start` on, no later than `limit`, at which the gap of `shape` is 0 and
/// closing; nothing if there is none. Each step freezes the plane of the outward normal, which
/// bounds the gap from below, and goes as far as the plane cannot be reached under the strongest
/// closing acceleration still to come (under drag every acceleration only fades): no root is
/// jumped, and near a simple root the steps converge like Newton's. `tolerance` [m] is the rounding
/// error of an offset. Bodies in contact that close (or are pressed together) give `start`.
template <class Shape>
std::optional<Real> first_contact(const RelativeMotion& motion, const Shape& shape, Real start,
                                  Real limit, Real tolerance);

/// The largest closing acceleration along `normal` that may act from the sample's time on [m/s^2],
/// at least 0. Accelerations that fade at the same rate are taken together, and for what comes
/// after one of the bodies has come to rest that of the other alone.
Real closing_acceleration_max(const RelativeMotion& motion, const RelativeMotion::Sample& sample,
                              const RealVector& normal);

/// The rate at which the slowest of the accelerations that act fades [1/s]; infinite if none acts.
Real slowest_fading(const RelativeMotion& motion);

/// An instant from `start` on and no later than `limit` at which a body is within `slack` [m] of
/// the half-plane, or in it, and moves towards it; no such instant comes more than `slack` earlier
/// on its way. Nothing if there is none. It takes fewer steps than first_contact(), whose method it
/// shares.
std::optional<Real> time_near(const Motion& moving, const HalfPlane& plane, Real start, Real limit,
                              Real slack);

namespace detail {

/// The time in which a gap cannot close: `rate` is its growth, `closing` bounds its acceleration
/// towards 0. Infinite if it never can.
inline Real safe_step(Real distance, Real rate, Real closing) {
  assert(!(distance < 0.0) && !(closing < 0.0));
  const Real root = std::sqrt(rate * rate + 2.0 * closing * distance);
  if (rate > 0.0)
    return closing > 0.0 ? (rate + root) / closing : std::numeric_limits<Real>::infinity();
  if (root - rate > 0.0) return 2.0 * distance / (root - rate);
  return closing > 0.0 ? 0.0 : std::numeric_limits<Real>::infinity();
}

}  // namespace detail

template <class Shape>
std::optional<Real> first_contact(const RelativeMotion& motion, const Shape& shape, Real start,
                                  Real limit, Real tolerance) {
  constexpr int step_max = 4000;  // ordinary cases need 2 to 8, the worst grazing ones 60
  constexpr int few_steps =
      8;  // then it may be worth asking whether a gap that grows can close at all
  constexpr Real least_step =
      1e-9;  // s; while in contact and not closing: what could be missed is below 1e-17 m
  assert(!(tolerance < 0.0));
  Real time = start;
  for (int step = 0; step < step_max && time <= limit; ++step) {
    const RelativeMotion::Sample sample = motion.at(time);
    const Gap gap = shape.gap(sample.offset);
    const Real rate = gap.normal.dot(sample.velocity),
               closing = closing_acceleration_max(motion, sample, gap.normal);
    const Real distance = gap.distance > 0.0 ? gap.distance : Real(0.0);
    // What closes at K, fading at g, takes no more than K/g from the rate. Near its terminal speed
    // a body accelerates by rounding alone, and never fades for good.
    if (step > few_steps && rate > 0.0 && rate * slowest_fading(motion) > 1.01 * closing)
      return std::nullopt;
    Real wait = detail::safe_step(distance, rate, closing);
    if (wait == std::numeric_limits<Real>::infinity()) return std::nullopt;
    if (gap.distance <= tolerance) {
      if (rate < 0.0) return time + wait <= limit ? std::optional(time + wait) : std::nullopt;
      if (rate == 0.0 && gap.normal.dot(sample.acceleration_b - sample.acceleration_a) < 0.0)
        return time;
      wait = wait > least_step ? wait : least_step;
    }
    const Real reached = time + wait;
    if (reached == time) return time;  // closer than the resolution of time
    time = reached;
  }
  return std::nullopt;
}

}  // namespace rink::physics::inline RINK_PRECISION
