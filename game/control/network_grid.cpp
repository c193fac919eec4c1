// Rounds in order of bodies' numbers, so that nothing depends on who changed first.
#include "game/control/network_grid.h"

#include <algorithm>
#include <cassert>

#include "game/physics/rounding/motion_grid.h"
#include "im/basics/sorted_set.h"

namespace rink::game {

void NetworkGrid::round(physics::World& world) {
  assert(instants_.exist() && world.now() == next());
  const double since = instants_.at(done_);
  ++done_;
  const std::span<const physics::BodyId> changed = world.changed(cursor_);
  changed_.assign(changed.begin(), changed.end());
  make_sorted_set(changed_);
  for (const physics::BodyId body : changed_)
    if (physics::MotionGrid::put(world, body, since) == physics::MotionGrid::Result::left_off)
      left_off_.push_back(body);
}

}  // namespace rink::game
