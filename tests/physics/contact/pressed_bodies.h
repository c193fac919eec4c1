// The bodies of the tests of pressed contact: thin bats that push light pucks at each other, at
// walls and at posts.
#pragma once

#include "game/physics/world.h"

namespace rink::physics::test {

/// A bat 0.1 m thick, twice `half_width` wide.
inline BatSpec thin_bat_at(double x, double y, double half_width, double mass) {
  BatSpec bat;
  bat.position = {x, y};
  bat.half_extent = {0.05, half_width};
  bat.mass = mass;
  return bat;
}

inline PuckSpec light_puck_at(double x, double y, double mass = 0.5) {
  PuckSpec puck;
  puck.position = {x, y};
  puck.mass = mass;
  return puck;
}

}  // namespace rink::physics::test
