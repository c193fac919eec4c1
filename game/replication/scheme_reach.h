// How far a scheme lets players see beyond the region where they look.
#pragma once

#include <string>

#include "im/filter.h"

namespace rink::game {

/// A body whose middle is farther than that from a region, along either axis [m], is not relevant
/// to it. Infinite if the scheme has no bounds within the world.
struct SchemeReach {
  double x = 0.0, y = 0.0;
};

/// Of an expression that `im::make_filter` takes, for bodies of at most `extent_max` [m] from their
/// middle along either axis. Never too little, and at most 2.5 times the true one and `extent_max`.
SchemeReach reach_of(const std::string& scheme, im::FilterSettings settings, double extent_max);

}  // namespace rink::game
