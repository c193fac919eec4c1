// Copies what a scheme may ask for out of the scene.
#include "game/replication/filter_setup.h"

namespace rink::game {

im::FilterSettings filter_settings(const Scene& scene, double cell_size) {
  const physics::Field& field = scene.world.field;
  im::FilterSettings settings{.world = {0.0, 0.0, field.length, field.width},
                              .cell_size = cell_size,
                              .drag = scene.world.puck_drag};
  for (const Post& post : scene.bodies.posts)
    settings.posts.push_back({post.body.position.x(), post.body.position.y(), post.body.radius});
  return settings;
}

im::Role role_of(const Entity& entity, bool is_always_relevant) {
  const bool has_team = entity.team != Team::none;
  return {.team = has_team ? static_cast<std::uint32_t>(entity.team) : im::Role::none,
          .owner = entity.player.value_or(im::Role::none),
          .is_always_relevant = is_always_relevant};
}

}  // namespace rink::game
