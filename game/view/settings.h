// The player's settings: keys, sound, effects, the window, in a small TOML file that people may
// edit.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "game/model/key.h"
#include "game/view/palette.h"

namespace rink::view {

/// A key of the keyboard by its place, as GLFW numbers it; 0 is none.
using KeyCode = int;

/// "a", "up", "left shift", "keypad 4"; nothing for a key without a name.
std::optional<std::string> key_code_name(KeyCode code);
/// Case does not matter. Nothing if there is no such key.
std::optional<KeyCode> key_code_from_name(std::string_view name);

/// Keys of one player, in the order of game::all_keys: left, right, up, down.
using KeySet = std::array<KeyCode, 4>;

/// What moves a player's bat beside the keys, or that nothing does.
enum class Control : std::uint8_t { keys, pointer, gamepad };
inline constexpr std::array<const char*, 3> control_names{"keys", "pointer", "gamepad"};
/// Nothing if `name` is none of control_names.
std::optional<Control> control_from_name(std::string_view name);

/// Of the file; 1 had no entry `version`, 2 no `addresses` and no `finds_matches`.
inline constexpr std::int64_t settings_version = 3;

/// Of a window on the desktop [points].
struct WindowPoints {
  int width = 1280, height = 720;
  friend bool operator==(const WindowPoints&, const WindowPoints&) = default;
};
inline constexpr WindowPoints window_least{320, 240}, window_most{8192, 8192};

/// What is told once: in the file by these names.
enum class Hint : std::uint8_t { how_to_play, move, pause, camera, help };
inline constexpr std::array<const char*, 5> hint_names{"how_to_play", "move", "pause", "camera",
                                                       "help"};

struct Settings {
  std::array<KeySet, 2> keys;       ///< of the left and the right player
  Control control = Control::keys;  ///< of the only player, or of the left of two
  double dead_zone = 0.15;          ///< of a gamepad's stick, of its way to the rim: 0 to 0.9
  double sensitivity = 1.0;         ///< how far pointer or stick move the hand: 0.2 to 5
  bool is_muted = false;
  double volume = 0.7;           ///< 0 to 1
  bool has_effects = true;       ///< trails, sparks, nudges, turning pucks, replays, horn
  bool has_less_motion = false;  ///< nothing of them that moves
  bool has_music = false;
  bool is_best_of_three = false;
  std::array<bool, hint_names.size()> hints_seen{};  ///< by Hint
  bool is_full_screen = false;
  bool is_split = true;  ///< two at one keyboard see the table each from the own end
  WindowPoints window{};
  PaletteKind palette = PaletteKind::standard;
  bool finds_matches = true;             ///< asks the local network for matches
  std::vector<std::string> addresses{};  ///< HOST:PORT that were joined, the last one first
  Settings();
  friend bool operator==(const Settings&, const Settings&) = default;
};

inline constexpr double dead_zone_max = 0.9, sensitivity_min = 0.2, sensitivity_max = 5.0;

inline constexpr std::size_t addresses_max = 5, address_size_max = 255;

/// Notes that `address` was joined last. One that no file could hold is left out.
void remember_address(Settings& settings, const std::string& address);

/// The default keys: WASD for the left player, the arrows for the right.
std::array<KeySet, 2> default_keys();

/// The player and the meaning of a key.
struct Bound {
  std::uint32_t hand;
  game::Key key;
};
std::optional<Bound> bound(const Settings& settings, KeyCode code);

/// Settings and the faults of the file, in the order of its lines, at most as many as fit on a
/// screen: unreadable values have their defaults.
struct ReadSettings {
  Settings settings;
  std::vector<std::string> errors;
};

/// `text` is the file's content, `file` its name in messages, which name line, key, value and what
/// was expected.
ReadSettings parse_settings(std::string_view text, const std::string& file);
std::string settings_text(const Settings& settings);

/// No file is no trouble.
ReadSettings read_settings(const std::string& file);
/// `kept` with those settings that differ between `before` and `after`, as they are in `after`.
Settings with_changes(Settings kept, const Settings& before, const Settings& after);

/// Renames a file with faults, so that later writing does not overwrite it. Returns the new name,
/// or nothing if that failed.
std::optional<std::string> set_settings_aside(const std::string& file);
/// Writes the settings, and makes the folder if needed. Returns the error, or nothing.
std::optional<std::string> write_settings(const Settings& settings, const std::string& file);

/// $XDG_CONFIG_HOME/rink/play.toml, or below ~/.config; empty if there is neither.
std::string settings_file();

}  // namespace rink::view
