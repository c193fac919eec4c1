// Bodies put on a grid of places and speeds, so that few bits tell their states exactly.
#pragma once

#include <cmath>
#include <cstdint>

#include "game/physics/real.h"
#include "game/physics/subdomain.h"
#include "game/physics/world.h"

namespace rink::physics::inline RINK_PRECISION {

/// Positions, velocities and spins in whole steps, which are powers of two: every multiple is exact
/// in a double. Rounding is to the nearest, ties to even, so that it has no direction
/// (docs/replication.md, "Network grid").
class MotionGrid {
 public:
  static constexpr double position_step = 0x1p-20;  ///< 0.95 um
  static constexpr double velocity_step = 0x1p-17;  ///< 7.6 um/s
  static constexpr double spin_step = 0x1p-12;      ///< 0.24 mrad/s
  /// Rounding brings nobody nearer to a body or a wall than this [m]: beyond the gap at which
  /// pressed bodies count as touching.
  static constexpr double room = 4.0 * position_step;

  static Real rounded(Real value, double step) {
    return std::nearbyint(value / step) * step + 0.0;  // -0 becomes 0
  }

  enum class Result : std::uint8_t {
    untouched,  ///< has not changed, is at rest, held, in a goal's mouth or out of play, or is a
                ///< post
    put,        ///< is on the grid from now() on
    left_off    ///< would be too near to something, and stays as it is
  };
  /// At now(), a body that has changed after `since` [s]. Rounding is an event of its own: the
  /// next ones follow from the rounded state.
  static Result put(World& world, BodyId body, double since);
  /// The same, of a body that is there. Within a window, which undo() takes back with it.
  static Result put(Subdomain& part, std::uint32_t body, double since);
};

}  // namespace rink::physics::inline RINK_PRECISION
