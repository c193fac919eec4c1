// A part of a game played on with the network grid of the whole.
#pragma once

#include <cstdint>
#include <span>

#include "game/control/network_grid.h"
#include "game/physics/subdomain.h"

namespace rink::game {

/// Plays `part` up to `until` [s], unless it is there already, and puts on the grid at each of its
/// instants on the way which of `bodies` (by number, rising, all there) have changed. The whole may
/// have left one of them off the grid for want of room; who plays it must be told.
void advance(physics::Subdomain& part, double until, const GridInstants& grid,
             std::span<const std::uint32_t> bodies);

}  // namespace rink::game
