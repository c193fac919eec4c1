// Static tests of all pairs that a grid finds near each other, in order of their numbers.
#include "game/physics/paper/naive_simulator.h"

#include <algorithm>
#include <cassert>

#include "game/physics/collision/static_tests.h"

namespace rink::physics::paper {

namespace {

using Plane = collision::Plane<double>;
using Disc = collision::Disc<double>;
using Box = collision::Box<double>;

/// The axis along which two boxes overlap least, seen from the second.
Vector2 least_axis(const Vector2& offset, const Vector2& reach) {
  const Vector2 outside = offset.cwiseAbs() - reach;
  return outside.x() > outside.y() ? Vector2(offset.x() < 0.0 ? -1.0 : 1.0, 0.0)
                                   : Vector2(0.0, offset.y() < 0.0 ? -1.0 : 1.0);
}

}  // namespace

std::optional<Goal> NaiveSimulator::play(double until) {
  if (until < steps_.frame_end()) return std::nullopt;
  now_ = until;
  if (!is_judged_) judge();
  if (goals_.empty()) return std::nullopt;
  const std::uint32_t puck = goals_.front();
  goals_.pop_front();
  return score(puck);
}

void NaiveSimulator::judge() {
  is_judged_ = true;
  grid_.clear(spec_.field, body_count());
  pairs_.clear();
  for (std::uint32_t index = 0; index < bodies_.size(); ++index) {
    Body& body = bodies_[index];
    if (!body.is_in_play) continue;
    rebase(body, now_);
    const Extent box{body.start.position - body.extent(), body.start.position + body.extent()};
    grid_.around(box, [&](std::uint32_t other) { pairs_.emplace_back(other, index); });
    grid_.insert(index, box);
  }
  std::sort(pairs_.begin(), pairs_.end());
  for (const auto& [low, high] : pairs_) judge_pair(low, high);
  for (std::uint32_t index = 0; index < bodies_.size(); ++index)
    if (bodies_[index].is_in_play && bodies_[index].kind != BodyKind::post) judge_field(index);
}

void NaiveSimulator::judge_pair(std::uint32_t low, std::uint32_t high) {
  assert(low < high);
  const Body &a = bodies_[low], &b = bodies_[high];
  if (a.inverse_mass + b.inverse_mass == 0.0) return;
  ++record_.counters().predictions;
  const Vector2 offset = a.start.position - b.start.position;
  const bool is_bat_a = a.kind == BodyKind::bat, is_bat_b = b.kind == BodyKind::bat;
  if (!is_bat_a && !is_bat_b) {
    if (collision::do_bounding_circles_overlap(Disc{a.start.position, a.radius},
                                               Disc{b.start.position, b.radius}))
      bounce(low, high, offset.normalized());
    return;
  }
  const Box box{is_bat_a ? a.start.position : b.start.position,
                is_bat_a ? a.half_extent : b.half_extent};
  const bool is_overlap =
      is_bat_a && is_bat_b
          ? collision::do_boxes_overlap(box, Box{b.start.position, b.half_extent})
          : collision::does_disc_overlap_box(
                is_bat_a ? Disc{b.start.position, b.radius} : Disc{a.start.position, a.radius},
                box);
  if (is_overlap) bounce(low, high, least_axis(offset, a.extent() + b.extent()));
}

bool NaiveSimulator::is_in_goal(const Body& body) const {
  const Vector2& place = body.start.position;
  return body.kind == BodyKind::puck && is_in_opening(place.y()) &&
         (place.x() <= 0.0 || place.x() >= spec_.field.length);
}

void NaiveSimulator::judge_field(std::uint32_t index) {
  const Body& body = bodies_[index];
  const Field& field = spec_.field;
  if (is_in_goal(body)) return goals_.push_back(index);
  const Vector2 extent = body.extent(), far = Vector2(field.length, field.width) - extent;
  judge_wall(index, extent, {0.0, 1.0});
  judge_wall(index, far, {0.0, -1.0});
  if (body.kind == BodyKind::puck && is_in_opening(body.start.position.y())) {
    for (const double x : {0.0, field.length})
      for (const double side : {-0.5, 0.5}) {
        const Vector2 edge(x, 0.5 * field.width + side * field.goal_width);
        if (collision::is_point_in_circle<double>(edge, Disc{body.start.position, body.radius}))
          bounce(index, goal_edge, (body.start.position - edge).normalized());
      }
    return;
  }
  judge_wall(index, extent, {1.0, 0.0});
  judge_wall(index, far, {-1.0, 0.0});
  if (body.kind != BodyKind::bat || !field.bats_keep_to_half || body.half == Half::both) return;
  const bool is_left = body.half == Half::left;
  judge_wall(index, Vector2(0.5 * field.length + (is_left ? -extent.x() : extent.x()), 0.0),
             {is_left ? -1.0 : 1.0, 0.0});
}

void NaiveSimulator::judge_wall(std::uint32_t index, const Vector2& point, const Vector2& normal) {
  if (collision::point_plane_distance<double>(bodies_[index].start.position,
                                              Plane{point, normal}) <= 0.0)
    bounce(index, wall, normal);
}

/// Only what closes: whatever overlaps and parts is left alone.
void NaiveSimulator::bounce(std::uint32_t index, Partner partner, const Vector2& normal) {
  const Vector2 other = is_body(partner) ? bodies_[partner].start.velocity : Vector2(0.0, 0.0);
  if (normal.dot(other - bodies_[index].start.velocity) > 0.0)
    respond(index, partner, normal, now_);
}

}  // namespace rink::physics::paper
