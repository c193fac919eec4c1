// Gathering a cluster, and the speeds at which it hops.
#include "game/physics/engine/clusters.h"

#include <algorithm>
#include <cmath>

#include "game/physics/bodies/journal.h"
#include "game/physics/bodies/tolerances.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {
constexpr double glancing_part = 16.0;     // of contact_time
constexpr std::uint32_t long_series = 64;  // of hops
constexpr std::uint32_t rattling_series = 16;
constexpr double loose_gaps = 8.0;
constexpr std::size_t gliding_max = 96;    // contacts
constexpr double glide_turn = 1.0 / 64.0;  // of a normal during a glide [rad]
/// What a glide opens at most [m]: at its end the same bodies are a cluster still.
constexpr double glide_room = 0.75 * cluster_gap;
/// The least speed at which a hop parts contacts, relative to the speeds around: less than a few
/// roundings would be none. Its energy, 1e-24 of what there is, is below rounding.
constexpr Real parting_min = 1e-12 * fineness;
constexpr double creep_speed = 1e-9;  // m/s; without thrust, a cluster that moves no faster stops

/// Whoever does not know that the body comes may decide otherwise about a pile.
void record_sight(std::uint32_t body, const Observers& observers) {
  if (observers.journal != nullptr) observers.journal->sight.looked_at.push_back(body);
}
}  // namespace

Clusters::Clusters(const WorldSpec& spec, const Uses& uses)
    : spec_(spec),
      bodies_(uses.bodies),
      detection_(uses.detection),
      history_(uses.history),
      jams_(uses.jams),
      rests_(uses.rests),
      record_(uses.record),
      observers_(uses.observers),
      glide_max_(glide_max(spec)),
      rest_speed_(rest_speed(spec)) {}

bool Clusters::hop(const Contact& c, Real approach, Real pressing, Real time) {
  const Limits limits{cluster_gap, std::max<Real>(rest_speed_, 2.0 * approach)};
  gather(c, limits, time);
  if (should_flow(c)) {
    if (flow(c, time)) return true;
    gather(c, limits, time);
  }
  return hop_gathered({c, approach, pressing}, limits, time);
}

/// Large clusters do, and small ones whose hops do not end because light bodies rattle between
/// heavy ones, so that no glide of those who touch would last. At other hops they may freeze.
bool Clusters::should_flow(const Contact& c) const {
  const std::uint32_t hops = history_.hops(c.body);
  if (problem_.touches.size() > gliding_max) return hops % 4 == 0;
  return hops >= rattling_series && hops % 4 == 2 && history_.is_restless(c);
}

bool Clusters::hop_gathered(const Closing& closing, const Limits& limits, Real time) {
  const auto& [c, approach, pressing] = closing;
  const Real thrust = thrust_max();
  Real given_back = 1.0;
  for (const Touch& contact : problem_.touches)
    given_back = std::min(given_back, contact.restitution);
  const Real pressure = std::max(thrust, pressing);
  if (problem_.touches.size() < 2 && (pressure <= 0.0 || approach >= rest_speed_)) return false;
  if (pressure <= 0.0 && given_back == 1.0 && !is_rattling(approach) && !history_.is_jammed(c))
    return false;
  record_.note(EventKind::hop, time, c.body, c.partner);
  history_.note_hop(members_, time);
  const std::uint32_t hops = history_.hops(c.body) - 1;  // before this one
  const bool may_freeze = thrust > 0.0 && hops % 4 == 0,
             may_freeze_loosely = thrust > 0.0 && hops >= long_series && hops % 16 == 0;
  bool is_frozen = may_freeze && freeze(time);
  if (!is_frozen && may_freeze_loosely) {
    is_frozen = freeze_loosely(c, time);
    if (!is_frozen) gather(c, limits, time);
  }
  if (is_frozen) return record_.note(EventKind::freeze, time, c.body, c.partner), true;
  for (std::size_t place = 0; place < members_.size(); ++place)
    problem_.velocities[place] = bodies_.velocity(members_[place]);
  if (thrust == 0.0 && problem_.speed() < still_speed())
    std::fill(problem_.velocities.begin(), problem_.velocities.end(), RealVector(0.0, 0.0));
  else if (!glide(c, thrust, time)) part(pressure, pressing, thrust);
  for (std::size_t place = 0; place < members_.size(); ++place)
    bodies_.set_velocity(members_[place], problem_.velocities[place]);
  return true;
}

