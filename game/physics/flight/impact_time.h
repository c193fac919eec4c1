// When two shapes first touch: the stable quadratic for straight flight, and safe steps along the
// outward normal for everything else.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "game/physics/flight/motion.h"

namespace rink::physics {

/// Two discs that graze each other at a gap of some roundings close at a rate that is a rounding
/// itself, and the root of D, which has another way to be computed, may be greater: by 4e-8 of the
/// relative speed and the reach at most (docs/physics.md, "Discs"); seven roots of epsilon are
/// more.
template <class Real>
constexpr Real root_rounding = std::is_same_v<Real, float> ? Real(2.5e-3) : Real(1e-7);

template <class Real>
Real cross(const BasicVector2<Real>& a, const BasicVector2<Real>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Time [s] until two discs first touch, or nothing if they never do. `offset` [m] and `velocity`
/// [m/s] are those of B seen from A, `reach` [m] is the sum of the radii. Discs in contact and
/// closing give 0. Nothing, too, if the time exceeds `limit` [s].
template <class Real>
std::optional<Real> time_to_touch(
    const BasicVector2<std::type_identity_t<Real>>& offset,
    const BasicVector2<std::type_identity_t<Real>>& velocity, Real reach,
    std::type_identity_t<Real> limit = std::numeric_limits<Real>::infinity()) {
  const Real closing = -offset.dot(velocity);
  if (closing <= 0.0) return std::nullopt;
  const Real gap = offset.squaredNorm() - reach * reach;
  if (gap <= 0.0) return Real(0.0);
  // Two square roots saved in most cases: sqrt(D) <= closing, but for roundings.
  const Real slack =
      root_rounding<Real> * reach * (std::abs(velocity.x()) + std::abs(velocity.y()));
  if (gap > (2.001 * closing + slack) * limit) return std::nullopt;
  // closing^2 - |velocity|^2 gap is the same number but cancels: 40 to 300 times larger median
  // error on long and grazing flights (docs/physics.md, "Discs").
  const Real miss = cross(offset, velocity), square = velocity.squaredNorm();
  if (miss * miss > 1.001 * square * reach * reach) return std::nullopt;
  const Real speed_reach = std::sqrt(square) * reach;
  const Real discriminant = (speed_reach - miss) * (speed_reach + miss);
  if (discriminant < 0.0) return std::nullopt;
  const Real wait = gap / (closing + std::sqrt(discriminant));
  if (wait > limit) return std::nullopt;
  return wait;
}

/// How far B's centre is from touching A (negative: overlap), and the direction in which it would
/// have to go.
template <class Real>
struct BasicGap {
  Real distance = 0.0;                  ///< m
  BasicVector2<Real> normal{1.0, 0.0};  ///< unit, from A to B
  int face = -1;  ///< the axis of the face that is touched, 0 or 1; -1 for rounded contact
  BasicVector2<Real> line{1.0,
                          0.0};  ///< along the normal, as it was before it was divided by its
                                 ///< length: an impulse along it knows nothing of that rounding
};
using Gap = BasicGap<double>;

/// The set of offsets at which two bodies overlap: a rectangle of `half_extent` (the sum of both),
/// grown by `radius` (the sum of both). Two discs have no extent, two rectangles no radius, a disc
/// and a rectangle both: rounded corners.
template <class Real>
struct BasicRoundedBox {
  BasicVector2<Real> half_extent{0.0, 0.0};
  Real radius = 0.0;
  BasicGap<Real> gap(const BasicVector2<Real>& offset) const;
};
using RoundedBox = BasicRoundedBox<double>;

/// The half-plane of offsets with `normal` . offset < `limit`, for walls.
template <class Real>
struct BasicHalfPlane {
  BasicVector2<Real> normal{1.0, 0.0};
  Real limit = 0.0;
  BasicGap<Real> gap(const BasicVector2<Real>& offset) const {
    return {normal.dot(offset) - limit, normal, normal.x() != 0.0 ? 0 : 1, normal};
  }
};
using HalfPlane = BasicHalfPlane<double>;

/// The motion of B seen from A, both from their own last events.
template <class Real>
struct BasicRelativeMotion {
  const BasicMotion<Real>& a;
  const BasicMotion<Real>& b;

  struct Sample {
    BasicVector2<Real> offset, velocity;
    BasicVector2<Real> acceleration_a, acceleration_b;
  };
  Sample at(Real time) const;
};
using RelativeMotion = BasicRelativeMotion<double>;

/// The first instant from `start` on, no later than `limit`, at which the gap of `shape` is 0 and
/// closing; nothing if there is none. Each step freezes the plane of the outward normal, which
/// bounds the gap from below, and goes as far as the plane cannot be reached under the strongest
/// closing acceleration still to come (under drag every acceleration only fades): no root is
/// jumped, and near a simple root the steps converge like Newton's. `tolerance` [m] is the rounding
/// error of an offset. Bodies in contact that close (or are pressed together) give `start`.
template <class Real, class Shape>
std::optional<Real> first_contact(const BasicRelativeMotion<Real>& motion, const Shape& shape,
                                  std::type_identity_t<Real> start,
                                  std::type_identity_t<Real> limit,
                                  std::type_identity_t<Real> tolerance);

/// The largest closing acceleration along `normal` that may act from the sample's time on [m/s^2],
/// at least 0. Accelerations that fade at the same rate are taken together, and for what comes
/// after one of the bodies has come to rest that of the other alone.
template <class Real>
Real closing_acceleration_max(const BasicRelativeMotion<Real>& motion,
                              const typename BasicRelativeMotion<Real>::Sample& sample,
                              const BasicVector2<Real>& normal);

/// The rate at which the slowest of the accelerations that act fades [1/s]; infinite if none acts.
template <class Real>
Real slowest_fading(const BasicRelativeMotion<Real>& motion);

namespace detail {

/// The time in which a gap cannot close: `rate` is its growth, `closing` bounds its acceleration
/// towards 0. Infinite if it never can.
template <class Real>
Real safe_step(Real distance, Real rate, Real closing) {
  const Real root = std::sqrt(rate * rate + 2.0 * closing * distance);
  if (rate > 0.0)
    return closing > 0.0 ? (rate + root) / closing : std::numeric_limits<Real>::infinity();
  if (root - rate > 0.0) return 2.0 * distance / (root - rate);
  return closing > 0.0 ? 0.0 : std::numeric_limits<Real>::infinity();
}

}  // namespace detail

template <class Real, class Shape>
std::optional<Real> first_contact(const BasicRelativeMotion<Real>& motion, const Shape& shape,
                                  std::type_identity_t<Real> start,
                                  std::type_identity_t<Real> limit,
                                  std::type_identity_t<Real> tolerance) {
  constexpr int step_max = 4000;  // ordinary cases need 2 to 8, the worst grazing ones 60
  constexpr int few_steps =
      8;  // then it may be worth asking whether a gap that grows can close at all
  constexpr Real least_step =
      1e-9;  // s; while in contact and not closing: what could be missed is below 1e-17 m
  Real time = start;
  for (int step = 0; step < step_max && time <= limit; ++step) {
    const typename BasicRelativeMotion<Real>::Sample sample = motion.at(time);
    const BasicGap<Real> gap = shape.gap(sample.offset);
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

}  // namespace rink::physics
