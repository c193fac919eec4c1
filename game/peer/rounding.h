// Rounds doubles to floats that are certainly no greater, or no less, so that claims contain the
// exact values.
#pragma once

#include <cassert>
#include <cmath>
#include <limits>

namespace rink::peer {

inline float rounded_down(double x) {
  const auto nearest = static_cast<float>(x);
  const float rounded = static_cast<double>(nearest) <= x
                            ? nearest
                            : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
  assert(!(static_cast<double>(rounded) > x));
  return rounded;
}
inline float rounded_up(double x) { return -rounded_down(-x); }

}  // namespace rink::peer
