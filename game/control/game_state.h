// A game as bytes and as a file: restored from an instant, it continues with the same bits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "game/control/game.h"

namespace rink::game {

/// Saves and restores. The bytes begin with the format's name and version and the scene's
/// fingerprint, and end with a checksum; the world's part is physics::World::save(). Recorded
/// events and the changes of the last `advance` are for observers and not saved.
class GameState {
 public:
  /// A game, or the reason why it cannot be restored.
  struct Restored {
    std::optional<Game> game;
    std::string error;
  };

  /// Saves a game of `scene` on the exact engine (asserted); equal games give equal bytes on every
  /// machine.
  static std::vector<std::uint8_t> save(const Game& game, const Scene& scene);
  static Restored restore(std::span<const std::uint8_t> bytes, const Scene& scene);

 private:
  template <class Stream>
  static bool exchange(Stream& stream, Game& game);
  template <class Stream>
  static bool exchange_halves(Stream& stream, Game& game);
  static bool is_sound(const Game& game);
};

/// Throws SceneError naming `file` if it cannot be written.
void write_game_state(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);
/// The file's bytes. Throws SceneError naming `file` if it cannot be read.
std::vector<std::uint8_t> read_game_state(const std::filesystem::path& file);
/// The game that `bytes`, which were read from `file`, hold. Throws SceneError naming `file` if
/// they are damaged, of another version or of another scene than `scene`.
Game game_in_state(std::span<const std::uint8_t> bytes, const Scene& scene,
                   const std::string& file);

}  // namespace rink::game
