// Pressed clusters whose normals turn: taken out of contact in one step, and frozen where they are in equilibrium.
#include <algorithm>

#include "game/physics/engine.h"

namespace rink::physics {

namespace {
constexpr std::uint32_t slow_impacts_max = 8;     // within contact_time, before a hop
constexpr std::uint32_t impacts_max = 24;         // likewise, whatever their speed, where impacts lose energy
constexpr std::size_t cluster_max = 256;
constexpr double creep_speed = 1e-9;              // m/s; without thrust, a cluster that moves no faster stops
}  // namespace

template <class Real>
bool BasicEngine<Real>::is_pressed_hard(std::uint32_t body, Partner p, Real approach, Real time) const {
  const auto is_worn = [&](std::uint32_t b) {
    const Rhythm& rhythm = rhythms_[b];
    if (rhythm.impacts >= impacts_max) return true;
    return approach < rest_speed && (rhythm.impacts >= slow_impacts_max || (rhythm.last_hop >= 0.0 && time - rhythm.last_hop < 4.0 * contact_time));
  };
  return is_worn(body) || (!is_fixed(p) && is_worn(p));
}

/// Gives the cluster around `c` the nearest velocities (in the metric of the masses) that part all its contacts by a little: half of what its thrust, or the difference
/// in drag that closes `c` by `pressing`, builds up within `contact_time`. False, with nothing done to velocities, if an ordinary impact serves: nothing presses, and
/// nothing is lost or the contact is alone.
template <class Real>
bool BasicEngine<Real>::hop(const Contact& c, Real approach, Real pressing, Real time) {
  gather(c, std::max<Real>(rest_speed, 2.0 * approach), time);
  Real thrust_max = 0.0, given_back = 1.0;
  for (const std::uint32_t body : cluster_) thrust_max = std::max(thrust_max, builds_[body].thrust.norm());
  for (const ClusterContact& contact : cluster_contacts_) given_back = std::min(given_back, contact.restitution);
  const Real pressure = std::max(thrust_max, pressing);
  if (cluster_contacts_.size() < 2 && (pressure <= 0.0 || approach >= rest_speed)) return false;
  if (pressure <= 0.0 && given_back == 1.0) return false;
  note(EventKind::hop, time, c.body, c.partner);
  bool may_freeze = thrust_max > 0.0;
  for (const std::uint32_t body : cluster_) {
    Rhythm& rhythm = rhythms_[body];
    if (time - rhythm.last_hop > 8.0 * contact_time) rhythm.hops = 0;
    rhythm.last_hop = time;
  }
  may_freeze = may_freeze && rhythms_[c.body].hops % 4 == 0;
  for (const std::uint32_t body : cluster_) ++rhythms_[body].hops;
  if (may_freeze && freeze(thrust_max)) {
    note(EventKind::freeze, time, c.body, c.partner);
    return true;
  }
  cluster_velocities_.clear();
  for (const std::uint32_t body : cluster_) cluster_velocities_.push_back(velocity_of(body));
  Real speed = 0.0;
  for (const Vector2& velocity : cluster_velocities_) speed = std::max(speed, velocity.norm());
  if (thrust_max == 0.0 && speed < creep_speed) std::fill(cluster_velocities_.begin(), cluster_velocities_.end(), Vector2(0.0, 0.0));
  else solve_cluster(std::max(std::clamp<Real>(0.5 * pressure * contact_time, 0.0, 0.5 * rest_speed), 1e-12 * fineness<Real> * speed));
  for (std::size_t place = 0; place < cluster_.size(); ++place) {
    bodies_[cluster_[place]].vx = cluster_velocities_[place].x();
    bodies_[cluster_[place]].vy = cluster_velocities_[place].y();
  }
  return true;
}

template <class Real>
std::uint32_t BasicEngine<Real>::place_in_cluster(std::uint32_t body, Real time) {
  const auto found = std::find(cluster_.begin(), cluster_.end(), body);
  if (found != cluster_.end()) return static_cast<std::uint32_t>(found - cluster_.begin());
  wake(body, time);
  for (int axis = 0; axis < 2; ++axis) dissolve(body, axis, time);
  rebase(body, time);
  cluster_.push_back(body);
  return static_cast<std::uint32_t>(cluster_.size() - 1);
}

template <class Real>
void BasicEngine<Real>::add_contact(std::uint32_t place, Partner p, Real speed_max, Real time) {
  const std::uint32_t body = cluster_[place];
  const Contact c = contact(body, p, time);
  if (c.gap.distance > cluster_gap) return;
  const Vector2 there = is_fixed(p) ? Vector2(0.0, 0.0) : at(p, time).velocity;
  if (std::abs(c.gap.normal.dot(velocity_of(body) - there)) > speed_max) return;
  if (is_fixed(p)) {
    cluster_contacts_.push_back({place, fixed_place, c.gap.normal, 0.0, restitution(body, p)});
    return;
  }
  const bool is_known = std::find(cluster_.begin(), cluster_.end(), p) != cluster_.end();
  if (!is_known && cluster_.size() >= cluster_max) return;
  const std::uint32_t other = place_in_cluster(p, time);
  if (other > place) cluster_contacts_.push_back({place, other, c.gap.normal, 0.0, restitution(body, p)});
}

/// Every body connected with the contact by gaps below `cluster_gap` that close or open no faster than `speed_max`, in an order that depends on ids alone.
template <class Real>
void BasicEngine<Real>::gather(const Contact& c, Real speed_max, Real time) {
  cluster_.clear();
  cluster_contacts_.clear();
  place_in_cluster(c.body, time);
  if (!is_fixed(c.partner)) place_in_cluster(c.partner, time);
  std::vector<std::uint32_t> near;
  for (std::uint32_t place = 0; place < cluster_.size(); ++place) {
    const std::uint32_t body = cluster_[place];
    near.clear();
    grid_.around(grid_.column_of(body), grid_.row_of(body), -1, 1, -1, 1, [&](std::uint32_t other) {
      if (other != body) near.push_back(other);
    });
    std::sort(near.begin(), near.end());
    for (const std::uint32_t other : near) add_contact(place, other, speed_max, time);
    const bool is_in_mouth = bodies_[body].mouth != no_mouth;
    for (Partner wall = partner::wall_left; wall <= partner::wall_top; ++wall)
      if (!(is_in_mouth && wall <= partner::wall_right)) add_contact(place, wall, speed_max, time);
    if (spec_.field.bats_keep_to_half && bodies_[body].kind == BodyKind::bat && builds_[body].half != Half::both) add_contact(place, partner::halfway, speed_max, time);
    if (spec_.field.goal_width > 0.0 && bodies_[body].kind == BodyKind::puck)
      for (Partner edge = partner::edge_left_low; edge <= partner::edge_right_high; ++edge) add_contact(place, edge, speed_max, time);
  }
}

/// Projects `cluster_velocities_` onto those that open every contact by at least `separation`: Gauss-Seidel on impulses, least change in the metric of the masses.
template <class Real>
void BasicEngine<Real>::solve_cluster(Real separation) {
  const auto yielding = [&](std::uint32_t place) { return place == fixed_place ? 0.0 : builds_[cluster_[place]].inverse_mass; };
  Real scale = separation;
  for (const Vector2& velocity : cluster_velocities_) scale = std::max(scale, velocity.norm());
  const Real accuracy = separation > 0.0 ? 0.1 * separation : 1e-9 * scale;
  for (ClusterContact& c : cluster_contacts_) c.impulse = 0.0;
  for (int sweep = 0; sweep < 500; ++sweep) {
    Real change = 0.0;
    for (ClusterContact& c : cluster_contacts_) {
      const Real own = yielding(c.body), other = yielding(c.partner);
      const Vector2 there = c.partner == fixed_place ? Vector2(0.0, 0.0) : cluster_velocities_[c.partner];
      const Real lacking = separation - c.normal.dot(cluster_velocities_[c.body] - there);
      const Real impulse = std::max<Real>(0.0, c.impulse + lacking / (own + other)), step = impulse - c.impulse;
      c.impulse = impulse;
      cluster_velocities_[c.body] += step * own * c.normal;
      if (c.partner != fixed_place) cluster_velocities_[c.partner] -= step * other * c.normal;
      change = std::max(change, std::abs(step) * (own + other));
    }
    if (change <= accuracy) return;
  }
}

/// Brings a slow cluster whose contacts can bear all its thrust to a stop, for as long as nothing else acts on it. Answers whether it could.
template <class Real>
bool BasicEngine<Real>::freeze(Real thrust_max) {
  cluster_velocities_.clear();
  for (const std::uint32_t body : cluster_) {
    if (velocity_of(body).norm() > rest_speed) return false;
    cluster_velocities_.push_back(builds_[body].thrust);
  }
  solve_cluster(0.0);
  for (const Vector2& acceleration : cluster_velocities_)
    if (acceleration.norm() > 1e-6 * thrust_max) return false;
  stop_cluster();
  return true;
}

template class BasicEngine<double>;
template class BasicEngine<long double>;

}  // namespace rink::physics
