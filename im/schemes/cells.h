// How schemes with cells number them: half-open, counted from the world's low corner, without a
// last one.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "im/filter.h"

namespace rink::im {

inline constexpr double largest = std::numeric_limits<double>::max();

/// The largest whole number that is not above `number`. The library's floor is a call where the
/// processor that is built for has no instruction for it, and half of a pass.
inline double floored(double number) {
  if (!(std::abs(number) < 0x1p52)) return std::floor(number);  // whole already, or no number
  const auto towards_zero = static_cast<double>(static_cast<std::int64_t>(number));
  return towards_zero - (number < towards_zero ? 1.0 : 0.0);
}

/// A whole number in a double, so that no coordinate is too far; what lies beyond the largest
/// shares the last cell.
inline double cell_of(double coordinate, double origin, double size) {
  return std::clamp(floored((coordinate - origin) / size), -largest, largest);
}

/// The cells that a region touches, first and last along each axis.
inline Region cells_of(const Region& region, const Region& world, double size) {
  assert(size > 0.0);
  return {cell_of(region.low_x, world.low_x, size), cell_of(region.low_y, world.low_y, size),
          cell_of(region.high_x, world.low_x, size), cell_of(region.high_y, world.low_y, size)};
}

inline Region centre_of(const Region& region) {
  const double x = 0.5 * region.low_x + 0.5 * region.high_x,
               y = 0.5 * region.low_y + 0.5 * region.high_y;
  return {x, y, x, y};
}

}  // namespace rink::im
