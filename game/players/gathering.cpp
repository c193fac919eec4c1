// Moves the centre, and the members to their places about it.
#include "game/players/gathering.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "game/players/waypoint.h"

namespace rink::game {
namespace {

constexpr std::uint64_t routes_stream =
    0x726f75746573u << 16;            // apart from the streams of players, which are their numbers
constexpr double centre_speed = 0.4;  // of the members' top speed, or they could not keep up
constexpr double bats_abreast = 6.0;  // how many fit side by side into the group's radius
constexpr double stray_fraction = 0.2, stray_s = 1.0;

}  // namespace

GroupRoute::GroupRoute(const Reach& reach, double speed, std::uint64_t seed, std::uint32_t group)
    : reach_(reach),
      speed_(speed),
      random_(seed, routes_stream + group),
      from_(anywhere(reach, random_)),
      to_(from_) {
  assert(speed >= 0.0);
  start_leg();
}

void GroupRoute::start_leg() {
  from_ = to_;
  to_ = anywhere(reach_, random_);
  begin_s_ = end_s_;
  const double length = std::sqrt((to_ - from_).squaredNorm());
  end_s_ = speed_ > 0.0 ? begin_s_ + std::max(length / speed_, decision_period)
                        : std::numeric_limits<double>::infinity();
}

Vector2 GroupRoute::at(double instant) {
  while (instant >= end_s_) start_leg();
  return from_ + (to_ - from_) * ((instant - begin_s_) / (end_s_ - begin_s_));
}

Gathering::Gathering(const PlayerRules& rules, const PlayerSeat& seat, std::uint64_t seed)
    : rules_(rules),
      reach_(reach_of(rules, seat)),
      random_(seed, seat.number),
      route_({seat.half_extent, Vector2(rules.field.length, rules.field.width) - seat.half_extent},
             centre_speed * top_speed(rules), seed, seat.number / group_size),
      spread_(std::min(bats_abreast * seat.half_extent.maxCoeff(),
                       0.25 * std::min(rules.field.length, rules.field.width))),
      place_(spread_ * random_.in_disc()) {}

KeysHeld Gathering::decide(const PlayerView& view, double instant) {
  if (instant >= stray_until_s_) {
    stray_ = stray_fraction * spread_ * random_.in_disc();
    stray_until_s_ = instant + stray_s * random_.uniform(0.5, 1.5);
  }
  const Vector2 target = reach_.clamped(route_.at(instant) + place_ + stray_);
  return hands_.hold(keys_to_reach(view, target, top_speed(rules_), rules_, hands_.last_wish()),
                     view.velocity, random_);
}

}  // namespace rink::game
