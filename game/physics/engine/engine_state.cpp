// Rewriting the last-event states of bodies; nothing else in the engine does.
#include "game/physics/engine/engine.h"

namespace rink::physics::inline RINK_PRECISION {

void Engine::touch(std::uint32_t body) {
  Body& b = bodies_[body];
  if ((b.flags & touched) != 0) return;
  b.flags |= touched;
  ++b.version;
  changes_.note(body);
  ++counters_.bodies_touched;
  touched_.push_back(body);
  if (ledger_.is_kept()) ledger_.note_before(energy_of(body));
}

/// Of its motion and spin at its last event [J].
Real Engine::energy_of(std::uint32_t body) const {
  const Body& b = bodies_[body];
  if (b.kind == BodyKind::post) return 0.0;
  const Real spin_energy = is_rough() && b.kind == BodyKind::puck
                               ? 0.25 * b.radius * b.radius * spins_[body] * spins_[body]
                               : 0.0;
  return builds_[body].mass * (0.5 * (b.vx * b.vx + b.vy * b.vy) + spin_energy);
}

/// What the law of the body has cost since its last event, at `time`.
Expense Engine::expense_until(std::uint32_t body, Real time) const {
  if (builds_[body].inverse_mass == 0.0) return {0.0, 0.0};
  return expense_of(motion(body), time, builds_[body].mass,
                    is_slowed(body) ? &slowing_[body] : nullptr);
}

void Engine::rebase(std::uint32_t body, Real time) {
  Body& b = bodies_[body];
  if (b.kind == BodyKind::post) return;
  keep(body);
  if (b.time < time) {
    ++counters_.evaluations;
    if (ledger_.is_kept()) ledger_.spend(expense_until(body, time));
    const Real elapsed = time - b.time;
    if ((b.flags & curved) != 0) {
      const Motion there = at(body, time);
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

/// Bodies in rest contact keep bitwise equal velocities only if they are evaluated from the same
/// instant, so they are rebased together.
void Engine::rebase_companions(std::uint32_t body, Real time) {
  rebase(body, time);
  if ((bodies_[body].flags & held) == 0) return;
  for (const std::uint32_t companion : companions(body, held)) rebase(companion, time);
}

void Engine::set_law(std::uint32_t body, int axis, Real acceleration, Real drag) {
  keep(body);
  laws_[body].acceleration[axis] = acceleration;
  laws_[body].drag[axis] = drag;
  write_law(body);
  touch(body);
}

void Engine::write_law(std::uint32_t body) {
  Body& b = bodies_[body];
  const bool is_straight = b.kind != BodyKind::bat &&
                           laws_[body].acceleration == RealVector(0.0, 0.0) &&
                           laws_[body].drag == RealVector::Constant(puck_drag_);
  curved_count_ += (is_straight ? 0u : 1u) - ((b.flags & curved) != 0 ? 1u : 0u);
  b.flags = static_cast<std::uint8_t>(is_straight ? b.flags & ~curved : b.flags | curved);
}

/// Ends the equilibrium of the jam that `body` is part of: all its members yield to their thrust
/// again.
void Engine::wake(std::uint32_t body, Real time) {
  if ((bodies_[body].flags & frozen) == 0) return;
  const std::uint32_t jam = jams_[body];
  for (std::size_t i = 0; i < frozen_.size();) {
    const std::uint32_t member = frozen_[i];
    if (jams_[member] != jam) {
      ++i;
      continue;
    }
    keep(member);
    frozen_[i] = frozen_.back();
    frozen_.pop_back();
    bodies_[member].flags = static_cast<std::uint8_t>(bodies_[member].flags & ~frozen);
    rhythms_[member].hops = 0;
    rebase(member, time);
    for (int axis = 0; axis < 2; ++axis)
      set_law(member, axis, builds_[member].thrust[axis], own_drag(member));
  }
}

}  // namespace rink::physics::inline RINK_PRECISION
