// The axis of figures from 0 to 1 that are close to 1.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

namespace rink::loadgen {

/// Both ends of the axis on which `least` is the least share: from below it, at a distance of 1, 2
/// or 5 times a power of ten from 1, to a little above 1. An axis from 0 would draw shares that are
/// all close to 1 on one another.
inline std::pair<double, double> share_range(double least) {
  double span = std::max(0.01, 1.05 * (1.0 - least));
  const double decade = std::pow(10.0, std::floor(std::log10(span) + 1e-9)), digit = span / decade;
  span = std::min(1.0, decade * (digit > 5.0 + 1e-9   ? 10.0
                                 : digit > 2.0 + 1e-9 ? 5.0
                                 : digit > 1.0 + 1e-9 ? 2.0
                                                      : 1.0));
  return {1.0 - span, 1.0 + 0.03 * span};
}

}  // namespace rink::loadgen
