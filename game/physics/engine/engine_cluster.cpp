// Pressed clusters whose normals turn: taken out of contact in one step, and frozen where they are
// in equilibrium.
#include <algorithm>
#include <limits>

#include "game/physics/engine/engine.h"

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

/// Gives the cluster around `c` the nearest velocities (in the metric of the masses) that part all
/// its contacts by a little: half of what its thrust, or the difference in drag that closes `c` by
/// `pressing`, builds up within `contact_time`. False, with nothing done to velocities, if an
/// ordinary impact serves: nothing presses, and nothing is lost or the contact is alone.
bool Engine::hop(const Contact& c, Real approach, Real pressing, Real time) {
  gather(c, std::max<Real>(rest_speed_, 2.0 * approach), time);
  const Real thrust_max = joint_thrust();
  Real given_back = 1.0;
  for (const Touch& contact : problem_.touches)
    given_back = std::min(given_back, contact.restitution);
  const Real pressure = std::max(thrust_max, pressing);
  if (problem_.touches.size() < 2 && (pressure <= 0.0 || approach >= rest_speed_)) return false;
  if (pressure <= 0.0 && given_back == 1.0 && !is_rattling(approach) && !history_.is_hemmed_in(c))
    return false;
  record_.note(EventKind::hop, time, c.body, c.partner);
  bool may_freeze = thrust_max > 0.0;
  history_.note_hop(joint_, time);
  const std::uint32_t hops = history_.hops(c.body) - 1;  // before this one
  if (may_freeze && ((hops % 4 == 0 && freeze(thrust_max)) ||
                     (hops >= long_series && hops % 16 == 0 &&
                      freeze_loosely(c, std::max<Real>(rest_speed_, 2.0 * approach), time)))) {
    record_.note(EventKind::freeze, time, c.body, c.partner);
    return true;
  }
  for (std::size_t place = 0; place < joint_.size(); ++place)
    problem_.velocities[place] = bodies_.velocity(joint_[place]);
  const Real speed = problem_.speed();
  if (thrust_max == 0.0 && speed < still_speed()) {
    std::fill(problem_.velocities.begin(), problem_.velocities.end(), RealVector(0.0, 0.0));
  } else {
    const Real least = parting_min * speed;
    const Real driven = std::max(
                   least, std::clamp<Real>(0.5 * pressure * contact_time_, 0.0, 0.5 * rest_speed_)),
               sum = driven * static_cast<Real>(problem_.touches.size());
    Real mass = 0.0;
    for (const std::uint32_t body : joint_) mass += bodies_.build(body).mass;
    const Real glancing = glancing_speed(thrust_max, pressing, speed);
    const Real gained =
        glancing > driven
            ? separation_solver_.part(problem_, glancing, 0.5 * mass * glancing * glancing)
            : separation_solver_.part(
                  problem_,
                  pressure > 0.0 ? driven : std::max(least, 0.5 * turning() * contact_time_),
                  0.5 * mass * sum * sum);
    counters_.hop_energy += std::max(0.0, static_cast<double>(gained));
  }
  for (std::size_t place = 0; place < joint_.size(); ++place) {
    bodies_.set_velocity(joint_[place], problem_.velocities[place]);
  }
  return true;
}

/// Whether friction may stop bodies of the cluster between impacts whose closing speed `approach`
/// [m/s] is a rounding of a body's speed. Lossless impacts would then go on for ever, a few
/// roundings of the clock apart, and no place would change.
bool Engine::is_rattling(Real approach) const {
  return bodies_.is_slowed() && std::any_of(joint_.begin(), joint_.end(), [&](std::uint32_t body) {
           return approach <= Real(parting_min) * bodies_.velocity(body).norm();
         });
}

/// The strongest thrust in the cluster [m/s^2].
Real Engine::joint_thrust() const {
  Real most = 0.0;
  for (const std::uint32_t body : joint_) most = std::max(most, bodies_.build(body).thrust.norm());
  return most;
}

/// The acceleration at which contacts close because their normals turn, at most [m/s^2]: v^2/R.
Real Engine::turning() const {
  Real most = 0.0;
  for (const Touch& c : problem_.touches) {
    const bool is_partner_moved = c.other != fixed_place;
    const RealVector there = is_partner_moved ? problem_.velocities[c.other] : RealVector(0.0, 0.0);
    const Real reach = bodies_[joint_[c.body]].radius +
                       (is_partner_moved ? bodies_[joint_[c.other]].radius : Real(0.0));
    if (reach > 0.0)
      most = std::max(most, (problem_.velocities[c.body] - there).squaredNorm() / reach);
  }
  return most;
}

