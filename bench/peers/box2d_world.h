// Box2D 2.4 (Erin Catto; Debian: libbox2d-dev) as a peer: floats, frames, continuous collision if
// wanted.
#pragma once

#include <memory>
#include <string>

#include "game/physics/simulator.h"

namespace rink::peers {

/// `are_bullets`: continuous collision for every disc and bat against everything; otherwise against
/// nothing. `speed_max`: see make_peer().
std::unique_ptr<physics::Simulator> make_box2d(const physics::WorldSpec& spec, bool are_bullets,
                                               double dt, double speed_max);
std::string box2d_version();

}  // namespace rink::peers
