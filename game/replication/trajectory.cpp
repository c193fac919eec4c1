// Rounds trajectories, and finds how long a rounded one stays near its body.
#include "game/replication/trajectory.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace rink::game {
namespace {

using physics::Motion;
using physics::Vector2;

double rounded_to(double step, double value) {
  assert(step > 0.0);
  return std::nearbyint(value / step) * step + 0.0;  // no negative zero
}
Vector2 rounded_to(double step, const Vector2& value) {
  return {rounded_to(step, value.x()), rounded_to(step, value.y())};
}

/// `motion` at an instant that may be a little before its time, where Motion::at may not be asked:
/// the same closed form run backwards.
Motion at_or_before(const Motion& motion, double instant) {
  if (instant >= motion.time) return motion.at(instant);
  Motion moved = motion;
  const double t = instant - motion.time;
  for (int axis = 0; axis < 2; ++axis) {
    const double g = motion.drag[axis], lost = std::expm1(-g * t);
    const double s = g == 0.0 ? t : -lost / g, q = g == 0.0 ? 0.5 * t * t : (t - s) / g;
    moved.position[axis] += motion.velocity[axis] * s + motion.acceleration[axis] * q;
    moved.velocity[axis] = motion.velocity[axis] * (1.0 + lost) + motion.acceleration[axis] * s;
  }
  moved.time = instant;
  return moved;
}

Resistance own_resistance(const physics::World& world, physics::BodyId body) {
  return Drag::of(world.spec()).of(world.kind(body));
}

/// The acceleration of the body besides friction, which receivers derive from its velocity: 0 for a
/// puck that slides freely (and thus comes to rest at a known time). One that a bat pushes has its
/// own law.
Vector2 thrust_of(const Motion& motion, const Resistance& own) {
  return own.friction > 0.0 && std::isfinite(motion.rest_time) ? Vector2(0.0, 0.0)
                                                               : motion.acceleration;
}

Vector2 sent_drag(const Motion& motion, double own) {
  return {motion.drag.x() == own ? Trajectory::of_its_kind : motion.drag.x(),
          motion.drag.y() == own ? Trajectory::of_its_kind : motion.drag.y()};
}

bool can_move(const physics::World& world, physics::BodyId body) {
  return world.is_in_play(body) && !world.is_resting(body);
}

}  // namespace

Trajectory trajectory_of(const physics::World& world, physics::BodyId body) {
  if (!can_move(world, body))
    return {.position = rounded_to(trajectory_position_step, world.position(body))};
  const Motion motion = world.motion(body);
  const Resistance own = own_resistance(world, body);
  const double latest = std::floor(world.now() / trajectory_time_step) * trajectory_time_step,
               event = rounded_to(trajectory_time_step, motion.time),
               time = event > latest || event < latest - event_age_max ? latest : event;
  assert(time <= world.now());
  const Motion there = at_or_before(motion, time);
  Trajectory sent{.time = time,
                  .position = rounded_to(trajectory_position_step, there.position),
                  .velocity = rounded_to(trajectory_velocity_step, there.velocity),
                  .acceleration = single_precision(thrust_of(motion, own)),
                  .drag = sent_drag(motion, own.drag)};
  if (sent.is_resting())
    sent = {.position = rounded_to(trajectory_position_step, world.position(body))};
  return sent;
}

Trajectory extrapolation_of(const Vector2& position, const Vector2& velocity, double now,
                            const Resistance& own) {
  assert(position.allFinite() && velocity.allFinite() && std::isfinite(now));
  assert(own.drag >= 0.0 && own.friction >= 0.0);
  Motion onwards{.time = now,
                 .position = position,
                 .velocity = velocity,
                 .acceleration = {0.0, 0.0},
                 .drag = {own.drag, own.drag}};
  if (own.friction > 0.0) onwards.slide(own.friction);
  const double time = std::floor(now / trajectory_time_step) * trajectory_time_step;
  const Motion there = at_or_before(onwards, time);
  const Trajectory sent{.time = time,
                        .position = rounded_to(trajectory_position_step, there.position),
                        .velocity = rounded_to(trajectory_velocity_step, there.velocity)};
  if (sent.is_resting()) return {.position = rounded_to(trajectory_position_step, position)};
  return sent;
}

physics::Motion motion_of(const Trajectory& sent, const Resistance& own) {
  assert(own.drag >= 0.0 && own.friction >= 0.0);
  const auto drag = [&own](double value) {
    return value == Trajectory::of_its_kind ? own.drag : value;
  };
  Motion motion{.time = sent.time,
                .position = sent.position,
                .velocity = sent.velocity,
                .acceleration = sent.acceleration,
                .drag = {drag(sent.drag.x()), drag(sent.drag.y())}};
  if (own.friction > 0.0 && sent.acceleration.isZero(0.0)) motion.slide(own.friction);
  return motion;
}

double holds_until(const physics::World& world, physics::BodyId body, const Trajectory& sent) {
  constexpr double forever = std::numeric_limits<double>::infinity(), never = -forever;
  const double now = world.now();
  const Resistance own = own_resistance(world, body);
  if (!can_move(world, body))
    return sent.is_resting() &&
                   (sent.position - world.position(body)).norm() <= trajectory_error_max
               ? forever
               : never;
  const Motion motion = world.motion(body), law = motion_of(sent, own);
  const Vector2 thrust = thrust_of(motion, own);
  // A trajectory at rest has no law: a body that creeps on without acceleration is compared by its
  // own law.
  const bool is_sent_to_rest = sent.is_resting();
  if (is_sent_to_rest ? !thrust.isZero(0.0)
                      : sent.acceleration != single_precision(thrust) ||
                            sent.drag != sent_drag(motion, own.drag))
    return never;
  const Motion exact = motion.at(std::max(now, motion.time)),
               followed = law.at(std::max(now, sent.time));
  // The difference of two motions of one law follows that law: dp + dv s(t) + da t^2/2 at most, and
  // s grows towards 1/g. Friction only brings velocities nearer.
  const double oldest = is_sent_to_rest ? forever : sent.time + trajectory_age_max;
  const double astray = (followed.position - exact.position).norm(),
               growth = (followed.velocity - exact.velocity).norm();
  const double thrust_error =
      (sent.acceleration - thrust).norm() * 0.5 * trajectory_age_max * trajectory_age_max;
  const double room = trajectory_error_max - astray - thrust_error, g = motion.drag.minCoeff();
  if (room <= 0.0) return never;
  assert(room <= trajectory_error_max && growth >= 0.0 && g >= 0.0);
  if (growth * 1.0 <= g * room) return oldest;
  const double s = room / growth;
  return std::min(oldest, now + (g == 0.0 ? s : -std::log1p(-g * s) / g));
}

}  // namespace rink::game