/// Pucks that nothing but their friction presses together hop further than others, as if they met
/// for 16 `contact_time`: that presses weakly and only until they rest. During the flight friction
/// takes more energy than the hop gives, for they are faster than twice the hop.
Real Engine::glancing_speed(Real thrust_max, Real pressing, Real speed) const {
  const Real apart = 0.5 * pressing * Real(glancing_part) * contact_time_;
  return bodies_.is_slowed() && thrust_max == 0.0 && speed > 2.0 * apart ? apart : Real(0.0);
}

/// What moves no faster than this, and is not driven, stops [m/s]: pucks that friction would stop
/// within `contact_time`, and anything that merely creeps.
Real Engine::still_speed() const {
  const bool is_slowed_down = std::all_of(
      joint_.begin(), joint_.end(), [&](std::uint32_t body) { return bodies_.is_slowed(body); });
  return is_slowed_down ? std::max<Real>(creep_speed, spec_.puck_friction * contact_time_)
                        : Real(creep_speed);
}

std::uint32_t Engine::place_in_cluster(std::uint32_t body, Real time) {
  const auto found = std::find(joint_.begin(), joint_.end(), body);
  if (found != joint_.end()) return static_cast<std::uint32_t>(found - joint_.begin());
  jams_.wake(body, time);
  for (int axis = 0; axis < 2; ++axis) rests_.dissolve(body, axis, time);
  bodies_.rebase(body, time);
  joint_.push_back(body);
  problem_.add_body(bodies_.build(body).mass, bodies_.build(body).inverse_mass,
                    bodies_.velocity(body), bodies_.is_slowed(body));
  return static_cast<std::uint32_t>(joint_.size() - 1);
}

void Engine::add_contact(std::uint32_t place, Partner p, Real speed_max, Real time) {
  const std::uint32_t body = joint_[place];
  const Contact c = detection_.contact(body, p, time);
  if (c.gap.distance > gap_max_) return;
  const RealVector there =
      bodies_.is_fixed(p) ? RealVector(0.0, 0.0) : motion_at(bodies_, p, time).velocity;
  if (std::abs(c.gap.normal.dot(bodies_.velocity(body) - there)) > speed_max) return;
  if (bodies_.is_fixed(p)) {
    problem_.touches.push_back({place, fixed_place, c.gap.normal, detection_.restitution(body, p)});
    return;
  }
  const bool is_known = std::find(joint_.begin(), joint_.end(), p) != joint_.end();
  if (!is_known && joint_.size() >= cluster_max) return;
  const std::uint32_t other = place_in_cluster(p, time);
  if (other > place)
    problem_.touches.push_back({place, other, c.gap.normal, detection_.restitution(body, p)});
}

/// Every body connected with the contact by gaps below `cluster_gap` that close or open no faster
/// than `speed_max`, in an order that depends on ids alone.
void Engine::gather(const Contact& c, Real speed_max, Real time) {
  joint_.clear();
  problem_.clear();
  place_in_cluster(c.body, time);
  if (!bodies_.is_fixed(c.partner)) place_in_cluster(c.partner, time);
  for (std::uint32_t place = 0; place < joint_.size(); ++place)
    detection_.visit_partners(joint_[place],
                              [&](Partner p) { add_contact(place, p, speed_max, time); });
}

/// Brings a slow cluster whose contacts and friction can bear all its thrust to a stop, for as long
/// as nothing else acts on it. Answers whether it could.
bool Engine::freeze(Real thrust_max) {
  for (std::size_t place = 0; place < joint_.size(); ++place) {
    if (bodies_.velocity(joint_[place]).norm() > rest_speed_) return false;
    problem_.velocities[place] = bodies_.build(joint_[place]).thrust;
  }
  if (!separation_solver_.bears(problem_, spec_.puck_friction, 1e-6 * thrust_max)) return false;
  jams_.stop(joint_);
  return true;
}

/// A pile that hops for long is seldom in contact everywhere at once: gaps eight times as wide
/// count as closed for the question whether it could stand. If it could not, the cluster is what
/// gather() found before.
bool Engine::freeze_loosely(const Contact& c, Real speed_max, Real time) {
  gap_max_ = loose_gaps * cluster_gap;
  gather(c, std::numeric_limits<Real>::infinity(), time);
  gap_max_ = cluster_gap;
  if (freeze(joint_thrust())) return true;
  gather(c, speed_max, time);
  return false;
}

}  // namespace rink::physics::inline RINK_PRECISION