void Clusters::part(Real pressure, Real pressing, Real thrust) {
  const Real speed = problem_.speed(), least = parting_min * speed;
  const Real driven = std::max(least, std::clamp<Real>(0.5 * pressure * Real(spec_.contact_time),
                                                       0.0, 0.5 * rest_speed_)),
             sum = driven * static_cast<Real>(problem_.touches.size());
  const Real glancing = glancing_speed(thrust, pressing, speed);
  const bool is_glancing = glancing > driven;
  const Real separation = is_glancing ? glancing
                          : pressure > 0.0
                              ? driven
                              : std::max(least, 0.5 * turning() * Real(spec_.contact_time));
  const Real gain_max = 0.5 * mass() * (is_glancing ? glancing * glancing : sum * sum);
  record_.counters().hop_energy +=
      std::max(0.0, static_cast<double>(solver_.part(problem_, separation, gain_max)));
}

void Clusters::go_on(std::uint32_t body, Real time) {
  assert(bodies_[body].is(Body::frozen));
  const Contact c{body, partner::none, {}};
  const Limits limits{cluster_gap, rest_speed_};
  if (meet_within_pile(c, time)) return;
  rests_.rouse(body, time);
  gather(c, limits, time);
  if (has_turning()) hop_gathered({c, 0.0, 0.0}, limits, time);
}

/// Whether a contact's normal turns: faces alone come to rest on each other, without events.
bool Clusters::has_turning() const {
  return std::any_of(problem_.touches.begin(), problem_.touches.end(),
                     [](const Touch& touch) { return touch.reach > 0.0; });
}

Real Clusters::mass() const {
  Real sum = 0.0;
  for (const std::uint32_t body : members_) sum += bodies_.build(body).mass;
  return sum;
}

/// Lets the cluster move on in contact, under constant forces: one event, where hops would follow
/// each other every `contact_time`. Answers whether it could.
bool Clusters::glide(const Contact& c, Real thrust, Real time) {
  if (!(thrust > 0.0) || bodies_.is_slowed() || !has_turning() ||
      problem_.touches.size() > gliding_max || history_.is_restless(c))
    return false;
  velocities_ = problem_.velocities;
  Glide glide = glide_of(thrust, glide_turn, glide_room);
  const Real sum = glide.opening * static_cast<Real>(problem_.touches.size()),
             gain = solver_.part(problem_, glide.opening, 0.5 * mass() * sum * sum);
  glide.duration = std::min(glide.duration, glide_of(thrust, glide_turn, glide_room).duration);
  const bool is_jammed =
      std::any_of(problem_.touches.begin(), problem_.touches.end(),
                  [&](const Touch& touch) { return touch.wanted < glide.opening; });
  if (is_jammed || !find_forces(glide)) return problem_.velocities = velocities_, false;
  begin_glide(glide_solver_.accelerations(), time + glide.duration);
  record_.counters().hop_energy +=
      static_cast<double>(std::max<Real>(0.0, gain) + glide_solver_.work_max());
  return true;
}

bool Clusters::find_forces(const Glide& glide) {
  drives_.clear();
  for (const std::uint32_t body : members_)
    drives_.push_back({bodies_.build(body).thrust, bodies_.own_drag(body)});
  return glide_solver_.solve(problem_, drives_, glide);
}

/// With the velocities of the problem.
void Clusters::begin_glide(const std::vector<RealVector>& accelerations, Real end) {
  for (std::size_t place = 0; place < members_.size(); ++place)
    bodies_.set_velocity(members_[place], problem_.velocities[place]);
  jams_.glide(members_, accelerations, end);
}

/// As long as normals keep their directions within `glide_turn`, and no contact leaves its face.
/// The opening makes room for what constant forces do to a gap on the way, (t/T)^2 (1 - t/T) of the
/// third derivative times T^3/6, the normals turning as fast as they do at the end. It is at most
/// `room` [m] if T is longer than `contact_time`.
Glide Clusters::glide_of(Real thrust, Real turn, Real room) const {
  Real rate = 0.0, nearest = infinity, drag = 0.0;
  for (const Touch& touch : problem_.touches) {
    if (!(touch.reach > 0.0)) continue;
    const RealVector there =
        touch.other == fixed_place ? RealVector(0.0, 0.0) : problem_.velocities[touch.other];
    const RealVector velocity = problem_.velocities[touch.body] - there;
    rate =
        std::max(rate, std::abs(touch.normal.x() * velocity.y() - touch.normal.y() * velocity.x()) /
                           touch.reach);
    nearest = std::min(nearest, touch.reach);
  }
  for (const std::uint32_t body : members_) drag = std::max(drag, bodies_.own_drag(body));
  const auto opening = [&](Real duration) {
    return (3.0 * (rate + thrust * duration / nearest) + drag) * thrust * duration * duration / 6.0;
  };
  Real duration = std::clamp<Real>(
      std::min({turn / rate, std::sqrt(2.0 * turn * nearest / thrust), clear_time_}),
      Real(spec_.contact_time), glide_max_);
  for (Real excess = opening(duration) * duration / room;
       excess > 1.0 && duration > Real(spec_.contact_time);
       excess = opening(duration) * duration / room)
    duration = std::max(Real(spec_.contact_time), 0.99 * duration / std::sqrt(std::sqrt(excess)));
  return {duration, std::max(Real(parting_min) * problem_.speed(),
                             std::min<Real>(opening(duration), 0.5 * rest_speed_))};
}

