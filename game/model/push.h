// The part of a bat's thrust that an analogue hand, a pointer or a stick, asks for.
#pragma once

#include <cassert>
#include <cstdint>

namespace rink::game {

/// A constant force on a bat, in steps of 1/127 of its thrust along each axis, from -127 to 127:
/// what a held key gives is 127 or -127. Quantised where it is chosen, so that everybody computes
/// with the same bits (docs/physics.md, "Pushes").
struct Push {
  static constexpr int whole = 127;  ///< steps of the whole thrust
  std::int8_t x = 0, y = 0;
  friend constexpr bool operator==(const Push&, const Push&) = default;
};

/// False for -128, which is no step and which only bytes from elsewhere can hold.
constexpr bool is_sound(const Push& push) {
  return push.x >= -Push::whole && push.y >= -Push::whole;
}

/// The fraction of the thrust, -1 to 1, that `steps` are: exactly 1 for the whole.
constexpr double share_of_thrust(int steps) {
  assert(steps >= -Push::whole && steps <= Push::whole);
  return static_cast<double>(steps) / Push::whole;
}

}  // namespace rink::game
