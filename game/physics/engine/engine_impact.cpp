// What two bodies do to each other at the instant they touch.
#include <algorithm>

#include "game/physics/engine/engine.h"
#include "game/physics/flight/straight_flight.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {

/// Pressed contact has at least this closing acceleration [m/s^2]; below it a contact counts as
/// unpressed.
constexpr double press_min = 1e-7;

}  // namespace

/// Two pucks that nothing holds, hitting each other fast and giving back all: nearly every event of
/// a gas. The arithmetic of collide() without its questions, so the same bits. False, with nothing
/// done, for anything else. A third one that touches matters to a journal alone; who is near is
/// looked at where the next events are predicted, so what was done until then is taken back if
/// there is one.
bool Engine::collide_freely(std::uint32_t body, Partner p, Real time) {
  if (!is_body(p)) return false;
  const std::uint32_t low = std::min(body, p), high = std::max(body, p);
  const Body &a = bodies_[low], &b = bodies_[high];
  if ((a.flags | b.flags) != 0 || a.kind != BodyKind::puck || b.kind != BodyKind::puck ||
      !has_free_impacts_ || spec_.restitution(a.material, b.material) != 1.0)
    return false;
  if (clock_.is_endless() || events_.is_followed_at_once(body, p)) return false;
  const bool is_counting =
      observers_.journal != nullptr && bodies_.curved_count() == 0 && counts_touching();
  if (observers_.journal != nullptr && !is_counting && detection_.has_company(body, p, time))
    return false;
  const Real elapsed_a = a.time < time ? time - a.time : 0.0,
             elapsed_b = b.time < time ? time - b.time : 0.0;
  const Real ax = a.x + a.vx * elapsed_a, ay = a.y + a.vy * elapsed_a, bx = b.x + b.vx * elapsed_b,
             by = b.y + b.vy * elapsed_b;
  const Real x = ax - bx, y = ay - by;
  if (x == 0.0 || y == 0.0)
    return false;  // in line with an axis they might come to rest on each other
  const Real approach = x * (b.vx - a.vx) + y * (b.vy - a.vy),
             length_max = std::abs(x) + std::abs(y), square = x * x + y * y;
  const Real speed_max = std::abs(a.vx) + std::abs(a.vy) + std::abs(b.vx) + std::abs(b.vy);
  if (!(approach >= 1.01 * std::max<Real>(rest_speed_, separation_min * speed_max) * length_max))
    return false;
  const Flight before_a = a, before_b = b;
  const Real impulse = (approach + approach) / ((a.inverse_mass + b.inverse_mass) * square);
  const Real kick_a = impulse * a.inverse_mass, kick_b = impulse * b.inverse_mass;
  bodies_.restart(low, {ax, ay}, {a.vx + kick_a * x, a.vy + kick_a * y}, std::max(a.time, time));
  bodies_.restart(high, {bx, by}, {b.vx - kick_b * x, b.vy - kick_b * y}, std::max(b.time, time));
  if (is_counting) {
    const Slot slot_a = events_[low], slot_b = events_[high];
    const std::uint64_t predictions = record_.counters().predictions;
    const Real touching = a.radius + b.radius + Real(0.5 * clear_of_touching);
    const bool is_alone = square <= touching * touching && prediction_.predict_counting(low) == 2 &&
                          prediction_.predict_counting(high) == 2;  // each itself and the other
    if (!is_alone) {
      bodies_.take_back(low, before_a), bodies_.take_back(high, before_b);
      events_.slot(low) = slot_a, events_.slot(high) = slot_b;
      record_.counters().predictions = predictions;
      return false;
    }
  }
  record_.note(EventKind::puck_puck, time, low, high);
  bodies_.changes().note(low), bodies_.changes().note(high);
  record_.counters().evaluations += (before_a.time < time) + (before_b.time < time);
  record_.counters().bodies_touched += 2;
  if (observers_.journal != nullptr) {
    observers_.before->keep_flight(low, before_a), observers_.before->keep_flight(high, before_b);
    observers_.journal->enter_impact(low, a, a.mouth, high, b, b.mouth);
  }
  if (is_counting) {
    events_.schedule(low);
    events_.schedule(high);
  } else {
    prediction_.predict(low);
    prediction_.predict(high);
  }
  return true;
}

void Engine::collide(std::uint32_t body, Partner p, Real time) {
  const std::uint32_t first = is_body(p) ? std::min(body, p) : body;
  if (is_body(p)) p = std::max(body, p);
  if (is_body(p) && bodies_.build(first).inverse_mass == 0.0)
    return collide_ordered(p, first, time);
  collide_ordered(first, p, time);
}

