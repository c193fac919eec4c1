// Other physics libraries behind Rink's own interface, to measure against.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/physics/simulator.h"

namespace rink::peers {

/// chipmunk, box2d (2.4, continuous collision off), box2d-bullets (on: every disc and bat is a
/// bullet) and box2d3 (v3), whether or not they were built in.
const std::vector<std::string>& peer_names();

/// What to do for the peer `name` to be built in.
std::string way_to(const std::string& name);

/// Whether the peer `name` was found when this program was built.
bool is_built_in(const std::string& name);

/// The version of the library behind `name`, or "absent".
std::string version_of(const std::string& name);

/// A world of the peer `name` that moves in frames of `dt` [s]; null if it was not built in. It has
/// one material, no goals and no halfway line (asserted), bodies neither turn nor rub, and
/// advance() goes to the frame nearest to the instant it is given. Bodies should stay below
/// `speed_max` [m/s], by which the unit of length is chosen where it matters. Settings and their
/// reasons: docs/accuracy.md.
std::unique_ptr<physics::Simulator> make_peer(const physics::WorldSpec& spec,
                                              const std::string& name, double dt,
                                              double speed_max = 10.0);

}  // namespace rink::peers
