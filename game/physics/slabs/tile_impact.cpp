// One impulse, and what books and history are told.
#include "game/physics/slabs/tile_impact.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "game/physics/bodies/field_parts.h"
#include "game/physics/bodies/tolerances.h"
#include "game/physics/engine/free_impact.h"
#include "game/physics/flight/motion.h"

namespace rink::physics::inline RINK_PRECISION {

TileImpact::TileImpact(const Engine::Parts& engine)
    : bodies_(engine.bodies),
      history_(engine.history),
      field_(engine.spec.field),
      restitution_(engine.spec.restitution),
      rest_speed_(rest_speed(engine.spec)),
      puck_drag_(engine.spec.puck_drag),
      keeps_books_(engine.spec.accounts_energy),
      journal_(engine.bodies) {}

void TileImpact::begin_window(bool is_charged) {
  is_charged_ = is_charged;
  book_.clear(), charged_.clear();
  counted_.clear();
}

bool TileImpact::bounce(std::uint32_t low, std::uint32_t high, Real time) {
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
  was_near_ = *square <= touching * touching && is_off_walls(a) && is_off_walls(b);
  return true;
}

/// By more than an impact may be early: else it may hit one at the same instant.
bool TileImpact::is_off_walls(const Body& body) const {
  const Real reach = body.radius + Real(clear_of_touching);
  return body.x > reach && Real(field_.length) - body.x > reach && body.y > reach &&
         Real(field_.width) - body.y > reach;
}

bool TileImpact::is_off_walls(const RealVector& position, const RealVector& extent) const {
  const RealVector reach = extent + RealVector::Constant(Real(clear_of_touching)),
                   size(Real(field_.length), Real(field_.width));
  return (position.array() > reach.array()).all() &&
         ((size - position).array() > reach.array()).all();
}

/// Of two of which one is a puck.
bool TileImpact::may_strike(std::uint32_t body, std::uint32_t other) const {
  const Body &a = bodies_[body], &b = bodies_[other];
  const bool is_one_puck = (a.kind == BodyKind::puck) != (b.kind == BodyKind::puck);
  return is_one_puck && ((a.flags | b.flags) & ~Body::curved) == 0 &&
         !(a.kind == BodyKind::puck ? a : b).is(Body::curved) && !keeps_books_ &&
         !field_.bats_keep_to_half && restitution_(a.material, b.material) == 1.0;
}

/// As Bodies::rebase() does.
Flight TileImpact::flight_at(std::uint32_t body, Real time) const {
  const Body& b = bodies_[body];
  Flight flight = b;
  if (b.kind == BodyKind::post || !(b.time < time)) return flight;
  if (b.is(Body::curved)) {
    const Motion there = bodies_.motion(body).at(time);
    flight.x = there.position.x(), flight.y = there.position.y();
    flight.vx = there.velocity.x(), flight.vy = there.velocity.y();
  } else {
    const WarpedTime w = warp_unaccelerated(time - b.time, puck_drag_);
    flight.x += b.vx * w.s, flight.y += b.vy * w.s;
    if (puck_drag_ != 0.0) flight.vx *= w.e, flight.vy *= w.e;
  }
  flight.time = time;
  return flight;
}

/// As Impact and Bounce do.
bool TileImpact::strike(std::uint32_t one, std::uint32_t two, Real time) {
  assert(one != two && one < bodies_.count() && two < bodies_.count());
  if (!may_strike(one, two)) return false;
  low_ = std::min(one, two);
  std::uint32_t other = std::max(one, two);
  if (bodies_[low_].inverse_mass == 0.0) std::swap(low_, other);
  high_ = other, given_back_ = 1.0;
  const Body &a = bodies_[low_], &b = bodies_[other];
  const Flight own = flight_at(low_, time), its = flight_at(other, time);
  const RealVector here(own.vx, own.vy), there(its.vx, its.vy), position(own.x, own.y),
      its_position(its.x, its.y);
  gap_ = shape_of(bodies_, low_, other).gap(position - its_position);
  if (!(gap_.normal.dot(there - here) >= rest_speed_)) return false;
  low_before_ = a, high_before_ = b;
  const RealVector& line = gap_.line;
  const Real square = line.squaredNorm(), length = std::sqrt(square),
             approach = line.dot(there - here),
             separation = std::max<Real>(approach, least_parting(here, there, length)),
             impulse = std::max<Real>(0.0, approach + separation) /
                       ((a.inverse_mass + b.inverse_mass) * square),
             kick = impulse * a.inverse_mass, its_kick = impulse * b.inverse_mass;
  was_near_ = gap_.distance <= Real(0.5 * clear_of_touching) &&
              is_off_walls(position, extent_of(bodies_, low_)) &&
              (bodies_.is_fixed(other) || is_off_walls(its_position, extent_of(bodies_, other)));
  bodies_.restart(low_, position, {here.x() + kick * line.x(), here.y() + kick * line.y()},
                  own.time);
  if (!bodies_.is_fixed(other))
    bodies_.restart(other, its_position,
                    {there.x() - its_kick * line.x(), there.y() - its_kick * line.y()}, its.time);
  return true;
}

void TileImpact::count_meeting(Real instant_begin) {
  for (const Partner p : {Partner{low_}, high_})
    if (!bodies_.is_fixed(p)) keep_counts(p);
  history_.count_meeting({low_, high_, gap_}, instant_begin);
}

/// As Impact and Bounce do.
bool TileImpact::rebound(std::uint32_t body, Partner wall, Real time) {
  assert(body < bodies_.count() && wall >= partner::wall_left && wall <= partner::wall_top);
  const Body& b = bodies_[body];
  if (b.flags != 0 || b.kind != BodyKind::puck || b.mouth != Body::no_mouth) return false;
  const WarpedTime warped = warp_unaccelerated(b.time < time ? time - b.time : 0.0, puck_drag_);
  const RealVector position(b.x + b.vx * warped.s, b.y + b.vy * warped.s),
      velocity(b.vx * warped.e, b.vy * warped.e),
      normal = plane_of(field_, wall, RealVector::Constant(b.radius), Half::both).normal;
  const Real approach = normal.dot(RealVector(0.0, 0.0) - velocity);
  given_back_ = Real(restitution_(b.material, field_.wall));
  if (!(approach >= rest_speed_) || !is_clear_of_others(b, wall, position) ||
      (given_back_ < 1.0 && history_.would_be_worn(body, time)))
    return false;
  const Real parting = std::max(given_back_ * approach, separation_min * velocity.norm());
  const Real impulse = (approach + parting) / b.inverse_mass, kick = impulse * b.inverse_mass;
  low_ = body, high_ = wall, low_before_ = b;
  bodies_.restart(body, position,
                  {velocity.x() + kick * normal.x(), velocity.y() + kick * normal.y()},
                  std::max(b.time, time));
  return true;
}

/// Of the two walls that stand across, and of the edges of a goal in this one.
bool TileImpact::is_clear_of_others(const Body& body, Partner wall,
                                    const RealVector& position) const {
  const bool is_end = wall == partner::wall_left || wall == partner::wall_right;
  const Real along = is_end ? position.y() : position.x(),
             length = Real(is_end ? field_.width : field_.length),
             reach = body.radius + Real(clear_of_touching);
  return along > reach && length - along > reach && !(is_end && field_.goal_width > 0.0);
}

void TileImpact::take_back() {
  bodies_.take_back(low_, low_before_, bodies_[low_].version - 1);
  if (!bodies_.is_fixed(high_)) bodies_.take_back(high_, high_before_, bodies_[high_].version - 1);
}

void TileImpact::settle(Real time) {
  const EventOrder order{time, low_, high_};
  if (is_charged_) charged_.push_back({.time = time, .body = low_, .partner = high_});
  if (given_back_ < 1.0) {
    count(low_, time);
    if (is_body(high_)) count(high_, time);
  }
  if (journal_.is_kept()) enter_in_journal(time);
  if (!keeps_books_) return;
  if (puck_drag_ > 0.0) {
    enter_drag(low_, low_before_, order);
    if (is_body(high_)) enter_drag(high_, high_before_, order);
  }
  enter(low_, low_before_, order);
  if (is_body(high_)) enter(high_, high_before_, order);
}

/// As FreeImpact and ImpactHistory do. Asks the records that the impact has written, which are at
/// hand.
void TileImpact::enter_in_journal(Real time) {
  const bool is_of_two = is_body(high_) && bodies_[high_].inverse_mass != 0.0,
             is_of_pucks = is_of_two && bodies_[low_].kind == BodyKind::puck &&
                           bodies_[high_].kind == BodyKind::puck;
  TileJournal::Meeting meeting{
      .order = {time, std::min<Partner>(low_, high_), std::max<Partner>(low_, high_)},
      .body = low_,
      .other = is_of_two ? high_ : partner::none,
      .mixed_digest = 0,
      .is_free = is_of_pucks && given_back_ == 1.0 && puck_drag_ == 0.0 && !keeps_books_};
  if (given_back_ < 1.0) {
    meeting.mixed_digest = journal_.digest_of(low_, history_.impact_counts()[low_].impacts);
    if (is_of_two)
      meeting.mixed_digest += journal_.digest_of(high_, history_.impact_counts()[high_].impacts);
  }
  journal_.note(meeting);
}

/// As Impact does where impacts lose energy.
void TileImpact::count(std::uint32_t body, Real time) {
  keep_counts(body);
  history_.note_impact(body, time);
}

/// As Bodies::rebase() does: what drag has taken since the last event.
void TileImpact::enter_drag(std::uint32_t body, const Flight& before, const EventOrder& order) {
  if (!(before.time < order.time)) return;
  Motion motion = bodies_.motion(body);
  motion.time = before.time;
  motion.position = {before.x, before.y}, motion.velocity = {before.vx, before.vy};
  book_.push_back(
      {order, energy_transfer_of(motion, order.time, bodies_.build(body).mass, nullptr)});
}

/// As Bodies::close_books() does.
void TileImpact::enter(std::uint32_t body, const Flight& before, const EventOrder& order) {
  const Real elapsed = before.time < order.time ? order.time - before.time : Real(0.0),
             slowed = warp_unaccelerated(elapsed, puck_drag_).e, vx = before.vx * slowed,
             vy = before.vy * slowed;
  const Real energy = bodies_.build(body).mass * (0.5 * (vx * vx + vy * vy));
  book_.push_back({order, {0.0, energy - energy_of(bodies_, body)}});
}

void TileImpact::keep_counts(std::uint32_t body) {
  counted_.push_back({body, history_.impact_counts()[body]});
}

void TileImpact::undo() {
  for (const Counted& counted : counted_) history_.take_back(counted.body, counted.before);
}

}  // namespace rink::physics::inline RINK_PRECISION
