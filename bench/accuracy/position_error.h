// How far from where they truly are.
#pragma once

#include <span>

#include "game/physics/body.h"

namespace rink::accuracy {

/// Distances [m] of bodies from their true places: the 90th percentile (nearest rank: the smallest
/// distance that nine tenths of the bodies do not exceed) and the largest. A body whose place is
/// not a number is infinitely far.
struct PositionError {
  double p90 = 0.0, max = 0.0;
};

/// `places` and `true_places` in the same order, at least one.
PositionError position_error(std::span<const physics::Vector2> places,
                             std::span<const physics::Vector2> true_places);

}  // namespace rink::accuracy
