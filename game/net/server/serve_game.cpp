// Reads the files that the flags name, and checks each against the scene.
#include "game/net/server/serve_game.h"

#include <utility>

#include "game/control/begun_match.h"
#include "game/control/game_state.h"
#include "game/control/key_log_file.h"
#include "game/control/replay.h"
#include "game/model/scene_file.h"

namespace rink::game {

ServedGame served_game(const ServeOptions& options) {
  ServedGame played;
  played.choice = {.scene = options.scene,
                   .bats = options.bats,
                   .bat_count = options.bat_count,
                   .puck_count = options.puck_count,
                   .seed = options.seed};
  played.scene = chosen_scene(played.choice);
  if (!options.keys.empty()) {
    KeyLog log = read_key_log(options.keys);
    require_fit(log, played.scene, options.keys);
    require_keys_alone(log, options.keys, "a server's replay");
    played.replay = std::move(log.events);
  }
  if (!options.from_state.empty()) {
    played.state = read_game_state(options.from_state);
    played.begun = game_in_state(played.state, played.scene, options.from_state);
  }
  return played;
}

namespace {

/// Checked before anybody joins.
std::optional<KeyLog> begun_log(const ServeOptions& options) {
  if (options.continued.empty()) return std::nullopt;
  KeyLog log = read_key_log(options.continued);
  begun_match(log, load_scene(options.scene), options.continued);
  return log;
}

}  // namespace

std::optional<Hosting> hosting_of(const ServeOptions& options) {
  if (options.hosted.empty()) return std::nullopt;
  return Hosting{.times = {.countdown_s = options.countdown_s, .patience_s = options.absence_s},
                 .scene_text = scene_text(options.scene),
                 .begun = begun_log(options)};
}

KeyLog record_of(const ServedGame& played, const Server& server) {
  KeyLog log = log_of(server.game(), played.scene, scene_text(played.choice.scene),
                      server.keys().recorded());
  // A node that was not told of all bodies does not know the hash of all.
  if (server.is_joined() && server.publisher().hidden_count() > 0) log.hash.reset();
  log.scene = played.choice.scene;
  if (played.choice.bat_count > 0) log.bat_count = played.choice.bat_count;
  if (played.choice.puck_count > 0) log.puck_count = played.choice.puck_count;
  return log;
}

}  // namespace rink::game
