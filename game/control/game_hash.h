// What a game's hash is made of, for those who have the game in parts.
#pragma once

#include <span>

#include "game/control/game.h"
#include "game/model/state_hash.h"

namespace rink::game {

/// Of a world's hash, all that is in it, what the players hold, in order of player, and the score;
/// pending face-offs come after that.
inline StateHash begun_game_hash(std::uint64_t world, std::span<const Entity> entities,
                                 std::span<const BatController* const> players,
                                 const Score& score) {
  StateHash hash;
  hash.add(world);
  for (const Entity& entity : entities) hash.add(std::uint64_t{entity.id.index});
  for (const BatController* player : players)
    hash.add(std::uint64_t{player->keys().bits()} << 32 | player->input_count());
  hash.add(std::uint64_t{score.left} << 32 | score.right);
  return hash;
}

}  // namespace rink::game
