// A hand on a pointer that plays a match as a person would: it guards, and strikes at the puck.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>

#include "game/match/match_source.h"
#include "game/model/random_stream.h"

namespace rink::loadgen {

/// Moves by what is shown alone: smoothly, as a wrist does, and in pixels.
class PointerHand {
 public:
  static constexpr double pixel = 2e-3;   ///< m: of a field 2.4 m long on 1,280 pixels
  static constexpr double rate = 9.0;     ///< of the wrist [1/s], a critically damped follower
  static constexpr double tremor = 1e-3;  ///< m, at random

  explicit PointerHand(std::uint64_t seed) : random_(seed) {}

  /// Where the hand is at real time `now_s`, which never falls; nothing without an own bat.
  std::optional<game::Vector2> place(const game::MatchSight& sight, double now_s) {
    const game::Thing* bat = own_bat(sight);
    if (bat == nullptr) return std::nullopt;
    if (!at_) at_ = bat->position, last_s_ = now_s;
    assert(now_s >= last_s_);
    const double dt = std::min(0.05, now_s - last_s_);
    last_s_ = now_s;
    velocity_ += dt * (rate * rate * (aim(sight, *bat) - *at_) - 2.0 * rate * velocity_);
    *at_ += dt * velocity_;
    const double x = random_.uniform(-tremor, tremor),
                 y = random_.uniform(-tremor, tremor);  // apart, for arguments have no order
    const game::Vector2 shaken = *at_ + game::Vector2(x, y);
    return game::Vector2(std::round(shaken.x() / pixel) * pixel,
                         std::round(shaken.y() / pixel) * pixel);
  }

 private:
  static const game::Thing* own_bat(const game::MatchSight& sight) {
    for (const game::Thing& thing : sight.things)
      if (thing.kind == physics::BodyKind::bat && thing.team == sight.own_team) return &thing;
    return nullptr;
  }

  static const game::Thing* nearest_puck(const game::MatchSight& sight, const game::Vector2& from) {
    const game::Thing* nearest = nullptr;
    for (const game::Thing& thing : sight.things)
      if (thing.kind == physics::BodyKind::puck &&
          (nearest == nullptr ||
           (thing.position - from).norm() < (nearest->position - from).norm()))
        nearest = &thing;
    return nearest;
  }

  /// Through a puck that lies before the bat in the own half; else between the puck and the goal.
  static game::Vector2 aim(const game::MatchSight& sight, const game::Thing& bat) {
    const double length = sight.field.length, width = sight.field.width;
    const double forwards = bat.position.x() < 0.5 * length ? 1.0 : -1.0;
    const double end = forwards > 0.0 ? 0.0 : length;
    const game::Thing* puck = nearest_puck(sight, bat.position);
    if (puck == nullptr) return {end + forwards * 0.2 * length, 0.5 * width};
    const double from_end = forwards * (puck->position.x() - end);
    const bool is_here = from_end < 0.48 * length;
    const bool is_before = forwards * (puck->position.x() - bat.position.x()) > 0.0;
    if (is_here && is_before) return puck->position + game::Vector2(0.05 * forwards, 0.0);
    return {end + forwards * std::min(0.15 * length, 0.5 * from_end),
            0.5 * width + 0.6 * (puck->position.y() - 0.5 * width)};
  }

  game::RandomStream random_;
  std::optional<game::Vector2> at_;  ///< m
  game::Vector2 velocity_{0.0, 0.0};
  double last_s_ = 0.0;
};

}  // namespace rink::loadgen
