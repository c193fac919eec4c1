// From exact rectangles to single-precision ones that are four times as fast to compare, without
// ever losing an overlap.
#pragma once

#include <algorithm>
#include <bit>
#include <limits>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

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
  return {std::min(a.low_x, b.low_x), std::min(a.low_y, b.low_y), std::max(a.high_x, b.high_x),
          std::max(a.high_y, b.high_y)};
}

/// What is in both; sides are negative where nothing is.
inline FloatBox core_of(const FloatBox& a, const FloatBox& b) {
  return {std::max(a.low_x, b.low_x), std::max(a.low_y, b.low_y), std::min(a.high_x, b.high_x),
          std::min(a.high_y, b.high_y)};
}

inline float longer_side(const FloatBox& box) {
  return std::max(box.high_x - box.low_x, box.high_y - box.low_y);
}

/// Projects each coordinate by one function f that never decreases: subtract the origin, bound,
/// round to single precision. Then a <= b implies f(a) <= f(b), so no overlap is lost, and f(a) <
/// f(b) implies a < b, so an overlap with no tie among the four comparisons is one. Only ties need
/// the exact test; rounding outward would leave the same pairs in doubt and two roundings to write.
class Projection {
 public:
  explicit Projection(double origin_x = 0.0, double origin_y = 0.0) : origin_{origin_x, origin_y} {}

  double origin_x() const { return origin_[0]; }
  double origin_y() const { return origin_[1]; }

#ifdef __SSE2__
  // Two coordinates at a time; the compiler does not see it.
  FloatBox operator()(const Region& region) const {
    const __m128 box = _mm_movelh_ps(project(&region.low_x), project(&region.high_x));
    return std::bit_cast<FloatBox>(box);
  }
  /// True if nothing of `region` is lost. Among boxes that all are exact a tie is an overlap:
  /// whole-numbered cells need no second test.
  bool is_exact(const Region& region, const FloatBox& box) const {
    const __m128 floats = std::bit_cast<__m128>(box);
    const __m128d low = is_exact(&region.low_x, floats),
                  high = is_exact(&region.high_x, _mm_movehl_ps(floats, floats));
    const __m128 bounded =
        _mm_cmplt_ps(_mm_andnot_ps(_mm_set1_ps(-0.0f), floats), _mm_set1_ps(float_max));
    return _mm_movemask_pd(_mm_and_pd(low, high)) == 3 && _mm_movemask_ps(bounded) == 15;
  }

 private:
  __m128d origin() const { return _mm_loadu_pd(origin_); }
  /// Adding zero turns a negative zero into a positive one, whose difference with a zero has no
  /// sign.
  __m128 project(const double* coordinates) const {
    const __m128d bound = _mm_set1_pd(float_max),
                  offset = _mm_sub_pd(_mm_loadu_pd(coordinates), origin());
    return _mm_add_ps(
        _mm_cvtpd_ps(_mm_min_pd(_mm_max_pd(offset, _mm_sub_pd(_mm_setzero_pd(), bound)), bound)),
        _mm_setzero_ps());
  }
  /// The coordinate is a function of its projection.
  __m128d is_exact(const double* coordinates, __m128 projected) const {
    return _mm_cmpeq_pd(_mm_add_pd(_mm_cvtps_pd(projected), origin()), _mm_loadu_pd(coordinates));
  }
#else
  FloatBox operator()(const Region& region) const {
    return {project(region.low_x, origin_[0]), project(region.low_y, origin_[1]),
            project(region.high_x, origin_[0]), project(region.high_y, origin_[1])};
  }
  bool is_exact(const Region& region, const FloatBox& box) const {
    return is_exact(region.low_x, box.low_x, origin_[0]) &&
           is_exact(region.low_y, box.low_y, origin_[1]) &&
           is_exact(region.high_x, box.high_x, origin_[0]) &&
           is_exact(region.high_y, box.high_y, origin_[1]);
  }

 private:
  static float project(double coordinate, double origin) {
    constexpr double bound = float_max;
    return static_cast<float>(std::min(std::max(coordinate - origin, -bound), bound)) + 0.0f;
  }
  static bool is_exact(double coordinate, float projected, double origin) {
    return static_cast<double>(projected) + origin == coordinate && projected > -float_max &&
           projected < float_max;
  }
#endif

  double origin_[2];
};

}  // namespace rink::im