void Clusters::stop_around(const Contact& c, Real time) {
  gather(c, {cluster_gap, infinity}, time);
  record_.note(EventKind::freeze, time, c.body, c.partner);
  jams_.stop(members_);
}

/// Whether friction may stop bodies of the cluster between impacts whose closing speed `approach`
/// [m/s] is a rounding of a body's speed. Lossless impacts would then go on for ever, a few
/// roundings of the clock apart, and no place would change.
bool Clusters::is_rattling(Real approach) const {
  return bodies_.is_slowed() &&
         std::any_of(members_.begin(), members_.end(), [&](std::uint32_t body) {
           return approach <= Real(parting_min) * bodies_.velocity(body).norm();
         });
}

/// The strongest thrust in the cluster [m/s^2].
Real Clusters::thrust_max() const {
  Real most = 0.0;
  for (const std::uint32_t body : members_)
    most = std::max(most, bodies_.build(body).thrust.norm());
  return most;
}

/// The acceleration at which contacts close because their normals turn, at most [m/s^2]: v^2/R.
Real Clusters::turning() const {
  Real most = 0.0;
  for (const Touch& c : problem_.touches) {
    const bool is_partner_moved = c.other != fixed_place;
    const RealVector there = is_partner_moved ? problem_.velocities[c.other] : RealVector(0.0, 0.0);
    const Real reach = bodies_[members_[c.body]].radius +
                       (is_partner_moved ? bodies_[members_[c.other]].radius : Real(0.0));
    if (reach > 0.0)
      most = std::max(most, (problem_.velocities[c.body] - there).squaredNorm() / reach);
  }
  return most;
}

/// Pucks that nothing but their friction presses together hop further than others, as if they met
/// for 16 `contact_time`: that presses weakly and only until they rest. During the flight friction
/// takes more energy than the hop gives, for they are faster than twice the hop.
Real Clusters::glancing_speed(Real thrust, Real pressing, Real speed) const {
  const Real apart = 0.5 * pressing * Real(glancing_part) * Real(spec_.contact_time);
  return bodies_.is_slowed() && thrust == 0.0 && speed > 2.0 * apart ? apart : Real(0.0);
}

/// What moves no faster than this, and is not driven, stops [m/s]: pucks that friction would stop
/// within `contact_time`, and anything that merely creeps.
Real Clusters::still_speed() const {
  const bool is_slowed_down =
      std::all_of(members_.begin(), members_.end(),
                  [&](std::uint32_t body) { return bodies_.is_slowed(body); });
  return is_slowed_down
             ? std::max<Real>(creep_speed, spec_.puck_friction * Real(spec_.contact_time))
             : Real(creep_speed);
}

std::uint32_t Clusters::place_of(std::uint32_t body, const Limits& limits, Real time) {
  if (is_member(body)) return places_[body];
  limits.sight > 0.0 ? rests_.rebase_group(body, time) : rests_.free(body, time);
  places_[body] = static_cast<std::uint32_t>(members_.size());
  members_.push_back(body);
  problem_.add_body(bodies_.build(body).mass, bodies_.build(body).inverse_mass,
                    bodies_.velocity(body), bodies_.is_slowed(body));
  return places_[body];
}

