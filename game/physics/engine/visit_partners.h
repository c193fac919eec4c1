// Whom a body may touch where it is; for the engine's own sources only.
#pragma once

#include <algorithm>
#include <cstdint>

#include "game/physics/engine/engine.h"

namespace rink::physics::inline RINK_PRECISION {

/// Everybody that `body` may touch, in an order that depends on ids alone: bodies near it, walls,
/// and whatever else of the field concerns it.
template <class Visit>
void Engine::visit_partners(std::uint32_t body, Visit&& visit) {
  near_.clear();
  grid_.around(grid_.column_of(body), grid_.row_of(body), -1, 1, -1, 1, [&](std::uint32_t other) {
    if (other != body) near_.push_back(other);
  });
  std::sort(near_.begin(), near_.end());
  for (const std::uint32_t other : near_) visit(other);
  const bool is_in_mouth = bodies_[body].mouth != Body::no_mouth;
  for (Partner wall = partner::wall_left; wall <= partner::wall_top; ++wall)
    if (!(is_in_mouth && wall <= partner::wall_right)) visit(wall);
  if (spec_.field.bats_keep_to_half && bodies_[body].kind == BodyKind::bat &&
      bodies_.build(body).half != Half::both)
    visit(partner::halfway);
  if (spec_.field.goal_width > 0.0 && bodies_[body].kind == BodyKind::puck)
    for (Partner edge = partner::edge_left_low; edge <= partner::edge_right_high; ++edge)
      visit(edge);
}

}  // namespace rink::physics::inline RINK_PRECISION
