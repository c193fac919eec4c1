// The choice of a server's scene by its command line, which is enough to make the same scene again.
#pragma once

#include <cstdint>
#include <string>

#include "game/model/scene.h"

namespace rink::game {

/// 0 leaves the scene's own number or seed as it is.
struct SceneChoice {
  std::string scene = "crowd";                  ///< see load_scene
  std::uint32_t bats = 0;                       ///< scaled to so many at the scene's density
  std::uint32_t bat_count = 0, puck_count = 0;  ///< numbers on the same field instead
  std::uint64_t seed = 0;
  friend bool operator==(const SceneChoice&, const SceneChoice&) = default;
};

/// Throws SceneError.
Scene chosen_scene(const SceneChoice& choice);

}  // namespace rink::game
