// Binary grids for the instants of matches: exact as doubles, and short on the wire and in records.
#pragma once

#include <cassert>
#include <cmath>

namespace rink::game {

/// Keys of matches are pressed at multiples of this [s]: 15 us, a thousandth of a frame.
inline constexpr double key_grid = 0x1p-16;
/// Hosts of matches stop the game at multiples of this [s] and publish its state then: their stamps
/// take 4 bytes of 8, and are at most a millisecond early.
inline constexpr double tick_grid = 0x1p-10;

/// The first multiple of `grid` not before `instant`, and the last not after it [s].
inline double next_on(double grid, double instant) {
  assert(grid > 0.0);
  return std::ceil(instant / grid) * grid;
}
inline double last_on(double grid, double instant) {
  assert(grid > 0.0);
  return std::floor(instant / grid) * grid;
}

}  // namespace rink::game
