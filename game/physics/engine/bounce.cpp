// The impulses, from the line of centres and the speeds of rims.
#include "game/physics/engine/bounce.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/physics/contact/contact_problem.h"

namespace rink::physics::inline RINK_PRECISION {

/// The impulse goes along the line of centres l as it is, (1 + e) (l . w) / ((1/m + 1/m') l . l),
/// for a unit normal is a little too long or too short, which does not average out: it changed the
/// energy of 1,000 pucks by -1e-19 per impact.
void Bounce::apply(const Contact& c, Real given_back, Real time) {
  assert(given_back >= 0.0 && given_back <= 1.0);
  for (int axis = 0; axis < 2; ++axis) {
    if (c.gap.normal[axis] == 0.0 && !spec_.surface_friction) continue;
    rests_.dissolve(c.body, axis, time);
    if (is_body(c.partner)) rests_.dissolve(c.partner, axis, time);
  }
  const RealVector here = bodies_.velocity(c.body), there = bodies_.velocity(c.partner);
  const RealVector& line = c.gap.line;
  const Real square = line.squaredNorm(), length = std::sqrt(square),
             approach = line.dot(there - here);
  const Real separation = std::max(given_back * approach, least_parting(here, there, length));
  const Real own = bodies_.inverse_mass(c.body), other = bodies_.inverse_mass(c.partner);
  const Real impulse = std::max<Real>(0.0, approach + separation) / ((own + other) * square);
  spec_.surface_friction ? rub(c, impulse * length) : push(c, impulse);
}

void Bounce::push(const Contact& c, Real impulse) {
  const RealVector here = bodies_.velocity(c.body), there = bodies_.velocity(c.partner);
  const RealVector& line = c.gap.line;
  const Real own = bodies_.inverse_mass(c.body), other = bodies_.inverse_mass(c.partner);
  bodies_.set_velocity(c.body,
                       {here.x() + impulse * own * line.x(), here.y() + impulse * own * line.y()});
  if (other == 0.0) return;
  bodies_.set_velocity(
      c.partner, {there.x() - impulse * other * line.x(), there.y() - impulse * other * line.y()});
}

bool Bounce::turns(Partner p) const { return is_body(p) && bodies_[p].kind == BodyKind::puck; }

/// The impulse along the normal and that of the surfaces along the tangent, which turns discs (O.
/// R. Walton, Mechanics of Materials 16, 1993; docs/physics.md, "Spin").
void Bounce::rub(const Contact& c, Real normal_impulse) {
  const RealVector &normal = c.gap.normal, tangent(-normal.y(), normal.x());
  const Real rubbing = tangential_impulse(c, tangent, normal_impulse);
  const RealVector impulse = normal_impulse * normal + rubbing * tangent;
  kick(c.body, impulse, rubbing, 1.0);
  if (bodies_.inverse_mass(c.partner) > 0.0) kick(c.partner, impulse, rubbing, -1.0);
}

/// The surfaces stick if that suffices to turn their slip, and slide otherwise.
Real Bounce::tangential_impulse(const Contact& c, const RealVector& tangent,
                                Real normal_impulse) const {
  const auto rim_speed = [&](Partner p) {
    return turns(p) ? bodies_.spin(p) * bodies_[p].radius : Real(0.0);
  };
  // Of a uniform disc, 1/m + r^2/I = 3/m.
  const auto yielding = [&](Partner p) { return (turns(p) ? 3.0 : 1.0) * bodies_.inverse_mass(p); };
  const MaterialId own = bodies_[c.body].material,
                   other = is_body(c.partner) ? bodies_[c.partner].material : spec_.field.wall;
  const Real slip = tangent.dot(bodies_.velocity(c.body) - bodies_.velocity(c.partner)) -
                    (rim_speed(c.body) + rim_speed(c.partner));
  const Real stick = (1.0 + Real(spec_.surface_friction->tangential_restitution(own, other))) *
                     std::abs(slip) / (yielding(c.body) + yielding(c.partner));
  return -std::copysign(
      std::min<Real>(stick, spec_.surface_friction->coefficient(own, other) * normal_impulse),
      slip);
}

void Bounce::kick(std::uint32_t body, const RealVector& impulse, Real rubbing, Real sign) {
  const RealVector velocity = bodies_.velocity(body);
  const Real inverse_mass = bodies_.inverse_mass(body), yielding = sign * inverse_mass;
  bodies_.set_velocity(
      body, {velocity.x() + yielding * impulse.x(), velocity.y() + yielding * impulse.y()});
  if (turns(body))
    bodies_.set_spin(body,
                     bodies_.spin(body) - 2.0 * inverse_mass * rubbing / bodies_[body].radius);
}

}  // namespace rink::physics::inline RINK_PRECISION
