// The clock of frames, bodies coming and going, and the response to an impact.
#include "game/physics/paper/frame_simulator.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rink::physics::paper {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// The least separation that an impulse leaves, relative to the speeds, so that no impact is found
/// twice: as in the exact engine.
constexpr double frame_separation_min = 1e-14;

}  // namespace

FrameSimulator::FrameSimulator(const WorldSpec& spec, Integrator integrator, double dt)
    : spec_(spec), integrator_(integrator), dt_(dt) {
  assert(std::isfinite(dt) && dt > 0.0);
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
  introduced_ += energy_of(body, body.start.velocity);
  bodies_.push_back(body);
  plan(bodies_.back());
  if (is_begun_) turned(index);
  return {index};
}

void FrameSimulator::remove(BodyId id) {
  Body& body = bodies_[id.index];
  if (body.is_in_play) {
    rebase(body, now_);
    introduced_ -= energy_of(body, body.start.velocity);
  }
  ++body.version;
  body.is_in_play = false;
  body.is_removed = true;
}

void FrameSimulator::set_thrust(BodyId id, const Vector2& acceleration) {
  Body& bat = bodies_[id.index];
  assert(bat.kind == BodyKind::bat && acceleration.allFinite());
  if (bat.force.thrust == acceleration) return;
  if (bat.is_in_play) {
    note(EventKind::thrust, now_, id.index);
    rebase(bat, now_);
  }
  bat.force.thrust = acceleration;
  if (!bat.is_in_play) return;
  plan(bat);
  if (is_begun_) turned(id.index);
}

void FrameSimulator::place(BodyId id, const Vector2& position, const Vector2& velocity) {
  Body& puck = bodies_[id.index];
  assert(puck.kind == BodyKind::puck && !puck.is_in_play && !puck.is_removed &&
         position.allFinite() && velocity.allFinite());
  puck.is_in_play = true;
  puck.is_stopped = false;
  puck.start = {position, velocity};
  puck.start_time = now_;
  puck.spin = 0.0;
  introduced_ += energy_of(puck, velocity);
  ++counters_.bodies_touched;
  plan(puck);
  if (is_begun_) turned(id.index);
}

