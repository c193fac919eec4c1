// Coulomb friction with the table: of pucks that slide on their own, and of those that are pushed,
// whose friction turns with their velocity.
#include <algorithm>

#include "game/physics/engine/engine.h"
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

}  // namespace

RealVector Engine::friction_along(const RealVector& velocity) const {
  const Real speed = std::sqrt(velocity.squaredNorm());
  return speed == 0.0 ? RealVector(0.0, 0.0)
                      : RealVector(-spec_.puck_friction * (velocity / speed));
}

/// The law of friction for everything that the event at hand touched. Groups that push a puck come
/// first, for they may let it go.
void Engine::slide_touched() {
  std::vector<std::uint32_t> done;
  for (std::size_t i = 0; i < bodies_.touched().size(); ++i) {
    const std::uint32_t body = bodies_.touched()[i];
    if (!bodies_[body].is(Body::held) || !bodies_.is_slowed(body) ||
        std::find(done.begin(), done.end(), body) != done.end())
      continue;
    const std::optional<int> axis = pushed_axis(body);
    if (!axis) continue;
    const std::vector<std::uint32_t> members = companions(body, Body::held_along(*axis));
    done.insert(done.end(), members.begin(), members.end());
    share(*axis, members, bodies_[body].time);
  }
  for (const std::uint32_t body : bodies_.touched()) slide(body);
}

/// The law of friction for the velocity that the body has now; it does nothing to what friction
/// does not slow. A pushed puck shares the law of its group along one axis.
void Engine::slide(std::uint32_t body) {
  if (!bodies_.is_slowed(body)) return;
  if (const std::optional<int> axis = pushed_axis(body)) {
    RealVector acceleration = bodies_.law(body).acceleration;
    if (!bodies_[body].is(Body::held_along(1 - *axis)))
      acceleration[1 - *axis] = bodies_.slowing(body)[1 - *axis];
    bodies_.slide(body, acceleration, infinity);
  } else {
    Motion sliding = bodies_.motion(body);
    sliding.slide(spec_.puck_friction);
    bodies_.set_slowing(body, sliding.acceleration);
    bodies_.slide(body, sliding.acceleration, sliding.rest_time);
  }
}

/// The axis along which the body is in rest contact with what can move, and with nothing fixed.
std::optional<int> Engine::pushed_axis(std::uint32_t body) const {
  for (int axis = 0; axis < 2; ++axis)
    if ((bodies_[body].flags & Body::held_along(axis)) != 0 &&
        !is_group_fixed(axis, companions(body, Body::held_along(axis))))
      return axis;
  return std::nullopt;
}

/// Whether the group is free to move and has a puck that is also pushed along the other axis: its
/// friction would bind two groups to each other.
bool Engine::is_pushed_twice(int axis, const std::vector<std::uint32_t>& members) const {
  if (!bodies_.is_slowed() || is_group_fixed(axis, members)) return false;
  return std::any_of(members.begin(), members.end(), [&](std::uint32_t member) {
    return bodies_.is_slowed(member) && (bodies_[member].flags & Body::held_along(1 - axis)) != 0 &&
           !is_group_fixed(1 - axis, companions(member, Body::held_along(1 - axis)));
  });
}

/// Stops what friction has slowed down to nothing.
void Engine::calm(int axis, const std::vector<std::uint32_t>& members) {
  const bool is_group_calm = std::abs(bodies_.velocity(members.front())[axis]) <= calm_speed;
  for (const std::uint32_t member : members) {
    bodies_.keep(member);
    if (is_group_calm) bodies_.set_velocity(member, axis, 0.0);
    if (bodies_.is_slowed(member) && std::abs(bodies_.velocity(member)[1 - axis]) <= calm_speed &&
        !bodies_[member].is(Body::held_along(1 - axis)))
      bodies_.set_velocity(member, 1 - axis, 0.0);
  }
}

/// The time in which a push against it takes a speed away; infinite if it does not.
Real Engine::speed_lost(Real speed, Real push, Real drag) const {
  if (!(speed * push < 0.0)) return infinity;
  return drag == 0.0 ? -speed / push : log1p_of(-drag * speed / push) / drag;
}

