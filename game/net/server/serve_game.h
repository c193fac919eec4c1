// The game of rink serve by its flags: the scene, the keys and the state to begin from.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "game/control/game.h"
#include "game/control/key_log.h"
#include "game/net/scene_choice.h"
#include "game/net/server/serve_options.h"
#include "game/net/server/server.h"

namespace rink::game {

struct ServedGame {
  SceneChoice choice;
  Scene scene;
  std::optional<std::vector<InputEvent>>
      replay;  ///< that moves the bats instead of the players' keys
  std::vector<std::uint8_t>
      state;  ///< the saved game to begin from, as read; empty: the scene's beginning
  std::optional<Game> begun;     ///< the state as a game
  SharedPlay* shared = nullptr;  ///< what plays it together with other servers, if any does
};

/// Throws SceneError naming the file that cannot be read or does not fit the scene.
ServedGame served_game(const ServeOptions& options);

/// How matches are hosted; nothing if none are.
std::optional<Hosting> hosting_of(const ServeOptions& options);

/// The record of the game up to now, for a replay with a comparison of the hash.
KeyLog record_of(const ServedGame& played, const Server& server);

}  // namespace rink::game
