// Cuts a straight line with rectangles and discs, and turns warped time into time.
#include "im/stages/flight.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace rink::im {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Warped times, both included; empty if `first > last`.
struct WarpedSpan {
  double first = -infinite, last = infinite;
  bool is_empty() const { return first > last; }
};
constexpr WarpedSpan never{infinite, -infinite};

WarpedSpan both(const WarpedSpan& a, const WarpedSpan& b) {
  return {std::max(a.first, b.first), std::min(a.last, b.last)};
}
/// The hull, which is the union of two parts of a convex set.
WarpedSpan either(const WarpedSpan& a, const WarpedSpan& b) {
  if (a.is_empty()) return b;
  return b.is_empty() ? a : WarpedSpan{std::min(a.first, b.first), std::max(a.last, b.last)};
}

/// |offset + speed s| <= half.
WarpedSpan within(double offset, double speed, double half) {
  assert(half >= 0.0);
  if (speed == 0.0) return std::abs(offset) <= half ? WarpedSpan{} : never;
  const double one = (-half - offset) / speed, other = (half - offset) / speed;
  return {std::min(one, other), std::max(one, other)};
}

/// |(x, y) + (u, v) s| <= radius. The discriminant is factored as in the design's time of impact,
/// for b^2 - a c cancels, and so does one of the two sums of roots.
WarpedSpan within_disc(double x, double y, double u, double v, double radius) {
  assert(radius >= 0.0);
  const double square = u * u + v * v, gap = x * x + y * y - radius * radius,
               closing = -(x * u + y * v), miss = std::abs(x * v - y * u),
               reach = radius * std::sqrt(square);
  if (square == 0.0) return gap <= 0.0 ? WarpedSpan{} : never;
  if (miss > reach) return never;
  const double root = std::sqrt((reach - miss) * (reach + miss));
  if (closing >= 0.0) {
    const double far = closing + root;
    return {far > 0.0 ? gap / far : 0.0, far / square};
  }
  const double far = closing - root;
  return {far / square, gap / far};
}

/// The relative path from the later of both times on.
struct Approach {
  double start, x, y, u, v;
  Approach(const Flight& a, const Flight& b, double drag) : start(std::max(a.time, b.time)) {
    const Flight from = at_time(b, start, drag), to = at_time(a, start, drag);
    x = to.x - from.x, y = to.y - from.y, u = to.velocity_x - from.velocity_x,
    v = to.velocity_y - from.velocity_y;
  }
  TimeSpan time_of(const WarpedSpan& stretch, double drag) const {
    const WarpedSpan ahead = both(stretch, {0.0, infinite});
    const double end = drag > 0.0 ? 1.0 / drag : infinite;  // where motion comes to rest
    if (ahead.is_empty() || ahead.first >= end) return {infinite, -infinite};
    return {unwarped(ahead.first, drag), ahead.last >= end ? infinite : unwarped(ahead.last, drag)};
  }
  double unwarped(double warped, double drag) const {
    assert(!(drag * warped > 1.0));  // warped time ends where motion comes to rest
    return start + (drag > 0.0 ? -std::log1p(-drag * warped) / drag : warped);
  }
};

}  // namespace

Flight at_time(const Flight& flight, double time, double drag) {
  assert(drag >= 0.0);
  const double passed = time - flight.time;
  if (!(passed > 0.0)) return flight;
  const double warped = drag > 0.0 ? -std::expm1(-drag * passed) / drag : passed,
               left = drag > 0.0 ? std::exp(-drag * passed) : 1.0;
  return {flight.x + flight.velocity_x * warped, flight.y + flight.velocity_y * warped,
          flight.velocity_x * left, flight.velocity_y * left, time};
}

TimeSpan touching_boxes(const Flight& a, const HalfExtent& a_half, const Flight& b,
                        const HalfExtent& b_half, double drag) {
  const Approach way(a, b, drag);
  return way.time_of(
      both(within(way.x, way.u, a_half.x + b_half.x), within(way.y, way.v, a_half.y + b_half.y)),
      drag);
}

/// The disc grown by the box: two boxes that cross, and a disc at each corner.
TimeSpan touching_disc(const Flight& a, const HalfExtent& a_half, const Flight& b, double radius,
                       double drag) {
  assert(radius >= 0.0 && a_half.x >= 0.0 && a_half.y >= 0.0);
  const Approach way(a, b, drag);
  WarpedSpan stretch =
      either(both(within(way.x, way.u, a_half.x + radius), within(way.y, way.v, a_half.y)),
             both(within(way.x, way.u, a_half.x), within(way.y, way.v, a_half.y + radius)));
  for (const double x : {-a_half.x, a_half.x})
    for (const double y : {-a_half.y, a_half.y})
      stretch = either(stretch, within_disc(way.x - x, way.y - y, way.u, way.v, radius));
  return way.time_of(stretch, drag);
}

}  // namespace rink::im