/// Friction against the velocities of the group's pucks as they are; of those at rest along the
/// axis of a group that may stand, it remains to be found (solve_forces).
void Engine::face_friction(const std::vector<std::uint32_t>& members) {
  for (const std::uint32_t member : members)
    if (bodies_.is_slowed(member))
      bodies_.set_slowing(member, friction_along(bodies_.velocity(member)));
}

/// Whether a puck of the group slides across its axis, so that its friction turns.
bool Engine::has_sliders(int axis, const std::vector<std::uint32_t>& members) const {
  return std::any_of(members.begin(), members.end(), [&](std::uint32_t member) {
    return bodies_.is_slowed(member) && bodies_.velocity(member)[1 - axis] != 0.0;
  });
}

/// Aims the friction of the group's sliding pucks against the velocities that they will have
/// half-way to the next time that it is aimed, and answers when that is; never where they keep
/// their direction.
Real Engine::aim_friction(int axis, const std::vector<std::uint32_t>& members, Real time) {
  const int across = 1 - axis;
  if (is_group_fixed(axis, members) ||
      std::none_of(members.begin(), members.end(),
                   [&](std::uint32_t member) { return bodies_.is_slowed(member); }))
    return infinity;
  const Real speed = bodies_.velocity(members.front())[axis];
  Real mass = 0.0, drag = 0.0;
  for (const std::uint32_t member : members)
    mass += bodies_.build(member).mass,
        drag += bodies_.build(member).mass * bodies_.own_drag(member);
  drag /= mass;
  const auto push = [&] {
    Real sum = 0.0;
    for (const std::uint32_t member : members)
      sum += bodies_.build(member).mass * own_push(member, axis);
    return sum / mass;
  };
  const auto slides_across = [&](std::uint32_t member) {
    return bodies_.is_slowed(member) && bodies_.velocity(member)[across] != 0.0;
  };
  const auto until_stop = [&] {
    Real wait = speed_lost(speed, push(), drag);
    for (const std::uint32_t member : members)
      if (slides_across(member))
        wait =
            std::min(wait, speed_lost(bodies_.velocity(member)[across],
                                      bodies_.slowing(member)[across], bodies_.own_drag(member)));
    return wait;
  };
  Real arc = infinity;
  for (const std::uint32_t member : members) {
    if (!slides_across(member)) continue;
    const RealVector velocity = bodies_.velocity(member);
    const Real along = push() - drag * speed, aside = bodies_.slowing(member)[across] -
                                                      bodies_.own_drag(member) * velocity[across];
    const Real square = velocity.squaredNorm(),
               rate = std::abs(velocity[axis] * aside - velocity[across] * along) / square;
    const Real growth = std::abs(velocity[axis] * along + velocity[across] * aside) / square;
    if (rate > 0.0)
      arc = std::min(arc,
                     std::max<Real>(contact_time_, std::min(turn_max / rate, growth_max / growth)));
  }
  if (arc < infinity) {
    const Real half = 0.5 * std::min(arc, until_stop()), pushing = push();
    const WarpedTime together = warp_unaccelerated(half, drag);
    for (const std::uint32_t member : members) {
      if (!slides_across(member)) continue;
      const WarpedTime alone = warp_unaccelerated(half, bodies_.own_drag(member));
      RealVector velocity;
      velocity[axis] = speed * together.e + pushing * together.s;
      velocity[across] =
          bodies_.velocity(member)[across] * alone.e + bodies_.slowing(member)[across] * alone.s;
      bodies_.set_slowing(member, friction_along(velocity));
    }
  }
  return time + std::min(arc, until_stop());
}

/// One sweep of static friction: each puck at rest resists its acceleration along the axis as far
/// as Coulomb's law lets it. Answers the largest change [m/s^2].
Real Engine::resist(const std::vector<std::uint32_t>& members, int axis) {
  Real change = 0.0;
  for (const std::uint32_t member : members) {
    if (!bodies_.is_slowed(member) || is_sliding(member)) continue;
    RealVector slowing = bodies_.slowing(member);
    const Real friction = std::clamp<Real>(slowing[axis] - accelerations_[member],
                                           -spec_.puck_friction, spec_.puck_friction);
    change = std::max(change, std::abs(friction - slowing[axis]));
    accelerations_[member] += friction - slowing[axis];
    slowing[axis] = friction;
    bodies_.set_slowing(member, slowing);
  }
  return change;
}

}  // namespace rink::physics::inline RINK_PRECISION
