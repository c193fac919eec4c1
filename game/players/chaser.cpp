// Chooses shots. All geometry is that of an attack towards larger x; a player of the other team
// sees the rink mirrored.
#include "game/players/chaser.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace rink::game {
namespace {

constexpr std::uint32_t misjudges_anew = 10;  // decisions

/// `y` of a straight flight as the side walls fold it into [low, high].
double folded(double y, double low, double high) {
  const double span = high - low;
  if (span <= 0.0) return 0.5 * (low + high);
  const double turns = (y - low) / (2.0 * span), within = 2.0 * span * (turns - std::floor(turns));
  return low + (within <= span ? within : 2.0 * span - within);
}

/// How often it was folded.
double fold_count(double y, double low, double high) {
  return std::abs(std::floor((y - low) / std::max(high - low, 1e-9)));
}

}  // namespace

Chaser::Chaser(const PlayerRules& rules, const PlayerSeat& seat, std::uint64_t seed,
               const Skill& skill)
    : rules_(rules),
      seat_(seat),
      skill_(skill),
      attacks_right_(seat.team != Team::right),
      reach_(reach_of(rules, seat)),
      random_(seed, seat.number),
      hands_(skill.delay),
      decision_(physics::warp(decision_period, rules.bat_drag)),
      delay_{0.0,
             decision_period * skill.delay,
             {},
             physics::warp(decision_period * skill.delay, rules.puck_drag)} {
  if (!attacks_right_)
    reach_ = {turned({reach_.high.x(), reach_.low.y()}), turned({reach_.low.x(), reach_.high.y()})};
  for (std::size_t k = 0; k < spans_.size(); ++k) {
    const double ahead =
        decision_period * static_cast<double>(k < fine_count ? k + 1 : 2 * k + 2 - fine_count);
    spans_[k] = {ahead, ahead + delay_.puck_ahead, physics::warp(ahead, rules.bat_drag),
                 physics::warp(ahead + delay_.puck_ahead, rules.puck_drag)};
  }
  assert(std::ranges::is_sorted(spans_, {}, &Span::ahead));
  assert(skill.aim_error >= 0.0 && skill.effort > 0.0 && skill.effort <= 1.0);
}

KeysHeld Chaser::decide(const PlayerView& view, double instant) {
  if (rules_.possession_s > 0.0) note_stays(view, instant);
  if (decisions_++ % misjudges_anew == 0) misjudged_ = skill_.aim_error * random_.in_disc();
  const bool is_idle = skill_.effort < 1.0 && random_.uniform() >= skill_.effort;
  return hands_.hold(is_idle ? KeysHeld{} : keys_for(view), view.velocity, random_);
}

physics::WarpedTime Chaser::flight(const Vector2& puck_velocity, const Span& span) const {
  return under_friction(span.puck, span.puck_ahead, puck_velocity, rules_);
}

/// The keys in the pipeline still move the bat before new ones do.
void Chaser::foresee_bat(const PlayerView& view, Sight& sight) const {
  sight.bat = turned(view.position);
  sight.bat_velocity = turned_velocity(view.velocity);
  for (std::uint32_t age = skill_.delay; age > 0; --age) {
    const KeysHeld keys = hands_.wished(age);
    const auto along = [&](Key plus, Key minus) {
      return rules_.thrust *
             (static_cast<double>(keys.is_down(plus)) - static_cast<double>(keys.is_down(minus)));
    };
    const Vector2 thrust =
        turned_velocity({along(Key::right, Key::left), along(Key::up, Key::down)});
    sight.bat += sight.bat_velocity * decision_.s + thrust * decision_.q;
    sight.bat_velocity = sight.bat_velocity * decision_.e + thrust * decision_.s;
  }
  sight.bat = reach_.clamped(sight.bat);
}

void Chaser::note_stays(const PlayerView& view, double instant) {
  instant_ = instant;
  std::vector<Stay> stays;
  for (const SeenEntity& puck : view.pucks) {
    if (turned(puck.position).x() > 0.5 * rules_.field.length) continue;
    const auto known = std::ranges::find(stays_, puck.id, &Stay::puck);
    stays.push_back(known != stays_.end() ? *known : Stay{puck.id, instant});
  }
  stays_ = std::move(stays);
}

double Chaser::left_s(std::uint32_t puck) const {
  const auto stay = std::ranges::find(stays_, puck, &Stay::puck);
  if (stay == stays_.end()) return std::numeric_limits<double>::infinity();
  return stay->since + rules_.possession_s - instant_;
}

