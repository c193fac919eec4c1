// Trips, pauses, and the end of a blocked trip.
#include "game/players/waypoint.h"

#include <cassert>
#include <cmath>

namespace rink::game {

Vector2 anywhere(const Reach& reach, RandomStream& random) {
  const double x = random.uniform(reach.low.x(), reach.high.x()),
               y = random.uniform(reach.low.y(), reach.high.y());
  return {x, y};
}

bool Traveller::needs_target(const PlayerView& view, double instant, RandomStream& random) {
  if (state_ == State::travelling &&
      (target_ - view.position).squaredNorm() <= tolerance_ * tolerance_) {
    state_ = State::resting;
    until_s_ = instant + random.uniform(0.0, pause_max_s);
  }
  return state_ == State::idle || instant >= until_s_;
}

void Traveller::go_to(const Vector2& target, const PlayerView& view, double instant,
                      RandomStream& random) {
  constexpr double patience = 3.0;  // times the expected duration of the trip
  target_ = reach_.clamped(target);
  speed_ = top_speed(rules_) * random.uniform(slowest, 1.0);
  until_s_ = instant + 1.0 + patience * std::sqrt((target_ - view.position).squaredNorm()) / speed_;
  state_ = State::travelling;
}

KeysHeld Traveller::travel(const PlayerView& view, KeysHeld held) const {
  assert(state_ != State::idle && "it was told where to go");
  return is_resting() ? KeysHeld{} : keys_to_reach(view, target_, speed_, rules_, held);
}

Waypoint::Waypoint(const PlayerRules& rules, const PlayerSeat& seat, std::uint64_t seed)
    : random_(seed, seat.number), traveller_(rules, seat) {}

KeysHeld Waypoint::decide(const PlayerView& view, double instant) {
  if (traveller_.needs_target(view, instant, random_))
    traveller_.go_to(anywhere(traveller_.reach(), random_), view, instant, random_);
  return hands_.hold(traveller_.travel(view, hands_.last_wish()), view.velocity, random_);
}

}  // namespace rink::game
