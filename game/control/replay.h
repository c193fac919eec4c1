// Replays a recorded game from its key log alone, and compares the final hash.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/control/key_log.h"

namespace rink::game {

/// Throws SceneError, naming `file` and all that is missing, unless the log has the length of the
/// game, its final hash, and its last line.
void require_complete(const KeyLog& log, const std::string& file);

/// The scene that was played: from the log's own text, or by its name if it has none; with the
/// log's seed and number of bats. Throws SceneError, naming `file`, if there is no such scene, or
/// it differs from the recorded one.
Scene recorded_scene(const KeyLog& log, const std::string& file);

/// The hash of the game at the end of a complete log (asserted), played in `scene`.
std::uint64_t replay(const KeyLog& log, const Scene& scene);

/// The complete log of `game`, played in `scene` with `events`; future events are left out.
KeyLog log_of(const Game& game, const Scene& scene, std::string scene_text,
              std::vector<InputEvent> events);

/// A recorded game that can be viewed in any order. Going back costs no more than going forward,
/// since the game is kept every few seconds.
class Replay {
 public:
  static constexpr double kept_every = 5.0;  ///< simulated seconds

  /// `log` must be complete (asserted), and `scene` its recorded_scene().
  Replay(KeyLog log, Scene scene);

  double end() const { return *log_.until; }
  double now() const { return game_.now(); }
  const Game& game() const { return game_; }
  const Scene& scene() const { return scene_; }
  const KeyLog& log() const { return log_; }

  /// Goes to `instant` [s], or to the nearest one in the record. The game is the same, bit for bit,
  /// in whatever order it is viewed.
  void seek(double instant);
  /// Whether the game ended in the recorded state; nothing before the end was reached.
  std::optional<bool> is_as_recorded() const { return is_as_recorded_; }

  /// Asserts that the kept games are those of their instants.
  void check() const;

 private:
  void play(double until);

  KeyLog log_;
  Scene scene_;
  Game game_;
  std::vector<Game>
      kept_;  ///< the game at 0, kept_every, 2 kept_every and so on, as far as it was played
  std::optional<bool> is_as_recorded_;
};

}  // namespace rink::game
