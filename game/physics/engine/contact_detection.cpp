// Gaps at an instant, and the question who else is there.
#include "game/physics/engine/contact_detection.h"

#include <algorithm>
#include <cmath>

#include "game/physics/bodies/field_parts.h"
#include "game/physics/flight/discs_near.h"
#include "game/physics/flight/straight_flight.h"

namespace rink::physics::inline RINK_PRECISION {

ContactDetection::ContactDetection(const WorldSpec& spec, const Bodies& bodies,
                                   const CellGrid& grid)
    : spec_(spec), bodies_(bodies), grid_(grid), puck_drag_(spec.puck_drag) {}

RealVector ContactDetection::position_at(std::uint32_t body, Real time) const {
  const Body& b = bodies_[body];
  return b.time >= time || b.kind == BodyKind::post ? RealVector(b.x, b.y)
                                                    : physics::position_at(bodies_, body, time);
}

Contact ContactDetection::contact(std::uint32_t body, Partner p, Real time) const {
  const RealVector position = position_at(body, time);
  if (is_body(p)) return {body, p, shape_of(bodies_, body, p).gap(position - position_at(p, time))};
  const Real radius = bodies_[body].radius;
  if (p >= partner::edge_left_low && p <= partner::edge_right_high)
    return {body, p, RoundedBox{{0.0, 0.0}, radius}.gap(position - goal_edge(spec_.field, p))};
  const BodyShape& build = bodies_.build(body);
  const RealVector extent = build.half_extent + RealVector::Constant(radius);
  return {body, p, plane_of(spec_.field, p, extent, build.half).gap(position)};
}

namespace {

/// Never wrong where the gap is not wider.
bool may_be_within(const RoundedBox& shape, const RealVector& offset, Real gap) {
  const Real reach = (shape.radius + gap) * (1.0 + 1e-9),  // rounding shall not decide
      x = std::max<Real>(0.0, std::abs(offset.x()) - shape.half_extent.x()),
             y = std::max<Real>(0.0, std::abs(offset.y()) - shape.half_extent.y());
  return x * x + y * y <= reach * reach;
}

}  // namespace

void ContactDetection::list_near(std::uint32_t body) {
  near_.clear();
  grid_.around(body, [&](std::uint32_t other) {
    if (other != body) near_.push_back(other);
  });
}

/// Before they are sorted and their contacts are found: most who are near are farther.
void ContactDetection::keep_within(std::uint32_t body, Real gap, Real time) {
  const RealVector here = position_at(body, time);
  std::erase_if(near_, [&](std::uint32_t other) {
    return !may_be_within(shape_of(bodies_, body, other), here - position_at(other, time), gap);
  });
}

std::optional<Contact> ContactDetection::contact_within(std::uint32_t body, Partner p, Real gap,
                                                        Real time) const {
  if (!is_body(p)) {
    const Contact c = contact(body, p, time);
    return c.gap.distance > gap ? std::nullopt : std::optional(c);
  }
  const RealVector offset = position_at(body, time) - position_at(p, time);
  const RoundedBox shape = shape_of(bodies_, body, p);
  if (!may_be_within(shape, offset, gap)) return std::nullopt;
  const Contact c{body, p, shape.gap(offset)};
  return c.gap.distance > gap ? std::nullopt : std::optional(c);
}

Real ContactDetection::restitution(std::uint32_t body, Partner p) const {
  return spec_.restitution(bodies_[body].material,
                           is_body(p) ? bodies_[p].material : spec_.field.wall);
}

bool ContactDetection::has_company(std::uint32_t body, Partner p, Real time) {
  candidates_.resize(grid_.collected_max());
#if defined(RINK_PAIRS_SCALARS)
  // Bats are on curves, always.
  if (has_fours && bodies_.curved_count() == 0 && puck_drag_ == 0.0 && !bodies_.is_fixed(p) &&
      is_alone(body, p, time) && is_alone(p, body, time))
    return false;
#endif
  return has_third(body, p, time) || (!bodies_.is_fixed(p) && has_third(p, body, time));
}

#if defined(RINK_PAIRS_SCALARS)
/// In a gas nobody touches one of the two, and to count who is near at all, posts among them, takes
/// a third of what it takes to ask who they are.
bool ContactDetection::is_alone(std::uint32_t one, std::uint32_t two, Real time) {
  const std::uint32_t count = grid_.collect(one, candidates_.data()), fillers = (0u - count) & 3u;
  const Body &a = bodies_[one], &b = bodies_[two];
  const double ahead_a = std::max(0.0, time - a.time), ahead_b = std::max(0.0, time - b.time),
               ax = a.x + a.vx * ahead_a, ay = a.y + a.vy * ahead_a;
  const double x = b.x + b.vx * ahead_b - ax, y = b.y + b.vy * ahead_b - ay,
               touching = a.radius + b.radius + 0.5 * clear_of_touching;
  return x * x + y * y <= touching * touching &&
         count_near_in_fours(
             bodies_.table().bodies.data(), candidates_.data(), count, one,
             {.x = ax, .y = ay, .time = time, .least = a.radius + clear_of_touching}) ==
             2 + fillers;
}
#endif

bool ContactDetection::has_third(std::uint32_t one, Partner two, Real time) {
  const std::uint32_t count = grid_.collect(one, candidates_.data());
  const Body& a = bodies_[one];
  const bool is_straight = !a.is(Body::curved) && a.kind == BodyKind::puck && puck_drag_ == 0.0;
  const Real ahead = std::max<Real>(0.0, time - a.time), ax = a.x + a.vx * ahead,
             ay = a.y + a.vy * ahead, least = a.radius + Real(clear_of_touching);
  for (const std::uint32_t *other = candidates_.data(), *end = other + count; other != end;
       ++other) {
    const Body& b = bodies_[*other];
    const bool is_pair_straight = is_straight && !b.is(Body::curved) && b.kind == BodyKind::puck;
    const Real elapsed = std::max<Real>(0.0, time - b.time), x = b.x + b.vx * elapsed - ax,
               y = b.y + b.vy * elapsed - ay, reach = b.radius + least;
    if ((is_pair_straight && x * x + y * y > reach * reach) || *other == one || *other == two ||
        bodies_.is_fixed(*other))
      continue;
    if (is_pair_straight || contact(one, *other, time).gap.distance <= Real(clear_of_touching))
      return true;
  }
  return false;
}

}  // namespace rink::physics::inline RINK_PRECISION
