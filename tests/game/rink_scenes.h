// Scenes that the game's tests share.
#pragma once

#include <string>

#include "game/model/scene_file.h"
#include "tests/places.h"

namespace rink::game {

/// A field of 4 m x 2 m with goals of 0.5 m, everything else as in `more`.
inline Scene small_scene(const std::string& more) {
  return parse_scene("[field]\nlength = 4.0\nwidth = 2.0\ngoal_width = 0.5\n" + more, "small.toml");
}

/// Pucks that go into the left goal at 2 m/s, the k-th after (0.5 + 0.3 k) m.
inline Scene pucks_into_left_goal(int count, const std::string& rules) {
  Scene scene = small_scene(rules);
  for (int k = 0; k < count; ++k) {
    Puck puck;
    puck.name = "puck-" + std::to_string(k);
    puck.body.position = {0.5 + 0.3 * k, 1.0};
    puck.body.velocity = {-2.0, 0.0};
    scene.placed.pucks.push_back(puck);
  }
  populate(scene);
  return scene;
}

inline Scene preset(const std::string& name) {
  return load_scene(test::source_folder() + "/scenes/" + name + ".toml");
}

/// The words of the SceneError that `act` throws.
template <class Act>
std::string refusal_of(const Act& act) {
  try {
    act();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "(accepted)";
}

/// A crowd of `bats` bats, ten times as many pucks and a fifth as many posts.
inline Scene small_crowd(std::uint32_t bats, std::uint64_t seed) {
  return with_seed(scaled_to_bats(preset("crowd"), bats), seed);
}

}  // namespace rink::game
