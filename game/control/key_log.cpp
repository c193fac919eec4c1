// Makes key logs for scenes, and checks that a log fits a scene.
#include "game/control/key_log.h"

#include <algorithm>

namespace rink::game {

KeyLog key_log_for(const Scene& scene) {
  KeyLog log;
  log.scene = scene.name;
  log.seed = scene.seed;
  log.bats = static_cast<std::uint32_t>(scene.bodies.bats.size());
  log.fingerprint = fingerprint(scene);
  return log;
}

bool has_pushes(const KeyLog& log) {
  return std::ranges::any_of(log.events,
                             [](const InputEvent& event) { return event.kind == InputKind::push; });
}

void require_keys_alone(const KeyLog& log, const std::string& file, const std::string& what) {
  if (has_pushes(log))
    throw SceneError(file + ": has pushes of a pointer or a gamepad, but " + what +
                     " plays keys alone; rink replay and rink simulate play both");
}

void require_fit(const KeyLog& log, const Scene& scene, const std::string& file) {
  const std::size_t bats = scene.bodies.bats.size();
  for (const InputEvent& event : log.events)
    if (event.player >= bats)
      throw SceneError(file + ": has keys of player " + std::to_string(event.player) +
                       ", but the scene " + scene.name + " has " + std::to_string(bats) +
                       " bats, counted from 0");
  if (log.fingerprint && *log.fingerprint != fingerprint(scene))
    throw SceneError(file + ": was recorded in another scene than this (scene " + log.scene +
                     ", seed " + std::to_string(log.seed) +
                     (log.bats ? ", " + std::to_string(*log.bats) + " bats" : "") +
                     "); expected the same scene, seed and number of bats");
}

}  // namespace rink::game
