// When two shapes first touch: the stable quadratic for straight flight, and safe steps along the outward normal for everything else.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "game/physics/motion.h"

namespace rink::physics {

inline double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Time [s] until two discs first touch, or nothing if they never do. `offset` [m] and `velocity` [m/s] are those of B seen from A, `reach` [m] is
/// the sum of the radii. Discs in contact and closing give 0. May also give nothing if the time would exceed `limit` [s].
inline std::optional<double> time_to_touch(const Vector2& offset, const Vector2& velocity, double reach, double limit = std::numeric_limits<double>::infinity()) {
  const double closing = -offset.dot(velocity);
  if (closing <= 0.0) return std::nullopt;
  const double gap = offset.squaredNorm() - reach * reach;
  if (gap <= 0.0) return 0.0;
  if (gap > 2.001 * closing * limit) return std::nullopt;  // two square roots saved in most cases: sqrt(D) <= closing
  // closing^2 - |velocity|^2 gap is the same number but cancels: 40 to 300 times larger median error on long and grazing flights (docs/physics.md, "Discs").
  const double miss = cross(offset, velocity), square = velocity.squaredNorm();
  if (miss * miss > 1.001 * square * reach * reach) return std::nullopt;
  const double speed_reach = std::sqrt(square) * reach;
  const double discriminant = (speed_reach - miss) * (speed_reach + miss);
  if (discriminant < 0.0) return std::nullopt;
  return gap / (closing + std::sqrt(discriminant));
}

/// How far B's centre is from touching A (negative: overlap), and the direction in which it would have to go.
struct Gap {
  double distance = 0.0;       ///< m
  Vector2 normal{1.0, 0.0};    ///< unit, from A to B
  int face = -1;               ///< the axis of the face that is touched, 0 or 1; -1 for rounded contact
};

/// The set of offsets at which two bodies overlap: a rectangle of `half_extent` (the sum of both), grown by `radius` (the sum of both). Two discs have no extent, two
/// rectangles no radius, a disc and a rectangle both: rounded corners.
struct RoundedBox {
  Vector2 half_extent{0.0, 0.0};
  double radius = 0.0;
  Gap gap(const Vector2& offset) const;
};

/// The half-plane of offsets with `normal` . offset < `limit`, for walls.
struct HalfPlane {
  Vector2 normal{1.0, 0.0};
  double limit = 0.0;
  Gap gap(const Vector2& offset) const { return {normal.dot(offset) - limit, normal, normal.x() != 0.0 ? 0 : 1}; }
};

/// The motion of B seen from A, both from their own last events.
struct RelativeMotion {
  const Motion& a;
  const Motion& b;

  struct Sample {
    Vector2 offset, velocity;
    Vector2 acceleration_a, acceleration_b;
  };
  Sample at(double time) const;
};

/// The first instant from `start` on, no later than `limit`, at which the gap of `shape` is 0 and closing; nothing if there is none. Each step freezes the plane of the
/// outward normal, which bounds the gap from below, and goes as far as the plane cannot be reached under the strongest closing acceleration still to come (under drag
/// every acceleration only fades): no root is jumped, and near a simple root the steps converge like Newton's. `tolerance` [m] is the rounding error of an offset.
/// Bodies in contact that close (or are pressed together) give `start`.
template <class Shape>
std::optional<double> first_contact(const RelativeMotion& motion, const Shape& shape, double start, double limit, double tolerance);

/// The largest closing acceleration along `normal` that may act from the sample's time on [m/s^2], at least 0. Accelerations that fade at the same rate are taken together.
double closing_acceleration_max(const RelativeMotion& motion, const RelativeMotion::Sample& sample, const Vector2& normal);

namespace detail {

/// The time in which a gap cannot close: `rate` is its growth, `closing` bounds its acceleration towards 0. Infinite if it never can.
inline double safe_step(double distance, double rate, double closing) {
  const double root = std::sqrt(rate * rate + 2.0 * closing * distance);
  if (rate > 0.0) return closing > 0.0 ? (rate + root) / closing : std::numeric_limits<double>::infinity();
  if (root - rate > 0.0) return 2.0 * distance / (root - rate);
  return closing > 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
}

}  // namespace detail

template <class Shape>
std::optional<double> first_contact(const RelativeMotion& motion, const Shape& shape, double start, double limit, double tolerance) {
  constexpr int step_max = 4000;      // ordinary cases need 2 to 8, the worst grazing ones 60
  constexpr double least_step = 1e-9;  // s; while in contact and not closing: what could be missed is below 1e-17 m
  double time = start;
  for (int step = 0; step < step_max && time <= limit; ++step) {
    const RelativeMotion::Sample sample = motion.at(time);
    const Gap gap = shape.gap(sample.offset);
    const double rate = gap.normal.dot(sample.velocity), closing = closing_acceleration_max(motion, sample, gap.normal);
    const double distance = gap.distance > 0.0 ? gap.distance : 0.0;
    double wait = detail::safe_step(distance, rate, closing);
    if (wait == std::numeric_limits<double>::infinity()) return std::nullopt;
    if (gap.distance <= tolerance) {
      if (rate < 0.0) return time + wait <= limit ? std::optional(time + wait) : std::nullopt;
      if (rate == 0.0 && gap.normal.dot(sample.acceleration_b - sample.acceleration_a) < 0.0) return time;
      wait = wait > least_step ? wait : least_step;
    }
    const double reached = time + wait;
    if (reached == time) return time;  // closer than the resolution of time
    time = reached;
  }
  return std::nullopt;
}

}  // namespace rink::physics
