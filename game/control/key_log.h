// A recorded log of all inputs: enough to replay the same game.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "game/model/scene.h"

namespace rink::game {

/// The greatest instant of an event [s], as in scenes (docs/scenes.md, "Limits").
inline constexpr double key_time_max = 1e9;

/// The game that was played, and its inputs. As a file: packed (key_log_packed.h) of matches, else
/// text: a line `rink-keys 1`, one line each for scene, seed and, if known, bats, fingerprint,
/// until, hash, the scene's own text behind bars, then one line per event: time with 17 significant
/// digits, which read back to the same bits, player, what (down, up, enter, leave, push) and, for
/// down and up, the key, for push its steps along x and y. The last line, `end`, has the number of
/// events and a checksum of all lines above. A log with pushes begins with `rink-keys 3`, which
/// older versions refuse.
struct KeyLog {
  std::string scene;  ///< as given to load_scene
  std::uint64_t seed = 1;
  std::optional<std::uint32_t> bats;  ///< of the scaled scene
  std::optional<std::uint32_t> bat_count{},
      puck_count{};  ///< of a scene with changed numbers on the same field (with_count)
  std::optional<std::uint64_t> fingerprint;  ///< of the scene
  std::optional<double> until;               ///< how far it was played [s]
  std::optional<std::uint64_t> hash;         ///< of the game at `until`, on the exact engine
  std::string scene_text;  ///< the scene's file, so that the log needs no other; may be empty
  bool is_sealed = false;  ///< has its last line, so it is complete
  std::vector<InputEvent> events;  ///< ordered by time; events of one instant in the order in which
                                   ///< they are to be submitted
  friend bool operator==(const KeyLog&, const KeyLog&) = default;
};

/// The log's header for `scene`; its events are still to come.
KeyLog key_log_for(const Scene& scene);

bool has_pushes(const KeyLog& log);

/// Throws SceneError, naming `file`, if `log` has pushes: `what` plays keys alone.
void require_keys_alone(const KeyLog& log, const std::string& file, const std::string& what);

/// Throws SceneError, naming `file`, if `log` has players that `scene` has no bats for, or was
/// recorded in another scene.
void require_fit(const KeyLog& log, const Scene& scene, const std::string& file);

}  // namespace rink::game