void Engine::collide_ordered(std::uint32_t body, Partner p, Real time) {
  record_.note(impact_kind(bodies_, body, p), time, body, p);
  rests_.rouse(body, time);
  if (is_body(p)) rests_.rouse(p, time);
  const Contact c = detection_.contact(body, p, time);
  if (spec_.allow_overlap && history_.is_stuck(c, time)) return clusters_.stop_around(c, time);
  history_.count_meeting(c, clock_.instant_begin);
  if (history_.is_beyond_hope(c)) return clusters_.stop_around(c, time);
  const RealVector& normal = c.gap.normal;
  const Real approach = normal.dot(bodies_.velocity(p) - bodies_.velocity(body)),
             given_back = detection_.restitution(body, p);
  if (approach < rest_speed_ || given_back < 1.0 || history_.is_hemmed_in(c)) {
    const Real pressing = normal.dot(acceleration_of(bodies_, p) - acceleration_of(bodies_, body));
    // A body in an arc of friction (engine_friction.cpp) may be pressed by the arc's law and pulled
    // by the instant's: it comes to rest so often at one instant, then it hops.
    if (approach < rest_speed_ && pressing > press_min && rests_.can_join(c) &&
        !(bodies_.is_slowed() && history_.has_rested_enough(body, time)))
      return rests_.join(c, time);
    history_.note_impact(body, time);
    if (!bodies_.is_fixed(p)) history_.note_impact(p, time);
    if ((history_.is_hemmed_in(c) || history_.is_pressed_hard(c, approach, time)) &&
        clusters_.hop(c, approach, pressing, time))
      return;
  }
  if (clock_.is_endless() || events_.is_followed_at_once(body, p)) {
    if (joint_impacts_.collide(c, time)) return;
  } else if (observers_.journal != nullptr) {
    joint_impacts_.look_at_touching(c, time);
  }
  bounce(c, given_back, time);
}

/// Newton's law of impact along the normal. A contact that no longer closes (grazing, rounding)
/// still leaves with the least separation, or it would be found again. The impulse goes along the
/// line of centres l as it is, (1 + e) (l . w) / ((1/m + 1/m') l . l), for a unit normal is a
/// little too long or too short, which does not average out: it changed the energy of 1,000 pucks
/// by -1e-19 per impact.
void Engine::bounce(const Contact& c, Real given_back, Real time) {
  for (int axis = 0; axis < 2; ++axis) {
    if (c.gap.normal[axis] == 0.0 && !spec_.surface_friction) continue;
    rests_.dissolve(c.body, axis, time);
    if (is_body(c.partner)) rests_.dissolve(c.partner, axis, time);
  }
  const RealVector here = bodies_.velocity(c.body), there = bodies_.velocity(c.partner);
  const RealVector& line = c.gap.line;
  const Real square = line.squaredNorm(), length = std::sqrt(square),
             approach = line.dot(there - here);
  const Real separation =
      std::max(given_back * approach, separation_min * (here.norm() + there.norm()) * length);
  const Real own = bodies_.inverse_mass(c.body), other = bodies_.inverse_mass(c.partner);
  const Real impulse = std::max<Real>(0.0, approach + separation) / ((own + other) * square);
  if (spec_.surface_friction) return rub(c, impulse * length);
  bodies_.set_velocity(c.body,
                       {here.x() + impulse * own * line.x(), here.y() + impulse * own * line.y()});
  if (other == 0.0) return;
  bodies_.set_velocity(
      c.partner, {there.x() - impulse * other * line.x(), there.y() - impulse * other * line.y()});
}

/// The impulse along the normal and that of the surfaces along the tangent, which turns discs (O.
/// R. Walton, Mechanics of Materials 16, 1993; docs/physics.md, "Spin").
void Engine::rub(const Contact& c, Real normal_impulse) {
  const RealVector &normal = c.gap.normal, tangent(-normal.y(), normal.x());
  const bool is_partner_moved = bodies_.inverse_mass(c.partner) > 0.0;
  const auto turns = [&](Partner p) { return is_body(p) && bodies_[p].kind == BodyKind::puck; };
  const auto rim_speed = [&](Partner p) {
    return turns(p) ? bodies_.spin(p) * bodies_[p].radius : Real(0.0);
  };
  // Of a uniform disc, 1/m + r^2/I = 3/m.
  const auto yielding_of = [&](Partner p) {
    return (turns(p) ? 3.0 : 1.0) * bodies_.inverse_mass(p);
  };
  const MaterialId own = bodies_[c.body].material,
                   other = is_body(c.partner) ? bodies_[c.partner].material : spec_.field.wall;
  const Real slip = tangent.dot(bodies_.velocity(c.body) - bodies_.velocity(c.partner)) -
                    (rim_speed(c.body) + rim_speed(c.partner));
  const Real stick = (1.0 + Real(spec_.surface_friction->tangential_restitution(own, other))) *
                     std::abs(slip) / (yielding_of(c.body) + yielding_of(c.partner));
  const Real rubbing = -std::copysign(
      std::min<Real>(stick, spec_.surface_friction->coefficient(own, other) * normal_impulse),
      slip);
  const RealVector impulse = normal_impulse * normal + rubbing * tangent;
  const auto kick = [&](std::uint32_t body, Real sign) {
    const RealVector velocity = bodies_.velocity(body);
    const Real yielding = sign * bodies_.inverse_mass(body);
    bodies_.set_velocity(
        body, {velocity.x() + yielding * impulse.x(), velocity.y() + yielding * impulse.y()});
    if (turns(body))
      bodies_.set_spin(body, bodies_.spin(body) -
                                 2.0 * bodies_.inverse_mass(body) * rubbing / bodies_[body].radius);
  };
  kick(c.body, 1.0);
  if (is_partner_moved) kick(c.partner, -1.0);
}

}  // namespace rink::physics::inline RINK_PRECISION
