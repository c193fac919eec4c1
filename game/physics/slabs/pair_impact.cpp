// One impulse, and what books and history are told.
#include "game/physics/slabs/pair_impact.h"

#include <cassert>

#include "game/physics/bodies/tolerances.h"
#include "game/physics/engine/free_impact.h"
#include "game/physics/flight/motion.h"

namespace rink::physics::inline RINK_PRECISION {

PairImpact::PairImpact(const Engine::Parts& engine)
    : bodies_(engine.bodies),
      history_(engine.history),
      restitution_(engine.spec.restitution),
      rest_speed_(rest_speed(engine.spec)),
      puck_drag_(engine.spec.puck_drag),
      keeps_books_(engine.spec.accounts_energy) {}

void PairImpact::begin_window() {
  book_.clear();
  counted_.clear();
}

bool PairImpact::bounce(std::uint32_t low, std::uint32_t high, Real time) {
  assert(low < high && high < bodies_.count());
  const Body &a = bodies_[low], &b = bodies_[high];
  if ((a.flags | b.flags) != 0 || a.kind != BodyKind::puck || b.kind != BodyKind::puck)
    return false;
  low_ = low, high_ = high;
  given_back_ = Real(restitution_(a.material, b.material));
  if (given_back_ < 1.0 &&
      (history_.would_be_worn(low, time) || history_.would_be_worn(high, time)))
    return false;
  low_before_ = a, high_before_ = b;
  const auto square =
      bounce_freely(bodies_, low, high, time, {rest_speed_, given_back_, puck_drag_});
  if (!square) return false;
  const Real touching = a.radius + b.radius + Real(0.5 * clear_of_touching);
  was_near_ = *square <= touching * touching;
  return true;
}

void PairImpact::take_back() {
  bodies_.take_back(low_, low_before_, bodies_[low_].version - 1);
  bodies_.take_back(high_, high_before_, bodies_[high_].version - 1);
}

void PairImpact::settle(Real time) {
  if (given_back_ < 1.0) count(low_, time), count(high_, time);
  if (!keeps_books_) return;
  const EventOrder order{time, low_, high_};
  if (puck_drag_ > 0.0)
    enter_drag(low_, low_before_, order), enter_drag(high_, high_before_, order);
  enter(low_, low_before_, order), enter(high_, high_before_, order);
}

/// As Impact does where impacts lose energy.
void PairImpact::count(std::uint32_t body, Real time) {
  const ImpactCounts& counts = history_.impact_counts()[body];
  counted_.push_back({body, counts.impacts, counts.window_start});
  history_.note_impact(body, time);
}

/// As Bodies::rebase() does: what drag has taken since the last event.
void PairImpact::enter_drag(std::uint32_t body, const Flight& before, const EventOrder& order) {
  if (!(before.time < order.time)) return;
  Motion motion = bodies_.motion(body);
  motion.time = before.time;
  motion.position = {before.x, before.y}, motion.velocity = {before.vx, before.vy};
  book_.push_back(
      {order, energy_transfer_of(motion, order.time, bodies_.build(body).mass, nullptr)});
}

/// As Bodies::close_books() does.
void PairImpact::enter(std::uint32_t body, const Flight& before, const EventOrder& order) {
  const Real elapsed = before.time < order.time ? order.time - before.time : Real(0.0),
             slowed = warp_unaccelerated(elapsed, puck_drag_).e, vx = before.vx * slowed,
             vy = before.vy * slowed;
  const Real energy = bodies_.build(body).mass * (0.5 * (vx * vx + vy * vy));
  book_.push_back({order, {0.0, energy - energy_of(bodies_, body)}});
}

void PairImpact::undo() {
  for (const Counted& counted : counted_)
    history_.take_back_impacts(counted.body, counted.window_start, counted.impacts);
}

}  // namespace rink::physics::inline RINK_PRECISION
