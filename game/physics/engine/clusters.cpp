// Gathering a cluster, and the speeds at which it hops.
#include "game/physics/engine/clusters.h"

#include <algorithm>
#include <cmath>

#include "game/physics/bodies/tolerances.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {
constexpr std::size_t cluster_max = 256;
constexpr double glancing_part = 16.0;     // of contact_time
constexpr std::uint32_t long_series = 64;  // of hops
constexpr double loose_gaps = 8.0;
/// The least speed at which a hop parts contacts, relative to the speeds around: less than a few
/// roundings would be none. Its energy, 1e-24 of what there is, is below rounding.
constexpr Real parting_min = 1e-12 * fineness;
constexpr double creep_speed = 1e-9;  // m/s; without thrust, a cluster that moves no faster stops
}  // namespace

Clusters::Clusters(const WorldSpec& spec, const Uses& uses)
    : bodies_(uses.bodies),
      detection_(uses.detection),
      history_(uses.history),
      jams_(uses.jams),
      rests_(uses.rests),
      record_(uses.record),
      puck_friction_(spec.puck_friction),
      contact_time_(spec.contact_time),
      rest_speed_(rest_speed(spec)) {}

bool Clusters::hop(const Contact& c, Real approach, Real pressing, Real time) {
  const Limits limits{cluster_gap, std::max<Real>(rest_speed_, 2.0 * approach)};
  gather(c, limits, time);
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
  bool is_frozen = may_freeze && freeze();
  if (!is_frozen && may_freeze_loosely) {
    is_frozen = freeze_loosely(c, time);
    if (!is_frozen) gather(c, limits, time);
  }
  if (is_frozen) return record_.note(EventKind::freeze, time, c.body, c.partner), true;
  for (std::size_t place = 0; place < members_.size(); ++place)
    problem_.velocities[place] = bodies_.velocity(members_[place]);
  if (thrust == 0.0 && problem_.speed() < still_speed())
    std::fill(problem_.velocities.begin(), problem_.velocities.end(), RealVector(0.0, 0.0));
  else part(pressure, pressing, thrust);
  for (std::size_t place = 0; place < members_.size(); ++place)
    bodies_.set_velocity(members_[place], problem_.velocities[place]);
  return true;
}

void Clusters::part(Real pressure, Real pressing, Real thrust) {
  const Real speed = problem_.speed(), least = parting_min * speed;
  const Real driven = std::max(
                 least, std::clamp<Real>(0.5 * pressure * contact_time_, 0.0, 0.5 * rest_speed_)),
             sum = driven * static_cast<Real>(problem_.touches.size());
  Real mass = 0.0;
  for (const std::uint32_t body : members_) mass += bodies_.build(body).mass;
  const Real glancing = glancing_speed(thrust, pressing, speed);
  const bool is_glancing = glancing > driven;
  const Real separation = is_glancing      ? glancing
                          : pressure > 0.0 ? driven
                                           : std::max(least, 0.5 * turning() * contact_time_);
  const Real gain_max = is_glancing ? 0.5 * mass * glancing * glancing : 0.5 * mass * sum * sum;
  record_.counters().hop_energy +=
      std::max(0.0, static_cast<double>(solver_.part(problem_, separation, gain_max)));
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
  const Real apart = 0.5 * pressing * Real(glancing_part) * contact_time_;
  return bodies_.is_slowed() && thrust == 0.0 && speed > 2.0 * apart ? apart : Real(0.0);
}

/// What moves no faster than this, and is not driven, stops [m/s]: pucks that friction would stop
/// within `contact_time`, and anything that merely creeps.
Real Clusters::still_speed() const {
  const bool is_slowed_down =
      std::all_of(members_.begin(), members_.end(),
                  [&](std::uint32_t body) { return bodies_.is_slowed(body); });
  return is_slowed_down ? std::max<Real>(creep_speed, puck_friction_ * contact_time_)
                        : Real(creep_speed);
}

std::uint32_t Clusters::place_of(std::uint32_t body, Real time) {
  const auto found = std::find(members_.begin(), members_.end(), body);
  if (found != members_.end()) return static_cast<std::uint32_t>(found - members_.begin());
  rests_.free(body, time);
  members_.push_back(body);
  problem_.add_body(bodies_.build(body).mass, bodies_.build(body).inverse_mass,
                    bodies_.velocity(body), bodies_.is_slowed(body));
  return static_cast<std::uint32_t>(members_.size() - 1);
}

void Clusters::add_contact(std::uint32_t place, Partner p, const Limits& limits, Real time) {
  const std::uint32_t body = members_[place];
  const Contact c = detection_.contact(body, p, time);
  if (c.gap.distance > limits.gap) return;
  const RealVector there =
      bodies_.is_fixed(p) ? RealVector(0.0, 0.0) : motion_at(bodies_, p, time).velocity;
  if (std::abs(c.gap.normal.dot(bodies_.velocity(body) - there)) > limits.speed) return;
  if (bodies_.is_fixed(p)) {
    problem_.touches.push_back({place, fixed_place, c.gap.normal, detection_.restitution(body, p)});
    return;
  }
  const bool is_known = std::find(members_.begin(), members_.end(), p) != members_.end();
  if (!is_known && members_.size() >= cluster_max) return;
  const std::uint32_t other = place_of(p, time);
  if (other > place)
    problem_.touches.push_back({place, other, c.gap.normal, detection_.restitution(body, p)});
}

/// Everybody connected with the contact within the limits, in an order that depends on ids alone.
void Clusters::gather(const Contact& c, const Limits& limits, Real time) {
  members_.clear();
  problem_.clear();
  place_of(c.body, time);
  if (!bodies_.is_fixed(c.partner)) place_of(c.partner, time);
  for (std::uint32_t place = 0; place < members_.size(); ++place)
    detection_.visit_partners(members_[place],
                              [&](Partner p) { add_contact(place, p, limits, time); });
}

/// Brings a slow cluster whose contacts and friction can bear all its thrust to a stop, for as long
/// as nothing else acts on it. Answers whether it could.
bool Clusters::freeze() {
  for (std::size_t place = 0; place < members_.size(); ++place) {
    if (bodies_.velocity(members_[place]).norm() > rest_speed_) return false;
    problem_.velocities[place] = bodies_.build(members_[place]).thrust;
  }
  if (!solver_.bears(problem_, puck_friction_, 1e-6 * thrust_max())) return false;
  jams_.stop(members_);
  return true;
}

/// A pile that hops for long is seldom in contact everywhere at once: gaps eight times as wide
/// count as closed for the question whether it could stand. Leaves another cluster gathered.
bool Clusters::freeze_loosely(const Contact& c, Real time) {
  gather(c, {loose_gaps * cluster_gap, infinity}, time);
  return freeze();
}

}  // namespace rink::physics::inline RINK_PRECISION
