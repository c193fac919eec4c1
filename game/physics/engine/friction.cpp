// The law of sliding, and arcs of friction that turns.
#include "game/physics/engine/friction.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/physics/bodies/tolerances.h"
#include "game/physics/flight/exponential.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {

/// By so much the velocity of a pushed puck turns [rad] before its friction is aimed anew; what the
/// arc's middle then misses is below turn_max^2/24 of it.
constexpr double turn_max = 1.0 / 128.0;
/// Or its speed changes by this part, for the turn slows down as the speed grows.
constexpr double growth_max = 0.25;
/// What friction has slowed to this has stopped [m/s]: far above the rounding of a velocity at its
/// zero, far below what moves a body by a rounding in a millisecond.
constexpr double calm_speed = 1e-9;

/// The time in which a push against it takes a speed away; infinite if it does not.
Real speed_lost(Real speed, Real push, Real drag) {
  if (!(speed * push < 0.0)) return infinity;
  return drag == 0.0 ? -speed / push : log1p_of(-drag * speed / push) / drag;
}

/// Of all members together [1/s].
Real drag_of(const Bodies& bodies, const std::vector<std::uint32_t>& members) {
  Real mass = 0.0, drag = 0.0;
  for (const std::uint32_t member : members)
    mass += bodies.build(member).mass, drag += bodies.build(member).mass * bodies.own_drag(member);
  drag /= mass;
  return drag;
}

}  // namespace

Friction::Friction(const WorldSpec& spec, Bodies& bodies)
    : bodies_(bodies), friction_(spec.puck_friction), contact_time_(spec.contact_time) {
  assert(friction_ >= 0.0 && contact_time_ > 0.0);
}

RealVector Friction::along(const RealVector& velocity) const {
  const Real speed = std::sqrt(velocity.squaredNorm());
  return speed == 0.0 ? RealVector(0.0, 0.0) : RealVector(-friction_ * (velocity / speed));
}

bool Friction::is_sliding(std::uint32_t body) const {
  return bodies_[body].vx != 0.0 || bodies_[body].vy != 0.0;
}

bool Friction::slides_across(int axis, std::uint32_t body) const {
  return bodies_.is_slowed(body) && bodies_.velocity(body)[1 - axis] != 0.0;
}

Real Friction::own_push(std::uint32_t body, int axis) const {
  return bodies_.is_slowed() ? bodies_.build(body).thrust[axis] + bodies_.slowing(body)[axis]
                             : bodies_.build(body).thrust[axis];
}

void Friction::slide(std::uint32_t body, std::optional<int> pushed_axis) {
  assert(!pushed_axis || *pushed_axis == 0 || *pushed_axis == 1);
  if (!bodies_.is_slowed(body)) return;
  if (pushed_axis) {
    const int across = 1 - *pushed_axis;
    RealVector acceleration = bodies_.law(body).acceleration;
    if (!bodies_[body].is(Body::held_along(across)))
      acceleration[across] = bodies_.slowing(body)[across];
    bodies_.slide(body, acceleration, infinity);
  } else {
    Motion sliding = bodies_.motion(body);
    sliding.slide(friction_);
    bodies_.set_slowing(body, sliding.acceleration);
    bodies_.slide(body, sliding.acceleration, sliding.rest_time);
  }
}

void Friction::reset_friction(int axis, const std::vector<std::uint32_t>& members) {
  assert((axis == 0 || axis == 1) && !members.empty());
  const bool is_group_calm = std::abs(bodies_.velocity(members.front())[axis]) <= calm_speed;
  for (const std::uint32_t member : members) {
    bodies_.keep(member);
    if (is_group_calm) bodies_.set_velocity(member, axis, 0.0);
    if (bodies_.is_slowed(member) && std::abs(bodies_.velocity(member)[1 - axis]) <= calm_speed &&
        !bodies_[member].is(Body::held_along(1 - axis)))
      bodies_.set_velocity(member, 1 - axis, 0.0);
  }
}

void Friction::face(const std::vector<std::uint32_t>& members) {
  for (const std::uint32_t member : members)
    if (bodies_.is_slowed(member)) bodies_.set_slowing(member, along(bodies_.velocity(member)));
}

bool Friction::has_sliders(int axis, const std::vector<std::uint32_t>& members) const {
  return std::any_of(members.begin(), members.end(),
                     [&](std::uint32_t member) { return slides_across(axis, member); });
}

