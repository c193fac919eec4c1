// The same scene, and the same keys at the same instants.
#include "game/control/replay.h"

#include <cassert>
#include <utility>

#include "game/control/game.h"
#include "game/model/scene_file.h"

namespace rink::game {

void require_complete(const KeyLog& log, const std::string& file) {
  std::string missing;
  const auto need = [&](bool is_there, const char* what) {
    if (!is_there) missing += (missing.empty() ? "" : ", ") + std::string(what);
  };
  need(log.until.has_value(), "until (how far the game was played)");
  need(log.hash.has_value(), "hash (in which it ended)");
  need(log.is_sealed, "its last line, end (it was cut off or written by hand)");
  if (!missing.empty()) throw SceneError(file + ": cannot be replayed, for it lacks " + missing + "; rink simulate --record and rink serve --record write complete logs");
}

Scene recorded_scene(const KeyLog& log, const std::string& file) {
  Scene scene = log.scene_text.empty() ? load_scene(log.scene) : parse_scene(log.scene_text, file + " (its scene)");
  scene.name = log.scene;
  if (scene.seed != log.seed) scene = with_seed(std::move(scene), log.seed);
  if (log.bat_count) scene = with_count(std::move(scene), physics::BodyKind::bat, *log.bat_count);
  if (log.puck_count) scene = with_count(std::move(scene), physics::BodyKind::puck, *log.puck_count);
  if (log.bats && *log.bats != scene.bodies.bats.size()) scene = scaled_to_bats(std::move(scene), *log.bats);
  require_fit(log, scene, file);
  return scene;
}

std::uint64_t replay(const KeyLog& log, const Scene& scene) {
  assert(log.until && log.hash);
  Game game(scene);
  for (const InputEvent& event : log.events) game.submit(event);
  game.advance(*log.until);
  return game.hash();
}

}  // namespace rink::game