void Clusters::add_contact(std::uint32_t place, Partner p, const Limits& limits, Real time) {
  const std::uint32_t body = members_[place];
  const bool is_known = is_body(p) && is_member(p);
  if (is_known && places_[p] < place) return;  // from its side
  const std::optional<Contact> near =
      detection_.contact_within(body, p, std::max(limits.gap, limits.sight), time);
  if (!near) return;
  const Contact& c = *near;
  const RealVector there =
      bodies_.is_fixed(p) ? RealVector(0.0, 0.0) : motion_at(bodies_, p, time).velocity;
  const Real opening = c.gap.normal.dot(bodies_.velocity(body) - there);
  if (c.gap.distance > limits.gap) {
    if (opening >= 0.0) return;
    const Real clear = c.gap.distance / -opening;
    clear_time_ = std::min(clear_time_, clear);
    if (clear <= glide_max_ && !bodies_.is_fixed(p)) record_sight(p, observers_);
    return;
  }
  if (std::abs(opening) > limits.speed) return;
  Touch touch{place, fixed_place, c.gap.normal, detection_.restitution(body, p)};
  touch.gap = c.gap.distance, touch.reach = reach_of(c);
  if (is_body(p)) limit_by_face(c, time);
  if (bodies_.is_fixed(p)) return problem_.touches.push_back(touch);
  if (!is_known && members_.size() >= limits.members) return;
  touch.other = place_of(p, limits, time);
  problem_.touches.push_back(touch);
}

/// How far the point is about which the normal turns [m]; 0 for a face.
Real Clusters::reach_of(const Contact& c) const {
  if (c.gap.face < 0) return c.gap.line.norm();
  if (is_body(c.partner)) {
    const RoundedBox shape = shape_of(bodies_, c.body, c.partner);
    return shape.half_extent[1 - c.gap.face] > 0.0 ? Real(0.0) : shape.radius + c.gap.distance;
  }
  return c.partner >= partner::edge_left_low ? bodies_[c.body].radius + c.gap.distance : Real(0.0);
}

/// No glide goes beyond the end of a face.
void Clusters::limit_by_face(const Contact& c, Real time) {
  if (c.gap.face < 0) return;
  const int along = 1 - c.gap.face;
  const Motion here = motion_at(bodies_, c.body, time), there = motion_at(bodies_, c.partner, time);
  const Real extent = shape_of(bodies_, c.body, c.partner).half_extent[along],
             speed = here.velocity[along] - there.velocity[along],
             offset = here.position[along] - there.position[along];
  if (extent > 0.0 && speed != 0.0)
    clear_time_ =
        std::min(clear_time_, (extent - std::copysign(offset, offset * speed)) / std::abs(speed));
}

/// Everybody connected with the contact within the limits, in an order that depends on ids alone.
void Clusters::gather(const Contact& c, const Limits& limits, Real time) {
  members_.clear();
  places_.resize(bodies_.count());
  problem_.clear();
  clear_time_ = infinity;
  if (observers_.journal != nullptr)
    observers_.journal->sight.reach = std::max(observers_.journal->sight.reach, limits.sight);
  place_of(c.body, limits, time);
  if (!bodies_.is_fixed(c.partner)) place_of(c.partner, limits, time);
  for (std::uint32_t place = 0; place < members_.size() && clear_time_ >= limits.clear; ++place) {
    const auto add = [&](Partner p) { add_contact(place, p, limits, time); };
    limits.sight > 0.0 ? detection_.visit_all_within(members_[place], limits.sight, time, add)
                       : detection_.visit_partners_within(members_[place], limits.gap, time, add);
  }
}

/// Ends what a slow cluster whose contacts and friction can bear all its thrust moves against
/// itself, for as long as nothing else acts on it. Answers whether it could. It drifts on as one,
/// for nothing takes its momentum, or stops where something fixed touches it, friction with the
/// table holds it, or drag would part it.
bool Clusters::freeze(Real time) {
  for (std::size_t place = 0; place < members_.size(); ++place) {
    problem_.velocities[place] = bodies_.velocity(members_[place]);
    if (problem_.velocities[place].norm() > rest_speed_) return false;
  }
  const bool may_drift = !bodies_.is_slowed() && share_drag();
  const Real remaining = 1e-6 * thrust_max();
  const std::optional<RealVector> common =
      common_velocity(may_drift ? drift() : RealVector(0.0, 0.0), [&](const RealVector& velocity) {
        load_thrust(velocity);
        return solver_.bears(loads_, spec_.puck_friction, remaining);
      });
  if (!common) return false;
  if (common->norm() <= Real(creep_speed)) jams_.stop(members_);
  else move_as_one(*common, time);
  return true;
}

/// A pile that hops for long is seldom in contact everywhere at once: gaps eight times as wide
/// count as closed for the question whether it could stand. Leaves another cluster gathered.
bool Clusters::freeze_loosely(const Contact& c, Real time) {
  gather(c, {loose_gaps * cluster_gap, infinity}, time);
  return freeze(time);
}

}  // namespace rink::physics::inline RINK_PRECISION
