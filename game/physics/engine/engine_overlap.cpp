// Bodies that are pushed to and fro at one instant, for they started in overlap or have no room:
// time must advance all the same.
#include <algorithm>
#include <limits>

#include "game/physics/engine/engine.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {
/// Impacts of one body at one and the same instant. Free bodies in overlap part after a few; a body
/// that lies in two fixed ones at once never would.
constexpr std::uint32_t repeats_max = 100;
/// Likewise within roundings of the clock: more than elastic series between masses 1e12 apart take.
constexpr std::uint32_t hemmed_in_min = 10'000;
}  // namespace

/// Counts the impacts of each body at the instant at hand.
void Engine::count_meeting(const Contact& c) {
  for (const Partner p : {c.body, c.partner})
    if (!is_fixed(p)) rhythms_[p].meetings.add(clock_.instant_begin);
}

std::uint32_t Engine::meetings(const Contact& c) const {
  return std::max(rhythms_[c.body].meetings.count,
                  is_fixed(c.partner) ? 0u : rhythms_[c.partner].meetings.count);
}

/// Whether somebody has so little room that even lossless impacts at one instant do not end:
/// elastic series between unequal masses take fewer.
bool Engine::is_hemmed_in(const Contact& c) const { return meetings(c) > hemmed_in_min; }

/// Whether nothing that parts them has helped.
bool Engine::is_beyond_hope(const Contact& c) const { return meetings(c) > 2 * hemmed_in_min; }

/// Counts the impact at `time`; whether one of the two has had its fill.
bool Engine::is_stuck(const Contact& c, Real time) {
  const auto has_had_enough = [&](std::uint32_t body) {
    return rhythms_[body].repeats.add(time) > repeats_max;
  };
  const bool is_own = has_had_enough(c.body),
             is_other = !is_fixed(c.partner) && has_had_enough(c.partner);
  return is_own || is_other;
}

/// Stops all that hangs together with the contact, for as long as nothing else acts on it.
void Engine::stop_around(const Contact& c, Real time) {
  gather(c, std::numeric_limits<Real>::infinity(), time);
  record_.note(EventKind::freeze, time, c.body, c.partner);
  stop_cluster();
}

void Engine::stop_cluster() {
  ++jam_count_;
  const std::uint32_t jam = *std::min_element(
      joint_.begin(), joint_.end());  // nobody is in two, so that it names the jam in every world
  for (const std::uint32_t body : joint_) {
    Body& b = bodies_[body];
    b.vx = b.vy = 0.0;
    b.flags |= frozen;
    jams_[body] = jam;
    frozen_.push_back(body);
    for (int axis = 0; axis < 2; ++axis) set_law(body, axis, 0.0, own_drag(body));
  }
}

}  // namespace rink::physics::inline RINK_PRECISION