/// Whether the puck that goes on from `place` at `speed` along the field is not over the line when
/// its time is over. Without the drag, which takes little on the way.
bool Chaser::is_too_late(const Sight& sight, const Span& span, const Vector2& place,
                         double speed) const {
  if (std::isinf(sight.left_s)) return false;
  const double way = 0.5 * rules_.field.length - place.x();
  return way > 0.0 && span.puck_ahead * speed + way > sight.left_s * speed;
}

Chaser::Sight Chaser::sight_of(const SeenEntity& puck, const Sight& bat) const {
  Sight sight = bat;
  sight.puck = turned(puck.position) + misjudged_;
  sight.puck_velocity = turned_velocity(puck.velocity);
  sight.radius = puck.half_extent.x();
  sight.left_s = left_s(puck.id);
  return sight;
}

KeysHeld Chaser::keys_for(const PlayerView& view) {
  Sight bat;
  foresee_bat(view, bat);
  std::optional<Shot> best;
  std::optional<Sight> nearest;
  std::uint32_t best_id = 0;
  double nearest_square = std::numeric_limits<double>::infinity();
  for (const SeenEntity& puck : view.pucks) {
    const Sight sight = sight_of(puck, bat);
    constexpr double loyalty =
        0.3;  // or two equal pucks would be chased in turn, and neither reached
    const bool is_chased = is_chasing_ && puck.id == chased_;
    if (std::optional<Shot> shot = best_shot(sight)) {
      shot->value += is_chased ? loyalty : 0.0;
      if (!best || shot->value > best->value) best = shot, best_id = puck.id;
    }
    const double square = (sight.puck - sight.bat).squaredNorm() * (is_chased ? 0.7 : 1.0) *
                          (is_within_reach(sight) ? 1.0 : 100.0);
    if (square < nearest_square) {
      nearest_square = square;
      nearest = sight;
      if (!best) best_id = puck.id;
    }
  }
  is_chasing_ = nearest.has_value();
  chased_ = best_id;
  if (best) {
    const Vector2 push = turned_velocity(best->push) / rules_.thrust;
    const KeysHeld held = hands_.last_wish();
    constexpr double start = 0.25,
                     stop = 0.0;  // a higher start would let a bat near its target wait for ever
    return keys_towards(pushed_along(push_x(held), push.x(), start, stop),
                        pushed_along(push_y(held), push.y(), start, stop));
  }
  if (!nearest)
    return keys_to(bat,
                   Vector2(reach_.low.x() + 0.2 * reach_.size().x(), 0.5 * rules_.field.width));
  return keys_to(*nearest,
                 is_within_reach(*nearest) ? place_behind(*nearest) : place_to_guard(*nearest));
}

bool Chaser::is_within_reach(const Sight& sight) const {
  return sight.puck.x() - sight.radius - seat_.half_extent.x() < reach_.high.x();
}

std::optional<Chaser::Shot> Chaser::best_shot(const Sight& sight) const {
  std::optional<Shot> best;
  const double gap = sight.puck.x() +
                     sight.puck_velocity.x() * flight(sight.puck_velocity, delay_).s -
                     sight.bat.x() - seat_.half_extent.x() - sight.radius;
  if (gap < -0.5 * sight.radius) return best;  // it would have to be met from the front
  for (const Span& span : spans_) {
    std::optional<Shot> shot = shot_at(sight, span);
    if (!shot) continue;
    constexpr double haste = 1.0;  // the value of a second
    shot->value -= haste * span.ahead;
    if (!best || shot->value > best->value) best = shot;
  }
  return best;
}

