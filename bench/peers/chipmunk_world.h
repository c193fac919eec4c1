// Chipmunk 7 (Scott Lembcke; Debian: libchipmunk-dev) as a peer: doubles, frames, no continuous
// collision.
#pragma once

#include <memory>
#include <string>

#include "game/physics/simulator.h"

namespace rink::peers {

std::unique_ptr<physics::Simulator> make_chipmunk(const physics::WorldSpec& spec, double dt);
std::string chipmunk_version();

}  // namespace rink::peers
