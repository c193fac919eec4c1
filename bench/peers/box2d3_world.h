// Box2D v3 as a peer, where its sources were given.
#pragma once

#include <memory>
#include <string>

#include "game/physics/simulator.h"

namespace rink::peers {

/// As make_peer(); bodies should stay below `speed_max` [m/s].
std::unique_ptr<physics::Simulator> make_box2d3(const physics::WorldSpec& spec, double dt,
                                                double speed_max);

std::string box2d3_version();

}  // namespace rink::peers
