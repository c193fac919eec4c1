// Contacts that close at the same instant: one problem, not a sequence, so that nobody's number
// decides who is hit first.
#include <algorithm>

#include "game/physics/engine/engine.h"

namespace rink::physics::inline RINK_PRECISION {

/// Whether another impact may come at the instant at hand. Never misses one: an impact is either
/// the first of its body, and thus in the queue, or hidden behind that one.
bool Engine::is_crowded(std::uint32_t body, Partner p) const {
  return slots_[body].is_tied || (is_body(p) && slots_[p].is_tied) || clock_.is_endless() ||
         queue_.is_followed_within(instant);
}

/// The impact at hand together with all others that close at this instant among bodies that touch,
/// directly or through others. False if there are none, or if no solution was found that keeps the
/// energy; then nothing has changed, and no other is looked for until the instant is over.
bool Engine::collide_together(const Contact& c, Real time) {
  if (spec_.surface_friction || clock_.is_hopeless) return false;
  const bool is_joint = gather_touching(c, time) || clock_.is_endless();
  note_looked_at();
  if (!is_joint) return false;
  velocities_before_ = problem_.velocities;
  clock_.is_hopeless = !impact_solver_.solve(problem_, clock_.is_endless());
  if (clock_.is_hopeless && observers_.journal != nullptr) observers_.journal->was_hopeless = true;
  if (clock_.is_hopeless) return false;
  ++record_.counters().joint_impacts;
  apply_joint(c, time);
  return true;
}

/// Writes the velocities back. Rest contacts of whoever was pushed end as in any impact, and every
/// contact that pushed counts as one.
void Engine::apply_joint(const Contact& at_hand, Real time) {
  for (std::size_t i = 0; i < problem_.touches.size(); ++i) {
    const Touch& touch = problem_.touches[i];
    if (!touch.has_pushed) continue;
    const std::uint32_t body = joint_[touch.body];
    const Partner partner = partners_[i];
    if (body != at_hand.body || partner != at_hand.partner) {
      if (bodies_.is_fixed(partner)) count_impact(body, partner, time);
      else count_impact(std::min(body, partner), std::max(body, partner), time);
      history_.note_impact(body, time);
      if (!bodies_.is_fixed(partner)) history_.note_impact(partner, time);
    }
    for (const Partner p : {body, partner}) {
      if (bodies_.is_fixed(p)) continue;
      rests_.rouse(p, time);
      for (int axis = 0; axis < 2; ++axis)
        if (touch.normal[axis] != 0.0) rests_.dissolve(p, axis, time);
    }
  }
  for (std::size_t place = 0; place < joint_.size(); ++place) {
    if (problem_.velocities[place] == velocities_before_[place]) continue;
    const std::uint32_t body = joint_[place];
    bodies_.keep(body);
    bodies_.set_velocity(body, problem_.velocities[place]);
    bodies_.touch(body);  // also of one that moves by a rounding without a push: what is predicted
                          // of it must follow from its state
  }
}

}  // namespace rink::physics::inline RINK_PRECISION
