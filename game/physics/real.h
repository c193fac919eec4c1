// The scalar in which the exact engine counts, and the namespace of all that depends on it.
#pragma once

#include <Eigen/Core>
#include <limits>

// With RINK_EXTENDED_PRECISION the same sources make a second library (extended/), the truth that
// tests judge the product by. One program may link both, for whatever depends on the scalar stands
// in an inline namespace of its own.
#if defined(RINK_EXTENDED_PRECISION)
#define RINK_PRECISION extended_precision
#else
#define RINK_PRECISION double_precision
#endif

// Whether the machine takes two such scalars at a time.
#if defined(__SSE2__) && !defined(RINK_EXTENDED_PRECISION)
#define RINK_PAIRS_SCALARS
#endif

namespace rink::physics::inline RINK_PRECISION {

#if defined(RINK_EXTENDED_PRECISION)
using Real = long double;
#else
using Real = double;
#endif
using RealVector = Eigen::Matrix<Real, 2, 1>;

/// How much finer than double the scalar is: the factor on every tolerance that stands for
/// rounding; exactly 1 for double.
constexpr Real fineness = std::numeric_limits<Real>::epsilon() /
                          static_cast<Real>(std::numeric_limits<double>::epsilon());

}  // namespace rink::physics::inline RINK_PRECISION