/// The shot from a contact after `span`, if the bat's front can be there by then and the bat is the
/// faster one.
std::optional<Chaser::Shot> Chaser::shot_at(const Sight& sight, const Span& span) const {
  const double low = sight.radius, high = rules_.field.width - sight.radius;
  const physics::WarpedTime flown = flight(sight.puck_velocity, span);
  const Vector2 there = sight.puck + sight.puck_velocity * flown.s;
  const double sure =
      0.9 * rules_.thrust * span.bat.q;  // not all of the thrust: four keys give it in steps only
  const double run = there.x() - sight.radius - seat_.half_extent.x() - sight.bat.x() -
                     sight.bat_velocity.x() * span.bat.s;
  if (std::abs(run) > sure)
    return std::nullopt;  // most contacts are out of reach, which costs little to see
  const Vector2 puck(there.x(), folded(there.y(), low, high));
  if (puck.x() < low || puck.x() > rules_.field.length - low) return std::nullopt;
  const double bounces = fold_count(there.y(), low, high);
  const Vector2 velocity = sight.puck_velocity * flown.e;
  const Vector2 puck_velocity(velocity.x(),
                              std::fmod(bounces, 2.0) == 0.0 ? velocity.y() : -velocity.y());

  const Vector2 drift = sight.bat + sight.bat_velocity * span.bat.s;  // without keys
  const double face = 0.6 * seat_.half_extent.y();
  const Vector2 contact(puck.x() - sight.radius - seat_.half_extent.x(),
                        std::clamp(drift.y(), puck.y() - face, puck.y() + face));
  if (reach_.clamped({contact.x(), drift.y()}).x() != contact.x()) return std::nullopt;
  const Vector2 place = reach_.clamped(contact);
  const Vector2 push = (place - drift) / span.bat.q;
  if ((place - drift).cwiseAbs().maxCoeff() > sure) return std::nullopt;
  const double bat_speed = sight.bat_velocity.x() * span.bat.e + push.x() * span.bat.s;
  const double closing = bat_speed - puck_velocity.x();
  constexpr double least_closing = 0.1;
  if (closing < least_closing) return std::nullopt;
  const double gain =
      (1.0 + rules_.restitution) * rules_.bat_mass / (rules_.bat_mass + rules_.puck_mass);
  const Vector2 shot(puck_velocity.x() + gain * closing, puck_velocity.y());
  if (is_too_late(sight, span, puck, shot.x())) return std::nullopt;
  return Shot{value_of(puck, shot, sight.radius), push};
}

/// The value of a puck that leaves `place` at `velocity`: a goal counts most, then speed.
double Chaser::value_of(const Vector2& place, const Vector2& velocity, double radius) const {
  constexpr double goal_value = 2.0, speed_value = 0.3, bounce_cost = 0.3, backwards_value = -1.0;
  if (velocity.x() <= 0.0) return backwards_value;
  const double low = radius, high = rules_.field.width - radius;
  const double straight =
      place.y() + velocity.y() / velocity.x() * (rules_.field.length - place.x());
  const double miss = std::abs(folded(straight, low, high) - 0.5 * rules_.field.width);
  const bool goes_in = miss < 0.5 * rules_.field.goal_width - radius;
  return speed_value * std::min(velocity.x(), 5.0) +
         (goes_in ? goal_value - bounce_cost * fold_count(straight, low, high) : 0.0);
}

/// The place from which the puck lies between the bat and the opponents' end; if the puck is
/// further back than the bat, first past it on the side with more room.
Vector2 Chaser::place_behind(const Sight& sight) const {
  const double clearance = 0.5 * sight.radius,
               side = seat_.half_extent.y() + sight.radius + clearance,
               back = seat_.half_extent.x() + sight.radius + clearance;
  const Vector2 puck = sight.puck + sight.puck_velocity * flight(sight.puck_velocity, spans_[3]).s;
  const double run_up = 4.0 * sight.radius;
  if (sight.bat.x() + back <= puck.x() + clearance) return {puck.x() - back - run_up, puck.y()};
  const double off = sight.bat.y() - puck.y();
  if (std::abs(off) >= side) return {puck.x() - back - run_up, sight.bat.y()};
  const bool has_room_above =
      puck.y() + side +
      seat_.half_extent
          .y()<rules_.field.width, has_room_below = puck.y() - side - seat_.half_extent.y()> 0.0;
  const bool goes_above = has_room_above && (off > 0.0 || !has_room_below);
  return {std::max(sight.bat.x(), puck.x()), puck.y() + (goes_above ? 1.3 : -1.3) * side};
}

/// The place to guard: between the puck and the own goal, near the goal.
Vector2 Chaser::place_to_guard(const Sight& sight) const {
  const double middle = 0.5 * rules_.field.width, x = reach_.low.x() + 0.2 * reach_.size().x();
  double y = middle + (sight.puck.y() - middle) * 0.4;
  if (sight.puck_velocity.x() < -0.1) {
    const double straight =
        sight.puck.y() + sight.puck_velocity.y() / sight.puck_velocity.x() * (x - sight.puck.x());
    y = folded(straight, sight.radius, rules_.field.width - sight.radius);
  }
  const double most = 0.5 * rules_.field.goal_width;
  return {x, std::clamp(y, middle - most, middle + most)};
}

KeysHeld Chaser::keys_to(const Sight& sight, const Vector2& target) const {
  const PlayerView view{
      .position = turned(sight.bat), .velocity = turned_velocity(sight.bat_velocity), .pucks = {}};
  return keys_to_reach(view, turned(reach_.clamped(target)), top_speed(rules_), rules_,
                       hands_.last_wish());
}

}  // namespace rink::game
