// Turns the keys that a player holds into the acceleration of a bat.
#pragma once

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

/// One player's keys. Each held key adds the bat's acceleration in its direction, as the paper
/// accumulates forces, so opposed keys cancel and two neighbours push diagonally.
class BatController {
 public:
  /// `thrust` [m/s^2] is 0 or more.
  explicit BatController(double thrust) : BatController(thrust, {}, 0) {}
  /// A controller that holds `keys` after so many inputs.
  BatController(double thrust, const KeysHeld& keys, std::uint32_t input_count)
      : thrust_(thrust), keys_(keys), input_count_(input_count) {
    assert(std::isfinite(thrust) && thrust >= 0.0);
  }

  /// Counts the input, whether or not it changes anything: a key that is down may be pressed again.
  void press(Key key, bool is_down) {
    keys_.set(key, is_down);
    ++input_count_;
  }
  void release_all() { keys_ = {}; }

  /// m/s^2
  physics::Vector2 thrust() const { return thrust_ * direction(keys_); }
  const KeysHeld& keys() const { return keys_; }
  std::uint32_t input_count() const { return input_count_; }

 private:
  double thrust_;
  KeysHeld keys_;
  std::uint32_t input_count_ = 0;
};

}  // namespace rink::game
