// What the cases that are written out one at a time share: a world, points in it, and a match's
// changes to keep.
#pragma once

#include <vector>

#include "im/filter.h"

namespace rink::im {

inline constexpr Region world{0.0, 0.0, 100.0, 100.0};
inline constexpr FilterSettings hundred{.world = world};

inline Region point(double x, double y) { return {x, y, x, y}; }

/// The filter's own last until its next match.
inline std::vector<Change> match(Filter& filter) {
  const auto changes = filter.match();
  return {changes.begin(), changes.end()};
}

}  // namespace rink::im
