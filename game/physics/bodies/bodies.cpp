// Rewriting the last-event states of bodies; nothing else in the engine does.
#include "game/physics/bodies/bodies.h"

#include <cassert>
#include <utility>

namespace rink::physics::inline RINK_PRECISION {

Bodies::Bodies(const WorldSpec& spec, Counters& counters, EnergyLedger& ledger,
               const Observers& observers)
    : ledger_(ledger),
      counters_(counters),
      observers_(observers),
      puck_drag_(spec.puck_drag),
      bat_drag_(spec.bat_drag),
      puck_friction_(spec.puck_friction),
      is_rough_(spec.surface_friction.has_value()) {
  assert(spec.puck_drag >= 0.0 && spec.bat_drag >= 0.0 && spec.puck_friction >= 0.0);
}

Motion Bodies::motion(std::uint32_t body) const {
  const Body& b = table_.bodies[body];
  return {b.time,
          {b.x, b.y},
          {b.vx, b.vy},
          table_.laws[body].acceleration,
          table_.laws[body].drag,
          is_slowed() ? table_.rest_times[body] : std::numeric_limits<Real>::infinity()};
}

void Bodies::add(const BodyState& s) {
  assert(s.mass > 0.0 && s.inverse_mass >= 0.0 && s.flight.radius >= 0.0);
  const std::uint32_t body = count();
  table_.bodies.push_back(
      {s.flight, s.inverse_mass, 0, s.kind, s.material, s.flags, Body::no_mouth});
  changes_.add(body);
  table_.shapes.push_back({s.mass, s.inverse_mass, s.half_extent, s.thrust, s.half});
  table_.laws.push_back({RealVector(0.0, 0.0), RealVector::Constant(own_drag(body))});
  if (is_rough_) table_.spins.push_back(s.spin);
  if (is_slowed()) table_.rest_times.push_back(s.rest_time), table_.slowing.push_back(s.slowing);
  write_law(body);
}

void Bodies::restore(BodyTable table) {
  table_ = std::move(table);
  assert(table_.shapes.size() == count() && table_.laws.size() == count());
  assert(table_.rest_times.size() == (is_slowed() ? count() : 0u) &&
         table_.slowing.size() == table_.rest_times.size());
  assert(table_.spins.size() == (is_rough_ ? count() : 0u));
  curved_count_ = 0;
  for (std::uint32_t body = 0; body < count(); ++body) {
    changes_.add(body);
    curved_count_ += table_.bodies[body].is(Body::curved);
  }
}

void Bodies::read(std::uint32_t body, BodyState& state) const {
  const Body& b = table_.bodies[body];
  const BodyShape& build = table_.shapes[body];
  state.flight = b;
  state.mass = build.mass, state.inverse_mass = build.inverse_mass,
  state.half_extent = build.half_extent, state.thrust = build.thrust, state.half = build.half;
  state.acceleration = table_.laws[body].acceleration, state.drag = table_.laws[body].drag;
  if (is_slowed()) state.rest_time = rest_time(body), state.slowing = slowing(body);
  if (is_rough_) state.spin = spin(body);
  state.kind = b.kind, state.material = b.material, state.mouth = b.mouth;
  state.flags = b.flags & Body::lasting;
}

void Bodies::write(std::uint32_t body, const BodyState& s) {
  assert(body < count() && (s.flags & ~Body::lasting) == 0);
  Body& b = table_.bodies[body];
  static_cast<Flight&>(b) = s.flight;
  b.inverse_mass = s.inverse_mass, b.kind = s.kind, b.material = s.material, b.mouth = s.mouth;
  b.flags = static_cast<std::uint8_t>((b.flags & (Body::curved | Body::pending)) | s.flags);
  ++b.version;
  changes_.note(body);
  table_.shapes[body] = {s.mass, s.inverse_mass, s.half_extent, s.thrust, s.half};
  table_.laws[body] = {s.acceleration, s.drag};
  if (is_slowed()) table_.rest_times[body] = s.rest_time, table_.slowing[body] = s.slowing;
  if (is_rough_) table_.spins[body] = s.spin;
  write_law(body);
}

void Bodies::touch(std::uint32_t body) {
  Body& b = table_.bodies[body];
  if (b.is(Body::touched)) return;
  b.flags |= Body::touched;
  ++b.version;
  changes_.note(body);
  ++counters_.bodies_touched;
  touched_.push_back(body);
  if (ledger_.is_kept()) ledger_.note_before(energy_of(*this, body));
}

void Bodies::rebase(std::uint32_t body, Real time) {
  Body& b = table_.bodies[body];
  if (b.kind == BodyKind::post) return;
  keep(body);
  if (b.time < time) {
    ++counters_.evaluations;
    if (ledger_.is_kept()) ledger_.spend(energy_transfer_until(*this, body, time));
    const Real elapsed = time - b.time;
    if (b.is(Body::curved)) {
      const Motion there = motion(body).at(time);
      b.x = there.position.x(), b.y = there.position.y(), b.vx = there.velocity.x(),
      b.vy = there.velocity.y();
    } else if (puck_drag_ == 0.0) {
      b.x += b.vx * elapsed, b.y += b.vy * elapsed;
    } else {
      const WarpedTime w = warp_unaccelerated(elapsed, puck_drag_);
      b.x += b.vx * w.s, b.y += b.vy * w.s, b.vx *= w.e, b.vy *= w.e;
    }
    b.time = time;
  }
  touch(body);
}

void Bodies::set_law(std::uint32_t body, int axis, Real acceleration, Real drag) {
  assert((axis == 0 || axis == 1) && !(drag < 0.0));
  keep(body);
  table_.laws[body].acceleration[axis] = acceleration;
  table_.laws[body].drag[axis] = drag;
  write_law(body);
  touch(body);
}

void Bodies::slide(std::uint32_t body, const RealVector& acceleration, Real rest_time) {
  assert(is_slowed(body) && !(rest_time < table_.bodies[body].time));
  table_.laws[body].acceleration = acceleration;
  table_.rest_times[body] = rest_time;
  write_law(body);
}

/// Whether it flies straight follows from its law.
void Bodies::write_law(std::uint32_t body) {
  Body& b = table_.bodies[body];
  const bool is_straight = b.kind != BodyKind::bat &&
                           table_.laws[body].acceleration == RealVector(0.0, 0.0) &&
                           table_.laws[body].drag == RealVector::Constant(puck_drag_);
  curved_count_ += (is_straight ? 0u : 1u) - (b.is(Body::curved) ? 1u : 0u);
  is_straight ? clear_flags(body, Body::curved) : set_flags(body, Body::curved);
}

void Bodies::close_books() {
  assert(ledger_.is_kept());
  for (std::size_t i = 0; i < touched_.size(); ++i)
    if (!table_.bodies[touched_[i]].is(Body::gone))
      ledger_.note_after(i, energy_of(*this, touched_[i]));
  ledger_.close_event();
}

void Bodies::forget_touched() {
  for (const std::uint32_t body : touched_) clear_flags(body, Body::touched);
  touched_.clear();
}

Real energy_of(const Bodies& bodies, std::uint32_t body) {
  const Body& b = bodies[body];
  if (b.kind == BodyKind::post) return 0.0;
  const std::vector<Real>& spins = bodies.table().spins;
  const Real spin_energy = !spins.empty() && b.kind == BodyKind::puck
                               ? 0.25 * b.radius * b.radius * spins[body] * spins[body]
                               : 0.0;
  return bodies.build(body).mass * (0.5 * (b.vx * b.vx + b.vy * b.vy) + spin_energy);
}

EnergyTransfer energy_transfer_until(const Bodies& bodies, std::uint32_t body, Real time) {
  if (bodies.inverse_mass(body) == 0.0) return {0.0, 0.0};
  return energy_transfer_of(bodies.motion(body), time, bodies.build(body).mass,
                            bodies.is_slowed(body) ? &bodies.slowing(body) : nullptr);
}

}  // namespace rink::physics::inline RINK_PRECISION
