// Builds a world from a rounded update.
#include "game/match/predicted_world.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "game/control/bat_controller.h"

namespace rink::game {

PredictedWorld::PredictedWorld(const Scene& scene)
    : scene_(scene),
      ids_(scene.bodies.bats.size() + scene.bodies.pucks.size()),
      held_(scene.bodies.bats.size()),
      pushes_(held_.size()),
      left_at_(ids_.size(), Vector2(0.0, 0.0)) {
  scene_.world.allow_overlap = true;  // received positions are rounded
}

void PredictedWorld::set_up(const ReceivedRink& received) {
  assert(received.bats.size() == bat_count() && received.pucks.size() == puck_count());
  received_ = received;
  world_.emplace(scene_.world);
  for (const Post& post : scene_.bodies.posts) world_->add(post.body);
  for (std::uint32_t bat = 0; bat < bat_count(); ++bat) add_bat(bat);
  for (std::size_t puck = 0; puck < puck_count(); ++puck) add_puck(puck);
}

void PredictedWorld::rewind() {
  assert(is_set_up());
  set_up(ReceivedRink(received_));
}

void PredictedWorld::press(std::uint32_t bat, Key key, bool is_down) {
  assert(is_set_up() && bat < bat_count());
  held_[bat].set(key, is_down);
  set_thrust(bat);
}

void PredictedWorld::push(std::uint32_t bat, const Push& push) {
  assert(is_set_up() && bat < bat_count());
  pushes_[bat] = push;
  set_thrust(bat);
}

void PredictedWorld::advance(double until) {
  assert(is_set_up());
  while (world_->advance(until - received_.time)) {
  }  // pucks may score; the score is the server's
}

bool PredictedWorld::is_known(std::size_t body) const {
  assert(is_set_up() && body < body_count());
  return (body < bat_count() ? received_.bats[body] : received_.pucks[body - bat_count()]).is_known;
}

RinkSample PredictedWorld::sample(double time) const {
  assert(is_set_up());
  RinkSample sample{.time = time, .positions = {}, .velocities = {}};
  for (std::size_t body = 0; body < body_count(); ++body) {
    const auto& id = ids_[body];
    const bool is_in_play = id && world_->is_in_play(*id);
    sample.positions.push_back(id ? world_->position(*id) : left_at_[body]);
    sample.velocities.push_back(is_in_play ? world_->velocity(*id) : Vector2(0.0, 0.0));
  }
  return sample;
}

const Vector2& PredictedWorld::half_extent(std::uint32_t bat) const {
  assert(bat < bat_count());
  return scene_.bodies.bats[bat].body.half_extent;
}

double PredictedWorld::thrust(std::uint32_t bat) const {
  assert(bat < bat_count());
  return scene_.bodies.bats[bat].thrust;
}

void PredictedWorld::add_bat(std::uint32_t bat) {
  const ReceivedBody& received = received_.bats[bat];
  ids_[bat].reset();
  left_at_[bat] = received.position;
  held_[bat] = received.held;
  pushes_[bat] = received.push;
  if (!received.is_known) return;
  physics::BatSpec body = scene_.bodies.bats[bat].body;
  body.position = inside(received.position, body);
  body.velocity = received.velocity;
  ids_[bat] = world_->add(body);
  set_thrust(bat);
}

void PredictedWorld::add_puck(std::size_t puck) {
  const ReceivedBody& received = received_.pucks[puck];
  std::optional<physics::BodyId>& id = ids_[held_.size() + puck];
  id.reset();
  left_at_[held_.size() + puck] = received.position;
  if (!received.is_in_play || !received.is_known) return;
  physics::PuckSpec body = scene_.bodies.pucks[puck].body;
  body.position = inside(received.position, body.radius);
  body.velocity = received.velocity;
  id = world_->add(body);
}

/// Rounding may have put a bat a little into a wall or over the halfway line.
Vector2 PredictedWorld::inside(const Vector2& position, const physics::BatSpec& bat) const {
  const physics::Field& field = scene_.world.field;
  Vector2 low = bat.half_extent, high = Vector2(field.length, field.width) - bat.half_extent;
  if (field.bats_keep_to_half && bat.half == physics::Half::left)
    high.x() = field.length / 2 - bat.half_extent.x();
  if (field.bats_keep_to_half && bat.half == physics::Half::right)
    low.x() = field.length / 2 + bat.half_extent.x();
  return position.cwiseMax(low).cwiseMin(high);
}

/// Rounding may have put a puck a little into a wall. At a goal it may be beyond the end line.
Vector2 PredictedWorld::inside(const Vector2& position, double radius) const {
  const physics::Field& field = scene_.world.field;
  const bool is_at_goal = std::abs(position.y() - field.width / 2) < field.goal_width / 2;
  const double margin = is_at_goal ? 0.0 : radius;
  return {std::clamp(position.x(), margin, field.length - margin),
          std::clamp(position.y(), radius, field.width - radius)};
}

void PredictedWorld::set_thrust(std::uint32_t bat) {
  if (ids_[bat])
    world_->set_thrust(*ids_[bat],
                       BatController(thrust(bat), held_[bat], 0, pushes_[bat]).thrust());
}

}  // namespace rink::game
