// The scenes and keys that the tests of server and clients share.
#pragma once

#include "game/model/scene_file.h"
#include "game/players/random_plan.h"
#include "tests/places.h"

namespace rink::game {

/// Twelve bats and their share of the crowd's pucks, at the crowd's density.
inline Scene small_crowd() {
  return scaled_to_bats(load_scene(test::source_folder() + "/scenes/crowd.toml"), 12);
}

inline Scene match() { return load_scene(test::source_folder() + "/scenes/match.toml"); }

/// Keys for every bat of `scene`.
inline std::vector<InputEvent> keys_for(const Scene& scene, std::uint64_t seed, double seconds) {
  return game::random_plan(seed, static_cast<std::uint32_t>(scene.bodies.bats.size()), seconds);
}

}  // namespace rink::game
