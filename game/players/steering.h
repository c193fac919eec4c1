// Chooses the keys that move a bat to a target.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "game/model/random_stream.h"
#include "game/physics/flight/motion.h"
#include "game/players/player.h"

namespace rink::game {

/// The keys that accelerate along the given signs; 0 presses none.
KeysHeld keys_towards(int push_x, int push_y);

/// A lower bound of the speed from which full acceleration stops a bat within `distance` [m], since
/// drag helps too [m/s].
double speed_to_stop_within(double distance, double thrust);

/// The direction to press along one axis when -1, 0 or 1 is `held`: a key goes down when `need`, of
/// either sign, exceeds `start`, and up when it falls to `stop`. The band in between saves two keys
/// of three.
int pushed_along(int held, double need, double start, double stop);

/// -1, 0 or 1 along an axis for the keys held.
int push_x(KeysHeld keys);
int push_y(KeysHeld keys);

/// The keys that drive a bat at `view` straight to `target` at no more than `cruise_speed` [m/s]
/// and stop it there, while `held` are down.
KeysHeld keys_to_reach(const PlayerView& view, const Vector2& target, double cruise_speed,
                       const PlayerRules& rules, KeysHeld held);

/// The flight of a puck of `velocity` within `ahead` [s] and its remaining speed, both as factors
/// of the velocity (s and e): `free`, which is warp(ahead, drag), less what friction with the table
/// takes.
physics::WarpedTime under_friction(const physics::WarpedTime& free, double ahead,
                                   const Vector2& velocity, const PlayerRules& rules);

/// The terminal speed of a bat under full acceleration along one axis [m/s]; without drag, its gain
/// in a second.
double top_speed(const PlayerRules& rules);

/// A player's reaction: keys are late by whole decisions, and a blocked bat is freed by random
/// keys.
class Hands {
 public:
  static constexpr std::uint32_t delay_max = 8;

  /// `delay`: decisions until the key, at most delay_max.
  explicit Hands(std::uint32_t delay = 0) : delay_(delay) { assert(delay <= delay_max); }

  /// The keys to press now, for the new decision `wanted`. A bat that has stood still under pressed
  /// keys for `stuck_decisions` gets random keys for `escape_decisions`.
  KeysHeld hold(KeysHeld wanted, const Vector2& velocity, RandomStream& random);

  std::uint32_t delay() const { return delay_; }
  KeysHeld last_wish() const { return wished(1); }
  /// The decision of `age` decisions ago, 1 to delay_max; those older than delay() have been
  /// pressed.
  KeysHeld wished(std::uint32_t age) const {
    assert(age >= 1 && age <= delay_max);
    return wishes_[(next_ + delay_max + 1 - age) % (delay_max + 1)];
  }

  /// Asserts that delay and counters are in their ranges and that no escape is by opposed keys.
  void check() const;

 private:
  static constexpr std::uint32_t stuck_decisions = 8, escape_decisions = 6;
  static constexpr double still_speed = 0.03;  // m/s

  std::array<KeysHeld, delay_max + 1> wishes_{};
  std::uint32_t delay_, next_ = 0, stuck_ = 0, escaping_ = 0;
  KeysHeld escape_, held_;
};

}  // namespace rink::game
