// The four keys that move a bat, and everything a player can do to the game.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <optional>
#include <string_view>

#include "game/model/push.h"

namespace rink::game {

/// Left and right are along x, down and up along y; up is towards larger y.
enum class Key : std::uint8_t { left, right, up, down };

inline constexpr std::array<Key, 4> all_keys{Key::left, Key::right, Key::up, Key::down};

/// a, d, w, s for left, right, up, down, as the paper's KeyDown and KeyUp carry them.
constexpr char key_character(Key key) {
  assert(static_cast<std::size_t>(key) < all_keys.size());
  return "adws"[static_cast<std::size_t>(key)];
}

/// Nothing unless `character` is one of a, d, w, s.
constexpr std::optional<Key> key_from_character(char character) {
  for (const Key key : all_keys)
    if (key_character(key) == character) return key;
  return std::nullopt;
}

/// "left", "right", "up" or "down".
constexpr std::string_view key_name(Key key) {
  constexpr std::array<std::string_view, 4> names{"left", "right", "up", "down"};
  assert(static_cast<std::size_t>(key) < names.size());
  return names[static_cast<std::size_t>(key)];
}

/// Nothing if `name` is not the name of a key.
constexpr std::optional<Key> key_from_name(std::string_view name) {
  for (const Key key : all_keys)
    if (key_name(key) == name) return key;
  return std::nullopt;
}

/// The keys that a player holds down.
class KeysHeld {
 public:
  constexpr bool is_down(Key key) const { return (bits_ >> static_cast<unsigned>(key) & 1u) != 0; }
  constexpr void set(Key key, bool is_down) {
    assert(static_cast<std::size_t>(key) < all_keys.size());
    const unsigned bit = 1u << static_cast<unsigned>(key);
    bits_ = static_cast<std::uint8_t>(is_down ? bits_ | bit : bits_ & ~bit);
  }
  constexpr std::uint8_t bits() const { return bits_; }  ///< bit k for Key k
  friend constexpr bool operator==(const KeysHeld&, const KeysHeld&) = default;

 private:
  std::uint8_t bits_ = 0;
};

enum class InputKind : std::uint8_t { key_down, key_up, enter, leave, push };

/// What player `player` did at the simulated instant `time` [s]. `key` means something for key_down
/// and key_up only, `push` for push only: the bat is pushed so until the next one.
struct InputEvent {
  double time = 0.0;
  std::uint32_t player = 0;
  InputKind kind = InputKind::key_down;
  Key key = Key::left;
  Push push{};
  friend bool operator==(const InputEvent&, const InputEvent&) = default;
};

}  // namespace rink::game
