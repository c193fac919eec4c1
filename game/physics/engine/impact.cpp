// The questions before a bounce.
#include "game/physics/engine/impact.h"

#include <algorithm>
#include <cassert>

#include "game/physics/bodies/tolerances.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {

/// Pressed contact has at least this closing acceleration [m/s^2]; below it a contact counts as
/// unpressed.
constexpr double press_min = 1e-7;

}  // namespace

Impact::Impact(const WorldSpec& spec, const Uses& uses)
    : clock_(uses.clock),
      bodies_(uses.bodies),
      detection_(uses.detection),
      history_(uses.history),
      rests_(uses.rests),
      record_(uses.record),
      clusters_(spec, {.bodies = uses.bodies,
                       .detection = uses.detection,
                       .history = uses.history,
                       .jams = uses.jams,
                       .rests = uses.rests,
                       .record = uses.record,
                       .observers = uses.observers}),
      joint_impacts_(spec, {.clock = uses.clock,
                            .bodies = uses.bodies,
                            .detection = uses.detection,
                            .history = uses.history,
                            .rests = uses.rests,
                            .record = uses.record,
                            .observers = uses.observers}),
      bounce_(spec, uses.bodies, uses.rests),
      rest_speed_(rest_speed(spec)),
      allows_overlap_(spec.allow_overlap) {}

void Impact::collide(std::uint32_t body, Partner p, Real time, bool is_crowded) {
  assert(p != partner::none);
  const std::uint32_t first = is_body(p) ? std::min(body, p) : body;
  if (is_body(p)) p = std::max(body, p);
  if (is_body(p) && bodies_.build(first).inverse_mass == 0.0)
    return collide_ordered(p, first, time, is_crowded);
  collide_ordered(first, p, time, is_crowded);
}

/// The body can move; of two that can, it is the one with the lower number.
void Impact::collide_ordered(std::uint32_t body, Partner p, Real time, bool is_crowded) {
  record_.note(impact_kind(bodies_, body, p), time, body, p);
  if (clusters_.meet_within_pile({body, p, {}}, time)) return;
  rests_.rouse(body, time);
  if (is_body(p)) rests_.rouse(p, time);
  const Contact c = detection_.contact(body, p, time);
  if (allows_overlap_ && history_.is_stuck(c, time)) return clusters_.stop_around(c, time);
  history_.count_meeting(c, clock_.instant_begin);
  if (history_.is_stalled(c)) return clusters_.stop_around(c, time);
  const Real approach = c.gap.normal.dot(bodies_.velocity(p) - bodies_.velocity(body)),
             given_back = detection_.restitution(body, p);
  if ((approach < rest_speed_ || given_back < 1.0 || history_.is_jammed(c)) &&
      rest_or_hop(c, approach, time))
    return;
  if (is_crowded && joint_impacts_.collide(c, time)) return;
  if (!is_crowded) joint_impacts_.record_dependencies(c, time);
  bounce_.apply(c, given_back, time);
}

/// Of a contact that is slow or loses energy, or has no room; false if it is an ordinary impact.
bool Impact::rest_or_hop(const Contact& c, Real approach, Real time) {
  const Real pressing =
      c.gap.normal.dot(acceleration_of(bodies_, c.partner) - acceleration_of(bodies_, c.body));
  // A body in an arc of friction (friction.h) may be pressed by the arc's law and pulled by the
  // instant's: it comes to rest so often at one instant, then it hops.
  if (approach < rest_speed_ && pressing > press_min && rests_.can_join(c) &&
      !(bodies_.is_slowed() && history_.has_rested_enough(c.body, time)))
    return rests_.join(c, time), true;
  history_.note_impact(c.body, time);
  if (!bodies_.is_fixed(c.partner)) history_.note_impact(c.partner, time);
  return (history_.is_jammed(c) || history_.is_pressed_hard(c, approach, time)) &&
         clusters_.hop(c, approach, pressing, time);
}

}  // namespace rink::physics::inline RINK_PRECISION
