// From exact rectangles to single-precision ones that are four times as fast to compare, without ever losing an overlap.
#pragma once

#include <algorithm>
#include <limits>

#include "im/filter.h"

namespace rink::im {

inline constexpr float float_max = std::numeric_limits<float>::max();

struct FloatBox {
  float low_x, low_y, high_x, high_y;
};

/// Farther from everything than any projected rectangle, itself included.
inline constexpr FloatBox float_nowhere{float_max, float_max, -float_max, -float_max};

/// The smallest box that holds both.
inline FloatBox hull_of(const FloatBox& a, const FloatBox& b) {
  return {std::min(a.low_x, b.low_x), std::min(a.low_y, b.low_y), std::max(a.high_x, b.high_x), std::max(a.high_y, b.high_y)};
}

inline float longer_side(const FloatBox& box) { return std::max(box.high_x - box.low_x, box.high_y - box.low_y); }

/// Projects each coordinate by one function f that never decreases: subtract the origin, bound, round to single precision. Then a <= b implies
/// f(a) <= f(b), so no overlap is lost, and f(a) < f(b) implies a < b, so an overlap with no tie among the four comparisons is one. Only ties need the exact
/// test; rounding outward would leave the same pairs in doubt and two roundings to write.
class Projection {
 public:
  explicit Projection(double origin_x = 0.0, double origin_y = 0.0) : origin_x_(origin_x), origin_y_(origin_y) {}

  FloatBox operator()(const Region& region) const {
    return {project(region.low_x, origin_x_), project(region.low_y, origin_y_), project(region.high_x, origin_x_), project(region.high_y, origin_y_)};
  }

  /// True if nothing of `region` is lost. Among boxes that all are exact a tie is an overlap: whole-numbered cells need no second test.
  bool is_exact(const Region& region, const FloatBox& box) const {
    return is_exact(region.low_x, box.low_x, origin_x_) & is_exact(region.low_y, box.low_y, origin_y_) & is_exact(region.high_x, box.high_x, origin_x_) &
           is_exact(region.high_y, box.high_y, origin_y_);
  }

 private:
  /// Adding zero turns a negative zero into a positive one, whose difference with a zero has no sign.
  static float project(double coordinate, double origin) {
    constexpr double bound = float_max;
    return static_cast<float>(std::min(std::max(coordinate - origin, -bound), bound)) + 0.0f;
  }
  /// The coordinate is a function of its projection.
  static bool is_exact(double coordinate, float projected, double origin) {
    return (static_cast<double>(projected) + origin == coordinate) & (projected > -float_max) & (projected < float_max);
  }

  double origin_x_, origin_y_;
};

}  // namespace rink::im
