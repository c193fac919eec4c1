// Whom a body on a curve meets, and when it leaves its cell.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "game/physics/bodies/tolerances.h"
#include "game/physics/engine/prediction.h"
#include "game/physics/flight/motion.h"
#include "game/physics/flight/swept_boxes.h"

namespace rink::physics::inline RINK_PRECISION {

/// What comes after the next crossing of a body on a curve is looked for then, when it looks at
/// everybody in sight anew.
Real Prediction::limit_of_curved(std::uint32_t body, std::uint32_t other) const {
  Real limit = events_[body].impact_time;
  for (const std::uint32_t one : {body, other})
    if ((bodies_[one].flags & Body::curved) != 0)
      limit = std::min(limit, events_[one].crossing_time);
  return limit + Real(instant);
}

/// By the boxes that both sweep until `limit`. It takes a tenth of the time of the first safe step,
/// and tells that of those in sight of a bat two in three are too far.
bool Prediction::may_meet(std::uint32_t one, std::uint32_t other, Real limit) const {
  const Body &a = bodies_[one], &b = bodies_[other];
  const RealVector &push_a = bodies_.law(one).acceleration,
                   &push_b = bodies_.law(other).acceleration;
  const RealVector reach = bodies_.build(one).half_extent + bodies_.build(other).half_extent +
                           RealVector::Constant(a.radius + b.radius + Real(1e3) * tolerance_);
  const Real ahead_a = limit - a.time, ahead_b = limit - b.time;
  if (!may_come_within(reach.x(), b.x - a.x, stretch_of(a.vx, push_a.x(), ahead_a),
                       stretch_of(b.vx, push_b.x(), ahead_b)) ||
      !may_come_within(reach.y(), b.y - a.y, stretch_of(a.vy, push_a.y(), ahead_a),
                       stretch_of(b.vy, push_b.y(), ahead_b)))
    return false;
  return a.time < b.time ? may_meet_since(one, other, reach, limit)
                         : may_meet_since(other, one, reach, limit);
}

/// The same from the later one's event on, which leaves out what the earlier one, if it flies
/// straight, has done until then. Its velocity has but faded.
bool Prediction::may_meet_since(std::uint32_t earlier, std::uint32_t later, const RealVector& reach,
                                Real limit) const {
  const Body &a = bodies_[earlier], &b = bodies_[later];
  if (a.is(Body::curved)) return true;
  const RealVector &push = bodies_.law(later).acceleration,
                   offset = RealVector(b.x, b.y) - physics::position_at(bodies_, earlier, b.time);
  const Real ahead = limit - b.time;
  return may_come_within(reach.x(), offset.x(), stretch_of(a.vx, 0.0, ahead),
                         stretch_of(b.vx, push.x(), ahead)) &&
         may_come_within(reach.y(), offset.y(), stretch_of(a.vy, 0.0, ahead),
                         stretch_of(b.vy, push.y(), ahead));
}

/// The same for a wall or the edge of a cell: half of those that a body on a curve might come to it
/// flies away from, and drag stops many that would come in the end.
bool Prediction::may_reach(std::uint32_t body, const HalfPlane& plane, Real limit) const {
  const Body& b = bodies_[body];
  const ForceLaw& law = bodies_.law(body);
  const RealVector &normal = plane.normal, position(b.x, b.y), velocity(b.vx, b.vy);
  const Real push = normal.dot(law.acceleration), drag = law.drag[normal.x() != 0.0 ? 0 : 1],
             elapsed = limit - b.time;
  const Real ahead = push == 0.0 && drag > 0.0 ? std::min<Real>(elapsed, 1.0 / drag) : elapsed;
  const Real back = stretch_of(normal.dot(velocity), push, ahead).low;
  return !(plane.gap(position).distance + back > Real(1e3) * tolerance_);
}

void Prediction::predict_curved_pair(std::uint32_t body, std::uint32_t other) {
  if ((bodies_[body].flags & bodies_[other].flags & Body::frozen) != 0 && is_still(bodies_, body) &&
      is_still(bodies_, other))
    return;
  if ((bodies_[body].flags & Body::held) != 0 && rests_.are_joined(body, other)) return;
  const std::uint32_t low = std::min(body, other), high = std::max(body, other);
  const Real limit = limit_of_curved(body, other);
  if (!may_meet(low, high, limit)) {
    --counters_.predictions;  // nothing is solved
    return;
  }
  const Motion a = bodies_.motion(low), b = bodies_.motion(high);
  const Real start = std::max(a.time, b.time);
  const auto time =
      first_contact(RelativeMotion{a, b}, shape_of(bodies_, low, high), start, limit, tolerance_);
  if (time) offer(body, *time, other);
}

/// Bookkeeping: when the centre leaves its cell by the margin, or nearly (by less than that, so
/// that it does not come back at once). Any instant from the present on would do as well, if it
/// lies by then where the next cell may list it. The side that it flies to is asked first, as it
/// mostly rules out the others.
void Prediction::predict_curved_crossing(std::uint32_t body) {
  NextEvent& slot = events_.slot(body);
  slot.crossing_time = infinity;
  const CellGrid::Place place = grid_.place(body);
  const Motion moving = bodies_.motion(body);
  const Real start = std::max(bodies_[body].time, clock_.now), slack = Real(grid_.side() / 256.0);
  const auto leave = [&](Real edge, const RealVector& normal, CellGrid::Direction direction) {
    if (std::abs(edge) == infinity) return;
    const HalfPlane plane{normal, normal.sum() * edge};
    const Real limit = std::min(slot.impact_time, slot.crossing_time);
    if (!may_reach(body, plane, limit)) return;
    const auto time = time_near(moving, plane, start, limit, slack);
    if (!time || *time >= slot.crossing_time) return;
    slot.crossing_time = *time;
    slot.direction = direction;
  };
  const auto leave_along = [&](bool is_high, bool is_end) {
    const Real sign = is_high ? -1.0 : 1.0;
    if (is_end)
      leave(grid_.column_edge(place.column, is_high), {sign, 0.0},
            is_high ? CellGrid::right : CellGrid::left);
    else
      leave(grid_.row_edge(place.row, is_high), {0.0, sign},
            is_high ? CellGrid::up : CellGrid::down);
  };
  const bool is_right = moving.velocity.x() > 0.0, is_up = moving.velocity.y() > 0.0;
  leave_along(is_right, true), leave_along(is_up, false);
  leave_along(!is_right, true), leave_along(!is_up, false);
}

}  // namespace rink::physics::inline RINK_PRECISION
