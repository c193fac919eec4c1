// Counts a puck's stay from its last crossing.
#include "game/physics/halves/halves.h"

namespace rink::physics::inline RINK_PRECISION {
namespace {

bool is_same(const Motion& a, const Motion& b) {
  return a.time == b.time && a.position == b.position && a.velocity == b.velocity &&
         a.acceleration == b.acceleration && a.drag == b.drag && a.rest_time == b.rest_time;
}

}  // namespace

void Halves::pass_crossings(Followed& puck, Real now) const {
  for (; puck.passed < puck.crossings.count; ++puck.passed) {
    const auto& [time, into] = puck.crossings.all[puck.passed];
    if (time > now) return;
    enter(puck, into, time);
  }
}

/// The old course is followed up to the event. Where rounding puts the body beyond the line there,
/// the start of the new course decides on which side it is.
void Halves::look(Followed& puck, const std::optional<Motion>& motion, Real now) {
  if (puck.is_in_play) pass_crossings(puck, now);
  const bool was_in_play = puck.is_in_play;
  puck.is_in_play = motion.has_value();
  if (!motion || !was_in_play) puck.half = Half::both;
  if (!motion || (was_in_play && is_same(*motion, puck.motion))) return;
  puck.motion = *motion;
  puck.crossings = half_crossings(*motion, line_);
  puck.passed = 0;
  const Half half = half_after(*motion, line_);
  if (half != Half::both && half != puck.half) enter(puck, half, now);
  pass_crossings(puck, now);
}

void Halves::show(std::span<const HalfStay> stays) {
  for (Followed& puck : pucks_) puck.half = Half::both;
  for (const HalfStay& stay : stays) {
    Followed& puck = followed(stay.puck);
    puck.half = stay.half, puck.until = stay.until;
  }
}

std::vector<HalfStay> Halves::stays() const {
  std::vector<HalfStay> stays;
  for (const Followed& puck : pucks_)
    if (puck.half != Half::both) stays.push_back({puck.puck, puck.half, puck.until});
  return stays;
}

Real Halves::next() const {
  Real next = std::numeric_limits<Real>::infinity();
  for (const Followed& puck : pucks_)
    if (puck.half != Half::both) next = std::min(next, puck.until);
  return next;
}

}  // namespace rink::physics::inline RINK_PRECISION
