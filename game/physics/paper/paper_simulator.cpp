// Two tiers of tests on the straight paths of a frame, and the order in which their contacts are
// played.
#include "game/physics/paper/paper_simulator.h"

#include <algorithm>
#include <cassert>
#include <tuple>

#include "game/physics/collision/static_tests.h"

namespace rink::physics::paper {

namespace {

using Plane = collision::Plane<double>;
using Disc = collision::Disc<double>;
using Box = collision::Box<double>;

}  // namespace

/// A heap's order: the event that comes first is the greatest.
bool PaperSimulator::is_later(const PredictedImpact& a, const PredictedImpact& b) {
  return std::tie(a.time, a.body, a.partner) > std::tie(b.time, b.body, b.partner);
}

Extent PaperSimulator::swept_box(const Body& body) const {
  const Vector2 extent = body.extent();
  return {body.start.position.cwiseMin(body.end.position) - extent,
          body.start.position.cwiseMax(body.end.position) + extent};
}

/// Holds the body's bounding circle wherever it is on its path.
Disc PaperSimulator::swept_circle(const Body& body) const {
  const double reach = body.radius + body.half_extent.norm();
  return {0.5 * (body.start.position + body.end.position),
          0.5 * (body.end.position - body.start.position).norm() + reach};
}

void PaperSimulator::begin() {
  grid_.clear(spec_.field, body_count());
  impacts_.clear();
  for (std::uint32_t index = 0; index < bodies_.size(); ++index)
    if (bodies_[index].is_in_play && !bodies_[index].can_move())
      grid_.insert(index, swept_box(bodies_[index]));
  for (std::uint32_t index = 0; index < bodies_.size(); ++index)
    if (bodies_[index].is_in_play && bodies_[index].can_move())
      turned(index);  // each meets those before it
}

void PaperSimulator::turned(std::uint32_t index) {
  const Extent box = swept_box(bodies_[index]);
  test_field(index);
  grid_.around(box, [&](std::uint32_t other) {
    if (other != index && bodies_[other].is_in_play)
      test_pair(std::min(index, other), std::max(index, other));
  });
  grid_.insert(index, box);
}

/// The first tier: by the circles that bound the paths. A sharp corner juts out of the true one by
/// up to (sqrt(2) - 1) radii of the disc.
bool PaperSimulator::may_meet(const Body& a, const Body& b) const {
  constexpr double jut = 0.4142135623730951;
  Disc path = swept_circle(a);
  if (corners_ == Corners::sharp && (a.kind == BodyKind::bat) != (b.kind == BodyKind::bat))
    path.radius += jut * std::max(a.radius, b.radius);
  return collision::do_bounding_circles_overlap(path, swept_circle(b));
}

void PaperSimulator::test_pair(std::uint32_t low, std::uint32_t high) {
  assert(low < high);
  const Body &a = bodies_[low], &b = bodies_[high];
  if (a.inverse_mass + b.inverse_mass == 0.0 || !may_meet(a, b)) return;
  ++record_.counters().predictions;
  const double start = std::max(a.start_time, b.start_time);
  if (const auto contact = first_touch(a, b, start)) expect(low, high, start, *contact);
}

/// From `start` on, along the straight paths, and no later than the end of the frame; the normal
/// points from `b` to `a`.
collision::MaybeContact<double> PaperSimulator::first_touch(const Body& a, const Body& b,
                                                            double start) const {
  const double limit = steps_.frame_end() - start;
  const Vector2 place_a = a.start.position + a.chord * (start - a.start_time),
                place_b = b.start.position + b.chord * (start - b.start_time);
  const bool is_bat_a = a.kind == BodyKind::bat, is_bat_b = b.kind == BodyKind::bat;
  if (!is_bat_a && !is_bat_b)
    return collision::time_disc_meets_disc<double>(Disc{place_a, a.radius}, a.chord,
                                                   Disc{place_b, b.radius}, b.chord, limit);
  if (is_bat_a && is_bat_b)
    return collision::time_box_meets_box<double>(Box{place_a, a.half_extent}, a.chord,
                                                 Box{place_b, b.half_extent}, b.chord, limit);
  const Disc disc = is_bat_a ? Disc{place_b, b.radius} : Disc{place_a, a.radius};
  const Box box = is_bat_a ? Box{place_a, a.half_extent} : Box{place_b, b.half_extent};
  const Vector2 &disc_path = is_bat_a ? b.chord : a.chord, &box_path = is_bat_a ? a.chord : b.chord;
  const bool is_rounded = corners_ == Corners::rounded && disc.radius > 0.0;
  auto contact =
      is_rounded
          ? collision::time_disc_meets_rounded_box<double>(disc, disc_path, box, box_path, limit)
          : collision::time_disc_meets_sharp_box<double>(disc, disc_path, box, box_path, limit);
  if (contact && is_bat_a) contact->normal = -contact->normal;
  return contact;
}

void PaperSimulator::test_field(std::uint32_t index) {
  const Body& body = bodies_[index];
  if (body.kind == BodyKind::post) return;
  const Field& field = spec_.field;
  const Vector2 extent = body.extent(), far = Vector2(field.length, field.width) - extent;
  test_plane(index, {extent, {0.0, 1.0}});
  test_plane(index, {far, {0.0, -1.0}});
  test_end(index, {extent, {1.0, 0.0}}, 0.0);
  test_end(index, {far, {-1.0, 0.0}}, field.length);
  if (body.kind == BodyKind::puck && field.goal_width > 0.0) test_goal_edges(index);
  if (body.kind != BodyKind::bat || !field.bats_keep_to_half || body.half == Half::both) return;
  const bool is_left = body.half == Half::left;
  test_plane(index, {Vector2(0.5 * field.length + (is_left ? -extent.x() : extent.x()), 0.0),
                     {is_left ? -1.0 : 1.0, 0.0}});
}

/// A puck that comes within the opening goes on to the goal line, unless it meets an edge before.
void PaperSimulator::test_end(std::uint32_t index, const Plane& wall, double goal_line_x) {
  const Body& body = bodies_[index];
  if (body.kind != BodyKind::puck || spec_.field.goal_width == 0.0) return test_plane(index, wall);
  if (collision::point_plane_distance<double>(body.end.position, wall) > 0.0) return;
  const double limit = steps_.frame_end() - body.start_time;
  const auto crossing =
      collision::time_point_meets_plane<double>(body.start.position, body.chord, wall, limit);
  if (!crossing) return;
  if (!is_in_opening(body.start.position.y() + body.chord.y() * crossing->time))
    return expect(index, FrameSimulator::wall, body.start_time, *crossing);
  const auto goal = collision::time_point_meets_plane<double>(
      body.start.position, body.chord, Plane{{goal_line_x, 0.0}, wall.normal}, limit);
  if (goal) expect(index, goal_line, body.start_time, *goal);
}

/// The static test is exact here: a straight path reaches the plane if and only if its end does.
void PaperSimulator::test_plane(std::uint32_t index, const Plane& plane) {
  const Body& body = bodies_[index];
  if (collision::point_plane_distance<double>(body.end.position, plane) > 0.0) return;
  const auto contact = collision::time_point_meets_plane<double>(
      body.start.position, body.chord, plane, steps_.frame_end() - body.start_time);
  if (contact) expect(index, wall, body.start_time, *contact);
}

void PaperSimulator::test_goal_edges(std::uint32_t index) {
  const Body& body = bodies_[index];
  const Field& field = spec_.field;
  const Disc path = swept_circle(body);
  for (const double x : {0.0, field.length})
    for (const double side : {-0.5, 0.5}) {
      const Disc edge{{x, 0.5 * field.width + side * field.goal_width}, 0.0};
      if (!collision::do_bounding_circles_overlap(path, edge)) continue;
      const auto contact = collision::time_disc_meets_disc<double>(
          Disc{body.start.position, body.radius}, body.chord, edge,
          steps_.frame_end() - body.start_time);
      if (contact) expect(index, goal_edge, body.start_time, *contact);
    }
}

void PaperSimulator::expect(std::uint32_t body, Partner partner, double start,
                            const collision::Contact<double>& contact) {
  assert(!(contact.time < 0.0));
  const double time = std::min(start + contact.time, steps_.frame_end());
  impacts_.push_back({time, body, partner, bodies_[body].version,
                      is_body(partner) ? bodies_[partner].version : 0, contact.normal});
  std::push_heap(impacts_.begin(), impacts_.end(), is_later);
}

bool PaperSimulator::is_stale(const PredictedImpact& impact) const {
  return bodies_[impact.body].version != impact.body_version ||
         (is_body(impact.partner) && bodies_[impact.partner].version != impact.partner_version);
}

std::optional<Goal> PaperSimulator::play(double until) {
  while (!impacts_.empty() && impacts_.front().time <= until) {
    const PredictedImpact impact = impacts_.front();
    std::pop_heap(impacts_.begin(), impacts_.end(), is_later);
    impacts_.pop_back();
    if (is_stale(impact)) {
      ++record_.counters().stale_events;
      continue;
    }
    now_ = std::max(now_, impact.time);
    if (impact.partner != goal_line) {
      meet(impact);
      continue;
    }
    rebase(bodies_[impact.body], impact.time);
    return score(impact.body);
  }
  return std::nullopt;
}

/// Rolls those who meet back from the frame's end to the time of impact, responds, and spends the
/// remainder.
void PaperSimulator::meet(const PredictedImpact& impact) {
  Body& body = bodies_[impact.body];
  Body* const other = is_body(impact.partner) && bodies_[impact.partner].inverse_mass > 0.0
                          ? &bodies_[impact.partner]
                          : nullptr;
  rebase(body, impact.time);
  if (other != nullptr) rebase(*other, impact.time);
  bool is_stop = body.is_stopped || ++body.impacts > impact_max;
  if (other != nullptr) is_stop = other->is_stopped || ++other->impacts > impact_max || is_stop;
  if (is_stop) {
    body.is_stopped = true;
    if (other != nullptr) other->is_stopped = true;
  } else {
    respond(impact.body, impact.partner, impact.normal, impact.time);
  }
  plan(body);
  if (other != nullptr) plan(*other);
  turned(impact.body);
  if (other != nullptr) turned(impact.partner);
}

}  // namespace rink::physics::paper
