// The clock of frames, bodies coming and going, and the response to an impact.
#include "game/physics/paper/frame_simulator.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rink::physics::paper {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

FrameSimulator::FrameSimulator(const WorldSpec& spec, Integrator integrator, double dt)
    : spec_(spec), steps_(integrator, dt) {
  assert(spec.field.length > 0.0 && spec.field.width > 0.0 && spec.field.goal_width >= 0.0 &&
         spec.field.goal_width <= spec.field.width);
}

BodyId FrameSimulator::add(const PuckSpec& spec) {
  assert(spec.radius > 0.0 && spec.mass > 0.0);
  Body body;
  body.start = {spec.position, spec.velocity};
  body.force.drag = spec_.puck_drag;
  body.force.friction = spec_.puck_friction;
  body.spin = spec_.surface_friction ? spec.spin : 0.0;
  body.radius = spec.radius;
  body.mass = spec.mass;
  body.inverse_mass = 1.0 / spec.mass;
  body.material = spec.material;
  return add(body);
}

BodyId FrameSimulator::add(const BatSpec& spec) {
  assert(spec.half_extent.minCoeff() > 0.0 && spec.mass > 0.0);
  Body body;
  body.kind = BodyKind::bat;
  body.start = {spec.position, spec.velocity};
  body.force.drag = spec_.bat_drag;
  body.half_extent = spec.half_extent;
  body.mass = spec.mass;
  body.inverse_mass = 1.0 / spec.mass;
  body.material = spec.material;
  body.half = spec.half;
  return add(body);
}

BodyId FrameSimulator::add(const PostSpec& spec) {
  assert(spec.radius >= 0.0);
  Body body;
  body.kind = BodyKind::post;
  body.start.position = spec.position;
  body.radius = spec.radius;
  body.mass = infinity;
  body.inverse_mass = 0.0;
  body.material = spec.material;
  return add(body);
}

BodyId FrameSimulator::add(Body body) {
  assert(body.start.position.allFinite() && body.start.velocity.allFinite() &&
         body.material < spec_.restitution.material_count());
  const auto index = static_cast<std::uint32_t>(bodies_.size());
  body.start_time = now_;
  introduced_ += body.energy(body.start.velocity);
  bodies_.push_back(body);
  plan(bodies_.back());
  if (steps_.is_begun()) turned(index);
  return {index};
}

void FrameSimulator::remove(BodyId id) {
  assert(id.index < body_count());
  Body& body = bodies_[id.index];
  if (body.is_in_play) {
    rebase(body, now_);
    introduced_ -= body.energy(body.start.velocity);
  }
  ++body.version;
  body.is_in_play = false;
  body.is_removed = true;
}

void FrameSimulator::set_thrust(BodyId id, const Vector2& acceleration) {
  assert(id.index < body_count());
  Body& bat = bodies_[id.index];
  assert(bat.kind == BodyKind::bat && acceleration.allFinite());
  if (bat.force.thrust == acceleration) return;
  if (bat.is_in_play) {
    record_.note(EventKind::thrust, now_, id.index);
    rebase(bat, now_);
  }
  bat.force.thrust = acceleration;
  if (!bat.is_in_play) return;
  plan(bat);
  if (steps_.is_begun()) turned(id.index);
}

void FrameSimulator::place(BodyId id, const Vector2& position, const Vector2& velocity) {
  assert(id.index < body_count());
  Body& puck = bodies_[id.index];
  assert(puck.kind == BodyKind::puck && !puck.is_in_play && !puck.is_removed &&
         position.allFinite() && velocity.allFinite());
  puck.is_in_play = true;
  puck.is_stopped = false;
  puck.start = {position, velocity};
  puck.start_time = now_;
  puck.spin = 0.0;
  introduced_ += puck.energy(velocity);
  ++record_.counters().bodies_touched;
  plan(puck);
  if (steps_.is_begun()) turned(id.index);
}

std::optional<Goal> FrameSimulator::advance(double until) {
  assert(until >= now_ && until < infinity);
  while (steps_.is_begun() || now_ < until) {
    if (!steps_.is_begun()) begin_frame();
    const double end = std::min(until, steps_.frame_end());
    if (const auto goal = play(end)) return goal;
    now_ = end;
    if (end < steps_.frame_end()) break;
    finish_frame();
  }
  return std::nullopt;
}

void FrameSimulator::begin_frame() {
  for (Body& body : bodies_) {
    body.impacts = 0;
    body.is_stopped = false;
    plan(body);
  }
  steps_.begin();
  begin();
}

void FrameSimulator::finish_frame() {
  for (Body& body : bodies_)
    if (body.is_in_play) rebase(body, now_);
  steps_.finish();
}

void FrameSimulator::plan(Body& body) {
  if (steps_.plan(body)) ++record_.counters().evaluations;
}

void FrameSimulator::rebase(Body& body, double time) {
  if (body.start_time == time) return;
  if (body.can_move() && !body.is_stopped) {
    work_ += steps_.work_until(body, time);
    body.start = steps_.phase_at(body, time);
    ++record_.counters().bodies_touched;
    if (body.force.friction > 0.0 && body.start.velocity == Vector2(0.0, 0.0))
      record_.note(EventKind::stop, time, static_cast<std::uint32_t>(&body - bodies_.data()));
  }
  body.start_time = time;
}

Goal FrameSimulator::score(std::uint32_t index) {
  Body& body = bodies_[index];
  record_.note(EventKind::goal, body.start_time, index);
  introduced_ -= body.energy(body.start.velocity);
  ++body.version;
  body.is_in_play = false;
  return {body.start_time,
          {index},
          body.start.position.x() < 0.5 * spec_.field.length ? End::left : End::right};
}

void FrameSimulator::respond(std::uint32_t index, Partner partner, const Vector2& normal,
                             double time) {
  Body field = immovable(spec_.field.wall);
  record_.note(kind_of_impact(index, partner), time, index, partner);
  strike(bodies_[index], is_body(partner) ? bodies_[partner] : field, normal, spec_);
}

EventKind FrameSimulator::kind_of_impact(std::uint32_t body, Partner partner) const {
  const auto is = [&](BodyKind kind) {
    return bodies_[body].kind == kind || (is_body(partner) && bodies_[partner].kind == kind);
  };
  if (!is_body(partner)) return partner == wall ? EventKind::wall : EventKind::post;
  if (is(BodyKind::post)) return EventKind::post;
  if (!is(BodyKind::bat)) return EventKind::puck_puck;
  return is(BodyKind::puck) ? EventKind::puck_bat : EventKind::bat_bat;
}

}  // namespace rink::physics::paper
