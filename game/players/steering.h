// From where a bat should go to the keys that take it there.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "game/model/random_stream.h"
#include "game/physics/flight/motion.h"
#include "game/players/player.h"

namespace rink::game {

/// The keys that push along the signs of `push`; 0 pushes nowhere.
KeysHeld keys_towards(int push_x, int push_y);

/// How fast a bat may be that full thrust against it is to stop within `distance` [m]: from below,
/// since drag helps [m/s].
double speed_to_stop_within(double distance, double thrust);

/// Which way to push along one axis when -1, 0 or 1 is `held`: a key goes down when `need`, of
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

/// How far a puck of `velocity` flies `ahead` [s] and what is left of its speed, both as parts of
/// the velocity (s and e): `free`, which is warp(ahead, drag), less what friction with the table
/// takes.
physics::WarpedTime under_friction(const physics::WarpedTime& free, double ahead,
                                   const Vector2& velocity, const PlayerRules& rules);

/// The speed at which drag holds a bat under full thrust along one axis [m/s]; without drag, what
/// it gains in a second.
double top_speed(const PlayerRules& rules);

/// A player's fingers: they are late by whole decisions, and they try something else when what they
/// do leads nowhere.
class Hands {
 public:
  static constexpr std::uint32_t delay_max = 8;

  /// `delay`: decisions from a wish to the key, at most delay_max.
  explicit Hands(std::uint32_t delay = 0) : delay_(delay) { assert(delay <= delay_max); }

  /// What is pressed now that `wanted` is wished for. A bat that has stood still under pressed keys
  /// for `stuck_decisions` is pushed at random for as long as `escape_decisions`.
  KeysHeld hold(KeysHeld wanted, const Vector2& velocity, RandomStream& random);

  std::uint32_t delay() const { return delay_; }
  KeysHeld last_wish() const { return wished(1); }
  /// What was wished `age` decisions ago, 1 to delay_max; what is older than delay() has been
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
