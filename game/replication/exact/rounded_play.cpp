// Stops at each instant of the grid.
#include "game/replication/exact/rounded_play.h"

#include "game/physics/rounding/motion_grid.h"

namespace rink::game {

void advance(physics::Subdomain& part, double until, const GridInstants& grid,
             std::span<const std::uint32_t> bodies) {
  const auto go = [&part](double instant) {
    if (instant > part.world().now()) part.advance(instant);
  };
  if (grid.exist() && !bodies.empty())
    for (std::uint64_t next = grid.last(part.world().now()) + 1; grid.at(next) <= until; ++next) {
      go(grid.at(next));
      for (const std::uint32_t body : bodies)
        physics::MotionGrid::put(part, body, grid.at(next - 1));
    }
  go(until);
}

}  // namespace rink::game
