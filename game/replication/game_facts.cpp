// Compares versions of motions with those of the last look.
#include "game/replication/game_facts.h"

#include <utility>

namespace rink::game {
namespace {

im::EntityKind kind_of(physics::BodyKind kind) {
  switch (kind) {
    case physics::BodyKind::puck:
      return im::EntityKind::puck;
    case physics::BodyKind::bat:
      return im::EntityKind::bat;
    case physics::BodyKind::post:
      return im::EntityKind::post;
  }
  return im::EntityKind::unknown;
}

}  // namespace

im::Facts GameFacts::of(const Game& game, const Entity& entity, double now) {
  if (game.now() < std::exchange(played_to_, game.now())) seen_.clear();
  if (entity.id.index >= seen_.size()) seen_.resize(entity.id.index + std::size_t{1});
  Seen& seen = seen_[entity.id.index];
  const physics::World* const exact = game.simulator().exact_world();
  const std::uint32_t version = exact ? exact->motion_version(entity.id) : 0;
  if (seen.is_known && version != seen.version) seen.facts.changed_at = now;
  seen.is_known = true, seen.version = version;
  const Vector2 velocity = game.velocity(entity.id);
  seen.facts.velocity_x = velocity.x(), seen.facts.velocity_y = velocity.y();
  seen.facts.kind = kind_of(entity.kind);
  return seen.facts;
}

}  // namespace rink::game
