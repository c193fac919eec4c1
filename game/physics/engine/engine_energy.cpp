// The books of energy, for worlds that keep them: what thrust put in, and what drag, friction and
// impacts took out, from the closed forms.
#include "game/physics/engine/engine.h"

#include <algorithm>

namespace rink::physics::inline RINK_PRECISION {

/// Of its motion and spin at its last event [J].
Real Engine::energy_of(std::uint32_t body) const {
  const Body& b = bodies_[body];
  if (b.kind == BodyKind::post) return 0.0;
  const Real spin_energy = is_rough() && b.kind == BodyKind::puck
                               ? 0.25 * b.radius * b.radius * spins_[body] * spins_[body]
                               : 0.0;
  return builds_[body].mass * (0.5 * (b.vx * b.vx + b.vy * b.vy) + spin_energy);
}

/// What the law of the body has cost since its last event, at `time`: along each axis the integrals
/// of a v and g v^2, with v = v0 e + a s (docs/physics.md, "Energy"). Of the acceleration, friction
/// takes its part; all else is thrust: the body's own, or its share in that of those who press on
/// it.
auto Engine::expense_until(std::uint32_t body, Real time) const -> Expense {
  const Motion m = motion(body);
  const Real elapsed = std::min(time, m.rest_time) - m.time;
  if (elapsed <= 0.0 || builds_[body].inverse_mass == 0.0) return {0.0, 0.0};
  const bool is_rubbed = is_slowed(body);
  Real pushed = 0.0, dragged = 0.0, rubbed = 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    const Real v = m.velocity[axis], a = m.acceleration[axis], g = m.drag[axis];
    const WarpedTime w = a == 0.0 ? warp_unaccelerated(elapsed, g) : warp(elapsed, g);
    pushed += a * (v * w.s + a * w.q);
    if (is_rubbed) rubbed += slowing_[body][axis] * (v * w.s + a * w.q);
    dragged +=
        g * v * (0.5 * v * w.s * (1.0 + w.e) + a * w.s * w.s) + a * a * (w.q - 0.5 * w.s * w.s);
  }
  const Real mass = builds_[body].mass;
  if (is_rubbed) return {mass * (pushed - rubbed), mass * (dragged - rubbed)};
  return {mass * pushed, mass * dragged};
}

void Engine::enter_expense(std::uint32_t body, Real time) {
  const Expense expense = expense_until(body, time);
  work_.add(expense.work);
  loss_.add(expense.loss);
}

/// What the event at hand took from the bodies that it touched.
void Engine::enter_impacts() {
  for (std::size_t i = 0; i < touched_.size(); ++i)
    if (!is_gone(touched_[i])) loss_.add(energies_[i] - energy_of(touched_[i]));
  energies_.clear();
}

Real Engine::work_of_thrust() const {
  if (!spec_.accounts_energy) return 0.0;
  Sum sum = work_;
  for (std::uint32_t body = 0; body < bodies_.size(); ++body)
    if (!is_gone(body)) sum.add(expense_until(body, clock_.now).work);
  return sum.value();
}

Real Engine::dissipated() const {
  if (!spec_.accounts_energy) return 0.0;
  Sum sum = loss_;
  for (std::uint32_t body = 0; body < bodies_.size(); ++body)
    if (!is_gone(body)) sum.add(expense_until(body, clock_.now).loss);
  return sum.value();
}

}  // namespace rink::physics::inline RINK_PRECISION
