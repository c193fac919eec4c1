// What a filter of the RTI is told of a scene and its entities beside places: the same wherever one
// decides, at a server, a node, a peer, or in an evaluation.
#pragma once

#include "game/control/game.h"
#include "game/model/scene.h"
#include "im/filter.h"

namespace rink::game {

/// The scene's field, its posts, which block views, and its pucks' drag. `cell_size` [m] is for
/// schemes with cells, 0 leaves it to them.
im::FilterSettings filter_settings(const Scene& scene, double cell_size);

/// The role of an entity, or of the player who moves it: teams are the sides of the table, owners
/// the players by number (docs/im.md, "Roles").
im::Role role_of(const Entity& entity, bool is_always_relevant);

}  // namespace rink::game
