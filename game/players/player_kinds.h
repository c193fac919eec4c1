// All kinds of players by their names.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "game/players/player.h"

namespace rink::game {

/// Every kind of player that decides: an experiment's or a command's `players` may name these and
/// "random", whose keys are drawn before the game (random_plan.h).
const std::vector<std::string>& player_kinds();

/// Whether `name` is one of these, or "random".
bool is_player_kind(std::string_view name);

/// The player of `kind`, which must be one of player_kinds(). Places that a population shares, such
/// as hot ones, depend on `seed` alone; all else on `seed` and the seat.
std::unique_ptr<Player> make_player(std::string_view kind, const PlayerRules& rules,
                                    const PlayerSeat& seat, std::uint64_t seed);

}  // namespace rink::game
