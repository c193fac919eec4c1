// Rectangles that a body, a path or a zone does not leave.
#pragma once

#include <algorithm>
#include <limits>

#include "game/physics/flight/motion.h"

namespace rink::peer {

using physics::Vector2;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Closed, in metres; sides may lie at infinity.
struct Box {
  double low_x, low_y, high_x, high_y;

  bool meets(const Box& other) const {
    return low_x <= other.high_x && other.low_x <= high_x && low_y <= other.high_y &&
           other.low_y <= high_y;
  }
  bool holds(const Box& other) const {
    return low_x <= other.low_x && other.high_x <= high_x && low_y <= other.low_y &&
           other.high_y <= high_y;
  }
  Box grown(double by) const { return grown(by, by); }
  Box grown(double by_x, double by_y) const {
    return {low_x - by_x, low_y - by_y, high_x + by_x, high_y + by_y};
  }
  Box with(const Box& other) const {
    return {std::min(low_x, other.low_x), std::min(low_y, other.low_y),
            std::max(high_x, other.high_x), std::max(high_y, other.high_y)};
  }
  static Box around(const Vector2& centre, const Vector2& extent) {
    return {centre.x() - extent.x(), centre.y() - extent.y(), centre.x() + extent.x(),
            centre.y() + extent.y()};
  }
};

/// The box that a body of `extent` sweeps from `begin` to `end` [s], neither before the motion's
/// own time; a little larger where its path bends.
Box swept(const physics::Motion& motion, double begin, double end, const Vector2& extent);

}  // namespace rink::peer