/// The common acceleration that the members give each other, but for drag.
Real Friction::push_of(int axis, const std::vector<std::uint32_t>& members) const {
  Real mass = 0.0, sum = 0.0;
  for (const std::uint32_t member : members) mass += bodies_.build(member).mass;
  for (const std::uint32_t member : members)
    sum += bodies_.build(member).mass * own_push(member, axis);
  assert(mass > 0.0);
  return sum / mass;
}

/// How long it takes until the group, or one of its pucks across the axis, comes to a stop.
Real Friction::until_stop(int axis, const std::vector<std::uint32_t>& members) const {
  const int across = 1 - axis;
  Real wait = speed_lost(bodies_.velocity(members.front())[axis], push_of(axis, members),
                         drag_of(bodies_, members));
  for (const std::uint32_t member : members)
    if (slides_across(axis, member))
      wait = std::min(wait, speed_lost(bodies_.velocity(member)[across],
                                       bodies_.slowing(member)[across], bodies_.own_drag(member)));
  assert(!(wait < 0.0));
  return wait;
}

/// How long the friction of all may keep its direction.
Real Friction::arc_of(int axis, const std::vector<std::uint32_t>& members) const {
  const int across = 1 - axis;
  const Real speed = bodies_.velocity(members.front())[axis], drag = drag_of(bodies_, members);
  Real arc = infinity;
  for (const std::uint32_t member : members) {
    if (!slides_across(axis, member)) continue;
    const RealVector velocity = bodies_.velocity(member);
    const Real forward = push_of(axis, members) - drag * speed,
               aside =
                   bodies_.slowing(member)[across] - bodies_.own_drag(member) * velocity[across];
    const Real square = velocity.squaredNorm(),
               rate = std::abs(velocity[axis] * aside - velocity[across] * forward) / square;
    const Real growth = std::abs(velocity[axis] * forward + velocity[across] * aside) / square;
    if (rate > 0.0)
      arc = std::min(arc,
                     std::max<Real>(contact_time_, std::min(turn_max / rate, growth_max / growth)));
  }
  return arc;
}

void Friction::aim_half_way(int axis, const std::vector<std::uint32_t>& members, Real half) {
  assert(!(half < 0.0));
  const int across = 1 - axis;
  const Real speed = bodies_.velocity(members.front())[axis], pushing = push_of(axis, members);
  const WarpedTime together = warp_unaccelerated(half, drag_of(bodies_, members));
  for (const std::uint32_t member : members) {
    if (!slides_across(axis, member)) continue;
    const WarpedTime alone = warp_unaccelerated(half, bodies_.own_drag(member));
    RealVector velocity;
    velocity[axis] = speed * together.e + pushing * together.s;
    velocity[across] =
        bodies_.velocity(member)[across] * alone.e + bodies_.slowing(member)[across] * alone.s;
    bodies_.set_slowing(member, along(velocity));
  }
}

Real Friction::aim(int axis, const std::vector<std::uint32_t>& members, Real time) {
  if (std::none_of(members.begin(), members.end(),
                   [&](std::uint32_t member) { return bodies_.is_slowed(member); }))
    return infinity;
  const Real arc = arc_of(axis, members);
  assert(!(arc < contact_time_));  // or arcs would follow each other without end
  if (arc < infinity) aim_half_way(axis, members, 0.5 * std::min(arc, until_stop(axis, members)));
  return time + std::min(arc, until_stop(axis, members));
}

Real Friction::resist(int axis, const std::vector<std::uint32_t>& members,
                      std::vector<Real>& accelerations) {
  assert(accelerations.size() == bodies_.count());
  Real change = 0.0;
  for (const std::uint32_t member : members) {
    if (!bodies_.is_slowed(member) || is_sliding(member)) continue;
    RealVector slowing = bodies_.slowing(member);
    const Real friction =
        std::clamp<Real>(slowing[axis] - accelerations[member], -friction_, friction_);
    change = std::max(change, std::abs(friction - slowing[axis]));
    accelerations[member] += friction - slowing[axis];
    slowing[axis] = friction;
    bodies_.set_slowing(member, slowing);
  }
  return change;
}

bool Friction::bears_more(std::uint32_t body, int axis) const {
  return bodies_.is_slowed(body) && !is_sliding(body) &&
         std::abs(bodies_.slowing(body)[axis]) < (1.0 - 1e-9) * friction_;
}

}  // namespace rink::physics::inline RINK_PRECISION
