// The size of a player's view: one rule for the region that clients declare and for true relevance.
#pragma once

#include <algorithm>
#include <cmath>

namespace rink::game {

/// Half the side [m] of the square view around a bat: of `area` [m^2], or if that is 0 of
/// `fraction` of the field's; a fraction of 1 or more sees the whole field
/// (`length` x `width` [m]) from everywhere.
inline double view_half_side(double area, double fraction, double length, double width) {
  if (area > 0.0) return 0.5 * std::sqrt(area);
  return fraction < 1.0 ? 0.5 * std::sqrt(fraction * length * width)
                        : 2.0 * std::max(length, width);
}

}  // namespace rink::game
