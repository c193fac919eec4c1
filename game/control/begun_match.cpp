// Plays the record again, and lets go of what its players held.
#include "game/control/begun_match.h"

#include <utility>

#include "game/control/replay.h"

namespace rink::game {

BegunMatch begun_match(const KeyLog& log, const Scene& scene, const std::string& file) {
  require_complete(log, file);
  require_fit(log, scene, file);
  BegunMatch begun{.game = Game(scene), .events = log.events};
  Game& game = begun.game;
  for (const InputEvent& event : log.events) game.submit(event);
  game.advance(*log.until);
  if (game.hash() != *log.hash)
    throw SceneError(file + ": cannot go on, for it plays otherwise than it was recorded");
  if (game.is_over()) throw SceneError(file + ": cannot go on, for its match is over");
  const auto let_go = [&](const InputEvent& event) { begun.events.push_back(game.submit(event)); };
  for (std::uint32_t player = 0; player < game.player_count(); ++player) {
    for (const Key key : all_keys)
      if (game.keys_held(player).is_down(key))
        let_go({.time = game.now(), .player = player, .kind = InputKind::key_up, .key = key});
    if (pushed(game, player) != Push{})
      let_go({.time = game.now(), .player = player, .kind = InputKind::push});
  }
  return begun;
}

std::optional<std::filesystem::path> newest_record(const std::filesystem::path& folder,
                                                   std::filesystem::file_time_type since) {
  std::optional<std::filesystem::path> newest;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::filesystem::path& file = entry.path();
    if (file.extension() != ".keys" || !file.filename().string().starts_with("match-")) continue;
    const auto written = entry.last_write_time(ignored);
    if (ignored || written < since) continue;
    since = written;
    newest = file;
  }
  return newest;
}

}  // namespace rink::game
