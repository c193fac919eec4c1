// What the field, the cells and everybody near have in store for a body.
#include "game/physics/engine/prediction.h"

#include <algorithm>
#include <cmath>

#include "game/physics/bodies/field_parts.h"
#include "game/physics/bodies/tolerances.h"
#include "game/physics/flight/straight_flight.h"

namespace rink::physics::inline RINK_PRECISION {

Prediction::Prediction(const WorldSpec& spec, const Uses& uses)
    : field_(spec.field),
      clock_(uses.clock),
      bodies_(uses.bodies),
      grid_(uses.grid),
      history_(uses.history),
      rests_(uses.rests),
      events_(uses.events),
      counters_(uses.counters),
      puck_drag_(spec.puck_drag),
      tolerance_(offset_tolerance(spec)) {}

/// A wall is met anew in each cell along it, and who was lost out of sight may come back.
bool Prediction::is_known(const NextEvent& slot, Real time, Partner p) const {
  return time == slot.impact_time && p == slot.partner &&
         (!is_body(p) || bodies_[p].version == slot.partner_version);
}

/// Ties break by (time, lower id, higher id); parts of the field count as higher than every body.
/// Whether another impact follows within the instant does not depend on the order of the offers.
void Prediction::offer(std::uint32_t body, Real time, Partner p) {
  NextEvent& slot = events_.slot(body);
  if (time > slot.impact_time + Real(instant) || time == infinity || is_known(slot, time, p))
    return;
  slot.is_tied = time >= slot.impact_time - Real(instant);
  if (time > slot.impact_time) return;
  if (time == slot.impact_time && std::minmax(body, p) >= std::minmax(body, slot.partner)) return;
  slot.impact_time = time;
  slot.partner = p;
  slot.partner_version = is_body(p) ? bodies_[p].version : 0;
}

void Prediction::predict(std::uint32_t body) {
  if (bodies_[body].kind == BodyKind::post) return;
  look(body);
  events_.schedule(body);
}

void Prediction::predict_beyond(std::uint32_t body, CellGrid::Direction direction) {
  look_beyond(body, direction);
  events_.schedule(body);
}

/// Forgets what was known, and asks the field.
void Prediction::begin_alone(std::uint32_t body) {
  NextEvent& slot = events_.slot(body);
  slot.impact_time = infinity;
  slot.partner = partner::none;
  slot.is_tied = false;
  const Body& b = bodies_[body];
  if (!b.is(Body::curved | Body::held | Body::frozen) && b.mouth == Body::no_mouth &&
      !bodies_.is_slowed()) {
    predict_flight(body);  // as predict_field() would, which takes 20 instructions to find out
  } else {
    predict_field(body);
  }
}

/// The same, and makes all who are near candidates; returns how many, the body itself among them.
std::uint32_t Prediction::begin(std::uint32_t body) {
  begin_alone(body);
  --counters_.predictions;  // of the body with itself
  return grid_.collect(body, room_for_candidates());
}

std::uint32_t Prediction::predict_counting(std::uint32_t body) {
  const std::uint32_t count = begin(body), straight = sort_by_curves(count);
  counters_.predictions += count;
  std::uint32_t touching = 0;
  for (std::uint32_t k = straight; k < count; ++k) {
    const std::uint32_t other = candidates_[k];
    touching += may_touch_on_curve(body, other);
    predict_curved_pair(body, other);
  }
  return touching + (puck_drag_ > 0.0
                         ? predict_dragged_counting(body, straight)
                         : predict_straight_pairs<true>(body, candidates_.data(), straight));
}

std::uint32_t Prediction::predict_curved_counting(std::uint32_t body) {
  const std::uint32_t count = begin(body);
  std::uint32_t touching = 1;
  for (std::uint32_t k = 0; k < count; ++k)
    touching += candidates_[k] != body && may_touch_on_curve(body, candidates_[k]);
  predict_pairs(body, count);
  return touching;
}

/// Puts those of the first `count` candidates last that are on curves; returns how many are not.
std::uint32_t Prediction::sort_by_curves(std::uint32_t count) {
  if (bodies_.curved_count() == 0 || !sees_curves(count)) return count;
  std::uint32_t* const near = candidates_.data();
  return static_cast<std::uint32_t>(
      std::partition(near, near + count,
                     [&](std::uint32_t other) { return !bodies_[other].is(Body::curved); }) -
      near);
}

/// When the flight of `body` begins. Of one that has begun a later course already nobody knows.
bool Prediction::may_touch_on_curve(std::uint32_t body, std::uint32_t other) const {
  const Body& b = bodies_[body];
  if (bodies_[other].time > b.time) return true;
  const RealVector offset = RealVector(b.x, b.y) - physics::position_at(bodies_, other, b.time);
  return shape_of(bodies_, body, other).gap(offset).distance <= Real(clear_of_touching);
}

/// Among the first `count` of the candidates. Nearly never, so that it looks at all without a
/// branch.
bool Prediction::sees_curves(std::uint32_t count) const {
  const std::uint32_t* const near = candidates_.data();
  const Body* const all = bodies_.table().bodies.data();
  std::uint32_t flags = 0;
#pragma GCC unroll 4
  for (std::uint32_t k = 0; k < count; ++k) flags |= all[near[k]].flags;
  return (flags & Body::curved) != 0;
}

void Prediction::predict_field(std::uint32_t body) {
  const Body& b = bodies_[body];
  if (bodies_.is_slowed() && bodies_.rest_time(body) < infinity)
    offer(body, bodies_.rest_time(body), partner::stop);
  if (b.is(Body::held))
    rests_.for_each_end(body, [&](Real time) { offer(body, time, partner::release); });
  if (b.is(Body::frozen) && !is_still(bodies_, body))
    offer(body, std::max(history_.last_hop(body), b.time), partner::release);
  if (b.is(Body::curved)) predict_curved_crossing(body), predict_curved_walls(body);
  else predict_flight(body);
  if (b.mouth != Body::no_mouth) predict_mouth(body);
}

/// The crossing of a body in straight flight and, where its cell lies at the rim, the wall: from
/// any other cell a crossing comes first.
void Prediction::predict_flight(std::uint32_t body) {
  const Body& b = bodies_[body];
  NextEvent& slot = events_.slot(body);
  slot.crossing_time = infinity;
  if (b.vx == 0.0 && b.vy == 0.0) return;
  const CellGrid::Place place = grid_.place(body);
  const bool is_right = b.vx > 0.0, is_up = b.vy > 0.0;
  const Real x = b.vx == 0.0 ? infinity : (grid_.column_edge(place.column, is_right) - b.x) / b.vx;
  const Real y = b.vy == 0.0 ? infinity : (grid_.row_edge(place.row, is_up) - b.y) / b.vy;
  if (x == infinity) predict_end_wall(body);
  if (y == infinity) predict_side_wall(body);
  const int across = is_right ? CellGrid::right : CellGrid::left,
            along = is_up ? CellGrid::up : CellGrid::down;
  slot.direction = static_cast<CellGrid::Direction>(x <= y ? across : along);
  const Real warped = std::min(x, y);
  if (warped < infinity) slot.crossing_time = real_time(b.time, warped);
}

/// Whether the end wall is open there.
bool Prediction::is_open(Real y) const {
  return std::abs(y - 0.5 * field_.width) < 0.5 * field_.goal_width;
}

void Prediction::predict_side_wall(std::uint32_t body) {
  const Body& b = bodies_[body];
  if (b.vy == 0.0) return;
  const Real gap = b.vy < 0.0 ? b.y - b.radius : field_.width - b.radius - b.y;
  offer(body, real_time(b.time, std::max<Real>(0.0, gap) / std::abs(b.vy)),
        b.vy < 0.0 ? partner::wall_bottom : partner::wall_top);
}

void Prediction::predict_end_wall(std::uint32_t body) {
  const Body& b = bodies_[body];
  if (b.vx == 0.0 || b.mouth != Body::no_mouth) return;
  const Real gap = b.vx < 0.0 ? b.x - b.radius : field_.length - b.radius - b.x;
  const Real warped = std::max<Real>(0.0, gap) / std::abs(b.vx);
  const Real y = b.y + b.vy * warped;
  offer(body, real_time(b.time, warped),
        is_open(y)   ? partner::mouth_in
        : b.vx < 0.0 ? partner::wall_left
                     : partner::wall_right);
}

/// Those that come before the crossing.
void Prediction::predict_curved_walls(std::uint32_t body) {
  const Body& b = bodies_[body];
  const Motion still, moving = bodies_.motion(body);
  const RelativeMotion relative{still, moving};
  const RealVector extent = bodies_.build(body).half_extent + RealVector::Constant(b.radius);
  const auto predict_plane = [&](Partner wall) {
    const HalfPlane plane = plane_of(field_, wall, extent, bodies_.build(body).half);
    const Real limit =
        std::min(events_[body].impact_time, events_[body].crossing_time) + Real(instant);
    if (!may_reach(body, plane, limit)) return;
    const auto time = first_contact(relative, plane, b.time, limit, tolerance_);
    if (!time) return;
    const bool is_end = wall == partner::wall_left || wall == partner::wall_right;
    const bool is_way_in =
        is_end && b.kind == BodyKind::puck && is_open(moving.at(*time).position.y());
    offer(body, *time, is_way_in ? partner::mouth_in : wall);
  };
  const bool is_resting_x = b.vx == 0.0 && bodies_.law(body).acceleration.x() == 0.0,
             is_resting_y = b.vy == 0.0 && bodies_.law(body).acceleration.y() == 0.0;
  if (!is_resting_y) predict_plane(partner::wall_bottom), predict_plane(partner::wall_top);
  if (is_resting_x || b.mouth != Body::no_mouth) return;
  predict_plane(partner::wall_left);
  predict_plane(partner::wall_right);
  if (field_.bats_keep_to_half && b.kind == BodyKind::bat && bodies_.build(body).half != Half::both)
    predict_plane(partner::halfway);
}

/// Between the edges of a goal: the two edges, the goal line, and the way out.
void Prediction::predict_mouth(std::uint32_t body) {
  const Body& b = bodies_[body];
  const bool is_left = b.mouth == Body::left_mouth;
  const Motion moving = bodies_.motion(body);
  Motion still;
  const auto meet = [&](const auto& shape, Partner p) {
    const auto time = first_contact(RelativeMotion{still, moving}, shape, b.time,
                                    events_[body].impact_time + Real(instant), tolerance_);
    if (time) offer(body, *time, p);
  };
  const Real end = is_left ? 0.0 : field_.length, inwards = is_left ? 1.0 : -1.0;
  meet(HalfPlane{{inwards, 0.0}, inwards * end}, partner::goal_line);
  meet(HalfPlane{{-inwards, 0.0}, -inwards * (end + inwards * b.radius)}, partner::mouth_out);
  for (const Partner edge : {is_left ? partner::edge_left_low : partner::edge_right_low,
                             is_left ? partner::edge_left_high : partner::edge_right_high}) {
    still.position = goal_edge(field_, edge);
    meet(RoundedBox{{0.0, 0.0}, b.radius}, edge);
  }
}

/// The first `count` of the candidates.
void Prediction::predict_pairs(std::uint32_t body, std::uint32_t count) {
  counters_.predictions += count;
  std::uint32_t* near = candidates_.data();
  if ((bodies_[body].flags & Body::curved) == 0 && puck_drag_ == 0.0) {
    const std::uint32_t straight = sort_by_curves(count);
    for (std::uint32_t k = straight; k < count; ++k) predict_curved_pair(body, near[k]);
    predict_straight_pairs<false>(body, near, straight);
    return;
  }
  for (std::uint32_t k = 0; k < count; ++k)
    if (near[k] != body) predict_pair(body, near[k]);
}

/// Where somebody is met, and nothing comes at the same instant, no branch depends on whom.
template <bool counts>
std::uint32_t Prediction::predict_straight_pairs(std::uint32_t body, std::uint32_t* near,
                                                 std::uint32_t count) {
  NextEvent& slot = events_.slot(body);
  std::uint32_t touching = 0;
  for (std::uint32_t begin = 0; begin < count; begin += flight_max) {
    const std::uint32_t asked = std::min(flight_max, count - begin);
    // The slack keeps those that come within the same instant.
    const Real latest = slot.impact_time * (1.0 + 4e-15 * fineness) + Real(instant);
    const FirstContact first =
        counts
            ? first_disc_contact_counting(bodies_.table().bodies.data(), body, near + begin, asked,
                                          latest)
            : first_disc_contact(bodies_.table().bodies.data(), body, near + begin, asked, latest);
    touching += first.touching;
    if (!(first.time < infinity)) continue;
    const bool is_tied = first.second_time <= first.time + Real(instant) ||
                         (std::abs(first.time - slot.impact_time) <= Real(instant) &&
                          !is_known(slot, first.time, first.other));
    if (is_tied) {
      for (std::uint32_t k = begin; k < begin + asked; ++k)
        if (const auto time = disc_contact_time(bodies_[body], bodies_[near[k]], latest))
          offer(body, *time, near[k]);
      continue;
    }
    const bool is_earlier = first.time < slot.impact_time;
    const Partner p = is_earlier ? first.other : slot.partner;
    const std::uint32_t version = bodies_[is_earlier ? first.other : body].version;
    slot.impact_time = std::min(slot.impact_time, first.time);
    slot.partner = p;
    slot.is_tied = slot.is_tied && !is_earlier;
    slot.partner_version = is_earlier ? version : slot.partner_version;
  }
  return touching;
}

void Prediction::predict_pair(std::uint32_t body, std::uint32_t other) {
  const Body &a = bodies_[body], &b = bodies_[other];
  if (((a.flags | b.flags) & Body::curved) != 0) return predict_curved_pair(body, other);
  offer_dragged(body, other, sighting_of(a, b, puck_drag_));
}

/// The best event so far limits it; the slack keeps those that come within the same instant.
void Prediction::offer_dragged(std::uint32_t body, std::uint32_t other, const Sighting& sighting) {
  const Real latest = events_[body].impact_time * (1.0 + 4e-15 * fineness) + Real(instant);
  const auto time = dragged_contact_time(sighting, bodies_[body].radius + bodies_[other].radius,
                                         latest, puck_drag_);
  if (time) offer(body, *time, other);
}

/// The first `count` of the candidates, none on a curve; returns how many touch it.
std::uint32_t Prediction::predict_dragged_counting(std::uint32_t body, std::uint32_t count) {
  std::uint32_t touching = 1;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t other = candidates_[k];
    if (other == body) continue;
    const Sighting sighting = sighting_of(bodies_[body], bodies_[other], puck_drag_);
    const Real near = bodies_[body].radius + bodies_[other].radius + Real(clear_of_touching);
    touching += sighting.offset.squaredNorm() <= near * near;
    offer_dragged(body, other, sighting);
  }
  return touching;
}

}  // namespace rink::physics::inline RINK_PRECISION
