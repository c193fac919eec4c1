// Checks the bounds that every honest message keeps, each with a text for an accusation.
#include "game/peer/validation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <iterator>

#include "game/peer/session/session_state.h"

namespace rink::peer {

namespace {

constexpr double speed_max = 299'792'458.0;  ///< m/s: nothing in a rink outruns light
/// Far above the limits of scene files (1e4 m/s^2, 1e4 1/s, 1e9 rad/s), and so low that no window
/// overflows a double.
constexpr double acceleration_max = 1e6, spin_max = 1e12, force_max = 1e18;
constexpr double drag_min = 1e-15;  ///< 1/s: less would take longer than any field is wide

/// s: an event may be so much later than its window by rounding, far more than it ever is. A
/// contact that should have ended earlier ends when it is checked, so there is no lower bound.
constexpr double rounding_margin = 1e-6;

bool is_within(double value, double most) { return std::abs(value) <= most; }  // no number is not
bool is_within(const Vector2& v, double most) {
  return is_within(v.x(), most) && is_within(v.y(), most);
}
bool is_number(const Vector2& v) { return v.allFinite(); }

std::string named(const char* what, std::uint32_t number, const char* fault) {
  return std::string(what) + " " + std::to_string(number) + " " + fault;
}

/// True if the message has the contacts of a body that is marked as in rest contact.
bool has_its_holds(const Handover::Body& body, const std::vector<RestContact>& rest_contacts) {
  for (const int axis : {0, 1})
    if (physics::Subdomain::is_held_along(body.state, axis) &&
        !is_held_by(rest_contacts, body.number, axis))
      return false;
  return true;
}

}  // namespace

bool is_held_by(const std::vector<RestContact>& rest_contacts, std::uint32_t body, int axis) {
  return std::ranges::any_of(rest_contacts, [&](const RestContact& rest) {
    return rest.axis == axis && (rest.low == body || rest.high == body);
  });
}

BodyConstants BodyConstants::of(const BodyState& state) {
  return {state.flight.radius, state.mass,     state.inverse_mass, state.half_extent,
          state.kind,          state.material, state.half};
}

Validator::Validator(const Start& start)
    : puck_drag_(start.spec().puck_drag),
      drag_max_(std::max(puck_drag_, start.spec().bat_drag)),
      glide_max_(physics::Subdomain::glide_max(start.spec())),
      reach_(2.0 * (start.spec().field.length + start.spec().field.width)),
      material_count_(start.spec().restitution.material_count()),
      body_count_(start.body_count()) {
  start.visit([this](std::uint32_t body, const physics::World& world, physics::BodyId id) {
    const BodyState state = physics::Subdomain::state_in(world, id.index);
    drag_max_ = std::max(drag_max_, state.drag.maxCoeff());
    const BodyConstants own = BodyConstants::of(state);
    if (!runs_.empty() && constants_[runs_.back().constants] == own) return;
    const auto known = std::find(constants_.begin(), constants_.end(), own);
    runs_.push_back({body, static_cast<std::uint32_t>(known - constants_.begin())});
    if (known == constants_.end()) constants_.push_back(own);
  });
  assert(body_count_ == 0 || (!runs_.empty() && runs_.front().first == 0));
}

const BodyConstants& Validator::constants_of(std::uint32_t number) const {
  assert(has_body(number));
  const auto next = std::ranges::upper_bound(runs_, number, {}, &Run::first);
  return constants_[std::prev(next)->constants];
}

BodyState Validator::still(std::uint32_t number) const {
  const BodyConstants& own = constants_of(number);
  BodyState state;
  state.flight.radius = own.radius;
  state.mass = own.mass, state.inverse_mass = own.inverse_mass;
  state.half_extent = own.half_extent;
  state.kind = own.kind, state.material = own.material, state.half = own.half;
  state.drag = Vector2::Constant(puck_drag_);
  return state;
}

bool Validator::is_place(const Vector2& place) const {
  return is_number(place) && place.cwiseAbs().maxCoeff() <= reach_;
}

/// A group that moves as one has the mean of its bodies' drag, by their masses.
bool Validator::is_drag(double drag) const {
  return drag == 0.0 || (drag >= drag_min && drag <= drag_max_ * (1.0 + 1e-9));
}

/// True if the last event is not in the future, and the flight since then has stayed in reach.
bool Validator::is_on_its_way(const physics::Motion& motion, double now) const {
  if (!is_place(motion.position) || !(motion.velocity.norm() <= speed_max) ||
      !(motion.time >= 0.0 && motion.time <= now))
    return false;
  const physics::Motion then = motion.at(now);
  return is_place(then.position) && then.velocity.norm() <= speed_max;
}

std::string Validator::fault_of(const Handover::Body& body, double now) const {
  const BodyState& s = body.state;
  if (!has_body(body.number)) return named("hands over body", body.number, "which does not exist");
  if (BodyConstants::of(s) != constants_of(body.number))
    return named("hands over body", body.number,
                 "with a radius, mass, material or kind that the scene does not give it");
  const bool is_driven = is_within(s.thrust, acceleration_max) &&
                         is_within(s.acceleration, acceleration_max) &&
                         is_within(s.slowing, acceleration_max) && is_drag(s.drag.x()) &&
                         is_drag(s.drag.y()) && is_within(s.spin, spin_max);
  if (!is_driven)
    return named("hands over body", body.number,
                 "with an acceleration, drag or spin that is no number or too large");
  // Only what glides has a hop that goes on.
  const double hop_max = physics::Subdomain::is_frozen(s) ? now + glide_max_ : now;
  const bool is_counted = s.impacts_begin <= now && s.last_hop <= hop_max &&
                          s.repeats_instant <= now && std::isfinite(s.impacts_begin) &&
                          std::isfinite(s.last_hop) && std::isfinite(s.repeats_instant) &&
                          !std::isnan(s.rest_time);
  if (!is_counted)
    return named("hands over body", body.number, "with times that are no numbers or still to come");
  if (!physics::Subdomain::is_possible(s, body_count_))
    return named("hands over body", body.number, "in a state that does not exist");
  physics::Motion motion = s.motion();
  // A body out of play does not move.
  if (physics::Subdomain::is_out_of_play(s)) motion.velocity = motion.acceleration = {0.0, 0.0};
  return is_on_its_way(motion, now) && s.motion().velocity.norm() <= speed_max
             ? std::string()
             : named("hands over body", body.number, "at no place, speed or time");
}

std::string Validator::fault_of(const FreeFlightState& free_flights, double now) const {
  if (!has_body(free_flights.number))
    return named("hands over body", free_flights.number, "which does not exist");
  const physics::Motion motion{.time = free_flights.time,
                               .position = free_flights.position,
                               .velocity = free_flights.velocity,
                               .drag = Vector2::Constant(puck_drag_)};
  return is_on_its_way(motion, now)
             ? std::string()
             : named("hands over body", free_flights.number, "at no place, speed or time");
}

std::string Validator::fault_of(const RestContact& rest) const {
  const auto is_partner = [&](physics::Partner p) {
    return has_body(p) || (p >= physics::partner::field_parts && p <= physics::partner::halfway);
  };
  const auto is_moving = [&](physics::Partner p) {
    return has_body(p) && !is_of_kind(p, physics::BodyKind::post);
  };
  if (!is_partner(rest.low) || !is_partner(rest.high) || rest.low == rest.high)
    return "hands over a rest contact of body " + std::to_string(rest.low) + " with " +
           std::to_string(rest.high) + ", which cannot be";
  if (!is_moving(rest.low) && !is_moving(rest.high))
    return "hands over a rest contact of two that cannot move";
  const bool has_times = !std::isnan(rest.pull_time) && !std::isnan(rest.turn_time) &&
                         is_within(rest.force, force_max) && std::isfinite(rest.age.time);
  return has_times ? std::string()
                   : "hands over a rest contact whose times or force are no numbers";
}

std::string Validator::fault_of(const Key& key) const {
  if (is_of_kind(key.bat, physics::BodyKind::bat) && is_within(key.thrust, acceleration_max) &&
      std::isfinite(key.time))
    return {};
  return named("hands over a key of bat", key.bat,
               "which is none, or whose time or acceleration is no number or too large");
}

std::string Validator::fault_of(const Observation& observation) const {
  bool is_sound = is_of_kind(observation.bat, physics::BodyKind::bat) &&
                  std::isfinite(observation.time) && is_place(observation.position) &&
                  is_number(observation.velocity);
  for (const Observation::Puck& puck : observation.pucks)
    is_sound = is_sound && has_body(puck.number) && is_place(puck.position) &&
               is_number(puck.velocity) && std::isfinite(puck.radius) && puck.radius >= 0.0;
  return is_sound ? std::string() : named("shows bat", observation.bat, "as it cannot be");
}

std::string Validator::fault_of(const Press& press) const {
  if (is_of_kind(press.bat, physics::BodyKind::bat) && is_within(press.thrust, acceleration_max))
    return {};
  return named("presses a key of bat", press.bat,
               "which is none, or with an acceleration that no bat has");
}

template <class Item, class... Instant>
std::string Validator::first_fault(const std::vector<Item>& list, Instant... now) const {
  for (const Item& item : list)
    if (std::string fault = fault_of(item, now...); !fault.empty()) return fault;
  return {};
}

std::string Validator::fault_of_part(const Handover& message, double now) const {
  for (const std::string& fault :
       {first_fault(message.bodies, now), first_fault(message.free_flights, now),
        first_fault(message.rest_contacts), first_fault(message.keys),
        first_fault(message.observations)})
    if (!fault.empty()) return fault;
  return {};
}

std::string Validator::fault_of(const Handover& message, double now) const {
  if (std::string fault = fault_of_part(message, now); !fault.empty()) return fault;
  for (const Handover::Body& body : message.bodies)
    if (!has_its_holds(body, message.rest_contacts))
      return named("hands over body", body.number, "in a rest contact that it does not hand over");
  return {};
}

std::string Validator::fault_of(const Claims& message, double end) const {
  for (const Claims::Body& body : message.bodies)
    if (!has_body(body.number)) return named("claims body", body.number, "which does not exist");
  for (const ClaimedFlight& flight : message.flights)
    if (!(flight.begin >= 0.0 && flight.begin <= end + rounding_margin) ||
        !(flight.low_x <= flight.high_x) || !(flight.low_y <= flight.high_y))
      return "claims a flight through no place or at no time";
  return first_fault(message.presses);
}

std::string Validator::fault_of(const Verdict& message) const {
  for (const Goal& goal : message.goals)
    if (!is_of_kind(goal.puck, physics::BodyKind::puck))
      return named("claims a goal of puck", goal.puck, "which is none");
  for (const std::uint32_t body : message.wanted)
    if (!has_body(body)) return named("asks for body", body, "which does not exist");
  if (std::ranges::adjacent_find(message.wanted, std::ranges::greater_equal()) !=
      message.wanted.end())
    return "asks for bodies in no order";
  return first_fault(message.presses);
}

std::string Validator::fault_of(const PartChange& message, double now) const {
  for (const std::string& fault :
       {first_fault(message.bodies, now), first_fault(message.free_flights, now),
        first_fault(message.rest_contacts), first_fault(message.keys),
        fault_of_log(message.log, now)})
    if (!fault.empty()) return fault;
  for (const std::uint32_t body : message.gone)
    if (!has_body(body)) return named("gives away body", body, "which does not exist");
  for (const Handover::Body& body : message.bodies)
    if (!has_its_holds(body, message.rest_contacts))
      return named("sends body", body.number, "in a rest contact that it does not send");
  return message.time == now ? std::string() : "sends its part at another time";
}

std::string Validator::fault_of(const FaceOffWord& message, double now) const {
  if (!is_of_kind(message.puck, physics::BodyKind::puck))
    return named("sends puck", message.puck, "which is none");
  for (const Handover::Body& body : message.body)
    if (!physics::Subdomain::is_out_of_play(body.state))
      return named("sends puck", body.number, "in play, where it is to come back");
  return message.body.size() > 1 ? named("sends puck", message.puck, "more than once")
                                 : first_fault(message.body, now);
}

std::string Validator::fault_of_last(const Handover& message, double now) const {
  for (const std::string& fault :
       {first_fault(message.bodies, now), first_fault(message.free_flights, now),
        fault_of_log(message.keys, now)})
    if (!fault.empty()) return fault;
  return {};
}

std::string Validator::fault_of(const std::vector<Key>& keys) const { return first_fault(keys); }

std::string Validator::fault_of_log(const std::vector<Key>& log, double now) const {
  for (const Key& key : log)
    if (!(key.time >= 0.0 && key.time <= now))
      return named("logs a key of bat", key.bat, "that took effect before the start or not yet");
  return first_fault(log);
}

std::string Validator::fault_of(const Loss& message) const {
  for (const std::vector<PeerNumber>* peers : {&message.gone, &message.finished}) {
    const bool is_list =
        std::adjacent_find(peers->begin(), peers->end(), std::greater_equal<>()) == peers->end();
    if (!is_list || (!peers->empty() && peers->back() >= numbers_max))
      return "sends the loss of peers that never were";
  }
  if (std::ranges::adjacent_find(message.questions, std::ranges::greater_equal(),
                                 &Question::peer) != message.questions.end())
    return "asks for peers in no order";
  return {};
}

}  // namespace rink::peer
