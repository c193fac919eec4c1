// Turns what a player does, keys held and pushes, into the acceleration of a bat.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "game/model/key.h"
#include "game/physics/body.h"

namespace rink::game {

/// The direction of the held keys: opposed ones cancel.
inline physics::Vector2 direction(const KeysHeld& keys) {
  const auto along = [&keys](Key plus, Key minus) {
    return static_cast<double>(keys.is_down(plus)) - static_cast<double>(keys.is_down(minus));
  };
  return {along(Key::right, Key::left), along(Key::up, Key::down)};
}

/// One player's keys and push. Each held key adds the bat's acceleration in its direction, as the
/// paper accumulates forces, so opposed keys cancel and two neighbours push diagonally. A push adds
/// its share; along neither axis is the sum more than one key's.
class BatController {
 public:
  /// `thrust` [m/s^2] is 0 or more.
  explicit BatController(double thrust) : BatController(thrust, {}, 0) {}
  /// A controller that holds `keys`, and pushes, after so many inputs.
  BatController(double thrust, const KeysHeld& keys, std::uint32_t input_count,
                const Push& push = {})
      : thrust_(thrust), keys_(keys), push_(push), input_count_(input_count) {
    assert(std::isfinite(thrust) && thrust >= 0.0 && is_sound(push));
  }

  /// Counts the input, whether or not it changes anything: a key that is down may be pressed again.
  void press(Key key, bool is_down) {
    keys_.set(key, is_down);
    ++input_count_;
  }
  /// As a key, it counts even if it changes nothing.
  void push(const Push& push) {
    assert(is_sound(push));
    push_ = push;
    ++input_count_;
  }
  /// Takes a key or a push (asserted).
  void take(const InputEvent& event) {
    assert(event.kind != InputKind::enter && event.kind != InputKind::leave);
    if (event.kind == InputKind::push) push(event.push);
    else press(event.key, event.kind == InputKind::key_down);
  }
  void release_all() { keys_ = {}, push_ = {}; }

  /// m/s^2. Without a push the bits are those of the keys alone.
  physics::Vector2 thrust() const {
    const physics::Vector2 keys = direction(keys_);
    return thrust_ * physics::Vector2(share(keys.x(), push_.x), share(keys.y(), push_.y));
  }
  const KeysHeld& keys() const { return keys_; }
  const Push& pushed() const { return push_; }
  std::uint32_t input_count() const { return input_count_; }

  /// Of a game's hash: the same number as ever where nobody pushes.
  std::uint64_t digest() const {
    const auto octet = [](std::int8_t steps) {
      return static_cast<std::uint64_t>(static_cast<std::uint8_t>(steps));
    };
    return octet(push_.y) << 48 | octet(push_.x) << 40 |
           static_cast<std::uint64_t>(keys_.bits()) << 32 | input_count_;
  }

 private:
  static double share(double keys, int push) {
    return std::clamp(keys + share_of_thrust(push), -1.0, 1.0);
  }

  double thrust_;
  KeysHeld keys_;
  Push push_;
  std::uint32_t input_count_ = 0;
};

}  // namespace rink::game