std::optional<Goal> FrameSimulator::advance(double until) {
  assert(until >= now_ && until < infinity);
  while (is_begun_ || now_ < until) {
    if (!is_begun_) begin_frame();
    const double end = std::min(until, frame_end());
    if (const auto goal = play(end)) return goal;
    now_ = end;
    if (end < frame_end()) break;
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
  is_begun_ = true;
  begin();
}

void FrameSimulator::finish_frame() {
  for (Body& body : bodies_)
    if (body.is_in_play) rebase(body, now_);
  is_begun_ = false;
  ++frame_;
}

Phase FrameSimulator::phase_at(const Body& body, double time) const {
  if (!body.is_in_play || body.is_stopped || time <= body.start_time || !can_move(body))
    return body.start;
  if (is_begun_ && time == frame_end()) return body.end;
  const Step taken = step(integrator_, body.start.velocity, body.force, time - body.start_time);
  return {body.start.position + taken.displacement, taken.velocity};
}

void FrameSimulator::plan(Body& body) {
  ++body.version;
  body.end = body.start;
  body.chord = Vector2(0.0, 0.0);
  const double left = frame_end() - body.start_time;
  if (!body.is_in_play || body.is_stopped || !can_move(body) || left <= 0.0) return;
  const Step taken = step(integrator_, body.start.velocity, body.force, left);
  body.end = {body.start.position + taken.displacement, taken.velocity};
  body.chord = taken.displacement / left;
  ++counters_.evaluations;
}

void FrameSimulator::rebase(Body& body, double time) {
  if (body.start_time == time) return;
  if (can_move(body) && !body.is_stopped) {
    work_ += work_until(body, time);
    body.start = phase_at(body, time);
    ++counters_.bodies_touched;
    if (body.force.friction > 0.0 && body.start.velocity == Vector2(0.0, 0.0))
      note(EventKind::stop, time, static_cast<std::uint32_t>(&body - bodies_.data()));
  }
  body.start_time = time;
}

Goal FrameSimulator::score(std::uint32_t index) {
  Body& body = bodies_[index];
  note(EventKind::goal, body.start_time, index);
  introduced_ -= energy_of(body, body.start.velocity);
  ++body.version;
  body.is_in_play = false;
  return {body.start_time,
          {index},
          body.start.position.x() < 0.5 * spec_.field.length ? End::left : End::right};
}

/// Newton's law of impact, with the table of the exact engine. A pressed contact may close along
/// the path, by the force within the frame, though the velocities do not: then the velocity is
/// changed by as much as keeps the path open.
void FrameSimulator::respond(std::uint32_t index, Partner partner, const Vector2& normal,
                             double time) {
  count_impact(index, partner, time);
  Body still;
  still.inverse_mass = 0.0;
  still.material = spec_.field.wall;
  Body& body = bodies_[index];
  Body& other = is_body(partner) ? bodies_[partner] : still;
  const double approach = normal.dot(other.start.velocity - body.start.velocity);
  const double least =
      frame_separation_min * (body.start.velocity.norm() + other.start.velocity.norm());
  double change = std::max(0.0, normal.dot(other.chord - body.chord)) + least;
  if (approach > 0.0)
    change =
        approach + std::max(spec_.restitution(body.material, other.material) * approach, least);
  const double impulse = change / (body.inverse_mass + other.inverse_mass);
  if (spec_.surface_friction) return rub(body, other, normal, impulse);
  body.start.velocity += impulse * body.inverse_mass * normal;
  other.start.velocity -= impulse * other.inverse_mass * normal;
}

/// The law of the exact engine (docs/physics.md, "Spin"): a tangential impulse up to Coulomb's
/// limit, which turns discs.
void FrameSimulator::rub(Body& body, Body& other, const Vector2& normal, double normal_impulse) {
  const Vector2 tangent(-normal.y(), normal.x());
  const auto turns = [](const Body& one) {
    return one.kind == BodyKind::puck && one.inverse_mass > 0.0;
  };
  const auto rim_speed = [&](const Body& one) { return turns(one) ? one.spin * one.radius : 0.0; };
  const auto yielding = [&](const Body& one) {
    return (turns(one) ? 3.0 : 1.0) * one.inverse_mass;
  };
  const double slip = tangent.dot(body.start.velocity - other.start.velocity) -
                      (rim_speed(body) + rim_speed(other));
  const double stick =
      (1.0 + spec_.surface_friction->tangential_restitution(body.material, other.material)) *
      std::abs(slip) / (yielding(body) + yielding(other));
  const double rubbing = -std::copysign(
      std::min(stick,
               spec_.surface_friction->coefficient(body.material, other.material) * normal_impulse),
      slip);
  const Vector2 impulse = normal_impulse * normal + rubbing * tangent;
  body.start.velocity += body.inverse_mass * impulse;
  other.start.velocity -= other.inverse_mass * impulse;
  for (Body* one : {&body, &other})
    if (turns(*one)) one->spin -= 2.0 * one->inverse_mass * rubbing / one->radius;
}

void FrameSimulator::note(EventKind kind, double time, std::uint32_t body, Partner other) {
  ++counters_.of(kind);
  if (records_events_)
    events_.push_back(
        {time, kind, {body}, is_body(other) ? std::optional(BodyId{other}) : std::nullopt});
}

void FrameSimulator::count_impact(std::uint32_t body, Partner partner, double time) {
  const auto is = [&](BodyKind kind) {
    return bodies_[body].kind == kind || (is_body(partner) && bodies_[partner].kind == kind);
  };
  const auto kind = [&] {
    if (!is_body(partner)) return partner == wall ? EventKind::wall : EventKind::post;
    if (is(BodyKind::post)) return EventKind::post;
    if (!is(BodyKind::bat)) return EventKind::puck_puck;
    return is(BodyKind::puck) ? EventKind::puck_bat : EventKind::bat_bat;
  };
  note(kind(), time, body, partner);
}

}  // namespace rink::physics::paper
