// How regions lie in the tests: at random, on a lattice, crowded, of mixed sizes, degenerate, and
// at the ends of what numbers can say.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "im/filter.h"

namespace rink::im {

using Random = std::mt19937_64;

inline double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Region around(double x, double y, double half) {
  return {x - half, y - half, x + half, y + half};
}

/// Draws one region somewhere.
struct Layout {
  const char* name;
  Region (*draw)(Random& random, double half_max);
};

inline constexpr double side = 16.0;

inline Region draw_random(Random& random, double half_max) {
  const double x = between(random, 0.0, side), y = between(random, 0.0, side);
  return {x - between(random, 0.0, half_max), y - between(random, 0.0, half_max),
          x + between(random, 0.0, half_max), y + between(random, 0.0, half_max)};
}
/// Whole quarters of a metre: ties everywhere.
inline Region draw_gridded(Random& random, double half_max) {
  const auto quarter = [&](double low, double high) {
    return std::round(between(random, low, high) * 4.0) / 4.0;
  };
  return around(quarter(0.0, side), quarter(0.0, side), quarter(0.0, half_max));
}
inline Region draw_hotspot(Random& random, double half_max) {
  const double spread = between(random, 0.0, 1.0) < 0.9 ? side / 10.0 : side;
  return around(between(random, 0.0, spread), between(random, 0.0, spread),
                between(random, 0.0, half_max / 4.0));
}
inline Region draw_mixed(Random& random, double half_max) {
  const double half = half_max * (between(random, 0.0, 1.0) < 0.05 ? 3.0 : 0.1);
  return around(between(random, 0.0, side), between(random, 0.0, side), half);
}
/// Points, lines, copies of a few boxes, touching corners, far outside, 1e9 away, and the whole
/// plane.
inline Region draw_degenerate(Random& random, double) {
  const double n = std::floor(between(random, 0.0, 4.0));
  switch (static_cast<int>(between(random, 0.0, 7.0))) {
    case 0:
      return {n, n, n, n};
    case 1:
      return {n, 0.0, n, side};
    case 2:
      return {n, n, n + 1.0, n + 1.0};
    case 3:
      return {0.0, 0.0, side, side};
    case 4:
      return {-50.0 - n, side, -50.0, 3.0 * side};
    case 5:
      return around(1e9 + n, -1e9, 0.5 * n);
    default:
      return {-1e12, -1e12, 1e12, 1e12};
  }
}

/// Denormal, huge and neighbouring numbers, among which single precision sees nothing but ties.
inline Region draw_extreme(Random& random, double) {
  constexpr double denormal = std::numeric_limits<double>::denorm_min(),
                   huge = std::numeric_limits<double>::max();
  const double n = std::floor(between(random, 0.0, 4.0));
  switch (static_cast<int>(between(random, 0.0, 6.0))) {
    case 0:
      return {n * denormal, n * denormal, 2.0 * n * denormal, 3.0 * denormal};
    case 1:
      return {-n * denormal, -n * denormal, denormal, 0.0};
    case 2:
      return {-0.0, 0.0, n * denormal, 0.0};
    case 3:
      return {-huge, -huge / (n + 1.0), huge / (n + 1.0), huge};
    case 4:
      return {huge / 2.0, n, huge / 2.0, huge};
    default:
      return {1.0 + n * 0x1p-52, 1.0 - n * 0x1p-53, 1.0 + (n + 1.0) * 0x1p-52, 1.0 + n * 0x1p-52};
  }
}

inline constexpr std::array layouts{
    Layout{"random", draw_random},         Layout{"gridded", draw_gridded},
    Layout{"hotspot", draw_hotspot},       Layout{"mixed", draw_mixed},
    Layout{"degenerate", draw_degenerate}, Layout{"extreme", draw_extreme}};

inline Region moved(Random& random, const Region& from, const Layout& layout, double half_max) {
  if (between(random, 0.0, 1.0) < 0.2) return layout.draw(random, half_max);
  const double step = std::string(layout.name) == "extreme"   ? 0.0
                      : std::string(layout.name) == "gridded" ? 0.25
                                                              : between(random, 0.0, 0.5);
  const double dx = std::round(between(random, -1.0, 1.0)) * step,
               dy = std::round(between(random, -1.0, 1.0)) * step;
  return {from.low_x + dx, from.low_y + dy, from.high_x + dx, from.high_y + dy};
}

}  // namespace rink::im
