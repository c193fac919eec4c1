// Newton's law of impact and Coulomb's of friction, with the tables of the exact engine.
#include "game/physics/paper/frame_impact.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rink::physics::paper {

namespace {

/// The least separation that an impulse leaves, relative to the speeds, so that no impact is found
/// twice: as in the exact engine.
constexpr double frame_separation_min = 1e-14;

bool turns(const FrameBody& body) { return body.kind == BodyKind::puck && body.inverse_mass > 0.0; }
double rim_speed(const FrameBody& body) { return turns(body) ? body.spin * body.radius : 0.0; }
double yielding(const FrameBody& body) { return (turns(body) ? 3.0 : 1.0) * body.inverse_mass; }

/// The law of the exact engine (docs/physics.md, "Spin"): a tangential impulse up to Coulomb's
/// limit, which turns discs.
void rub(FrameBody& body, FrameBody& other, const Vector2& normal, double normal_impulse,
         const SurfaceFriction& surface) {
  const Vector2 tangent(-normal.y(), normal.x());
  const double slip = tangent.dot(body.start.velocity - other.start.velocity) -
                      (rim_speed(body) + rim_speed(other));
  const double stick = (1.0 + surface.tangential_restitution(body.material, other.material)) *
                       std::abs(slip) / (yielding(body) + yielding(other));
  const double rubbing = -std::copysign(
      std::min(stick, surface.coefficient(body.material, other.material) * normal_impulse), slip);
  const Vector2 impulse = normal_impulse * normal + rubbing * tangent;
  body.start.velocity += body.inverse_mass * impulse;
  other.start.velocity -= other.inverse_mass * impulse;
  for (FrameBody* one : {&body, &other})
    if (turns(*one)) one->spin -= 2.0 * one->inverse_mass * rubbing / one->radius;
}

/// By how much the speed along `normal` changes. A pressed contact may close along the path, by the
/// force within the frame, though the velocities do not: then the velocity is changed by as much as
/// keeps the path open.
double change_along(const FrameBody& body, const FrameBody& other, const Vector2& normal,
                    const WorldSpec& spec) {
  const double approach = normal.dot(other.start.velocity - body.start.velocity);
  const double least =
      frame_separation_min * (body.start.velocity.norm() + other.start.velocity.norm());
  if (approach > 0.0)
    return approach + std::max(spec.restitution(body.material, other.material) * approach, least);
  return std::max(0.0, normal.dot(other.chord - body.chord)) + least;
}

}  // namespace

FrameBody immovable(MaterialId material) {
  FrameBody body;
  body.inverse_mass = 0.0;
  body.material = material;
  return body;
}

void strike(FrameBody& body, FrameBody& other, const Vector2& normal, const WorldSpec& spec) {
  assert(body.inverse_mass + other.inverse_mass > 0.0);
  const double impulse =
      change_along(body, other, normal, spec) / (body.inverse_mass + other.inverse_mass);
  if (spec.surface_friction) return rub(body, other, normal, impulse, *spec.surface_friction);
  body.start.velocity += impulse * body.inverse_mass * normal;
  other.start.velocity -= impulse * other.inverse_mass * normal;
}

}  // namespace rink::physics::paper
