// The spring, axis by axis, as nothing couples a bat's axes.
#include "game/match/hand_spring.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rink::game {
namespace {

/// `offset` [m] from the bat to the hand, `velocity` [m/s] of the bat.
std::int8_t pull(double offset, double velocity, const PulledBat& bat) {
  if (bat.thrust == 0.0) return 0;
  if (std::abs(offset) < spring_dead_zone && std::abs(velocity) < spring_slow) return 0;
  // With this speed wanted, a = 2w (wanted - v) is the spring w^2 x - 2w v near the hand.
  const double near = 0.5 * spring_rate * std::abs(offset),
               far = std::sqrt(2.0 * spring_braking * bat.thrust * std::abs(offset));
  const double wanted = std::copysign(std::min(near, far), offset);
  const double wanted_force = 2.0 * spring_rate * (wanted - velocity) + bat.drag * velocity;
  const double share = std::clamp(wanted_force / bat.thrust, -1.0, 1.0);
  return static_cast<std::int8_t>(std::lround(share * Push::whole));
}

}  // namespace

Push spring_push(const PulledBat& bat, const physics::Vector2& place) {
  assert(bat.position.allFinite() && bat.velocity.allFinite() && place.allFinite());
  assert(std::isfinite(bat.thrust) && bat.thrust >= 0.0 && bat.drag >= 0.0);
  const physics::Vector2 offset = place - bat.position;
  return {pull(offset.x(), bat.velocity.x(), bat), pull(offset.y(), bat.velocity.y(), bat)};
}

std::optional<Push> HandSpring::next(const PulledBat& bat, double now_s) {
  const Push push = place_ ? spring_push(bat, *place_) : Push{};
  const bool is_near =
      std::abs(push.x - told_.x) <= untold_steps && std::abs(push.y - told_.y) <= untold_steps;
  if (push == told_ || (is_near && push != Push{}) || (place_ && now_s - told_s_ < shortest_s))
    return std::nullopt;
  told_s_ = now_s;
  return told_ = push;
}

}  // namespace rink::game
