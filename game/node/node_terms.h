// The terms on which nodes meet, by which those of clients and those of matches are told apart.
#pragma once

#include <cstdint>

#include "game/net/peer/network/greetings.h"
#include "game/net/peer/shared_game.h"

namespace rink::game {

/// In place of a scheme of peers, so that the two are not taken for each other.
inline constexpr const char *nodes_scheme = "nodes", *matches_scheme = "matches";

/// The terms of `node_count` nodes, with standby copies, that play `until` [s] in windows of a tick
/// each [s]; their zones may shift every `balance_windows`, or never if that is 0.
Terms terms_of_nodes(std::uint32_t node_count, double until, double tick_s,
                     std::uint32_t balance_windows = balance_windows_default);
/// Of nodes that host matches, which go on when one of them is lost. A window is the tick rounded
/// to the grid of matches, so that stamps are short.
Terms terms_of_matches(std::uint32_t node_count, double tick_s,
                       std::uint32_t balance_windows = balance_windows_default);

/// No match is so long [s], which is not too many windows of the shortest tick. Nodes whose terms
/// last so long play match after match; others end with the first, at the latest then.
inline constexpr double match_s_max = 9e5;
inline bool is_one_match(const Terms& terms) { return terms.until < match_s_max; }

/// Nodes and peers of one scene refuse each other: they do not speak of the same things.
Fingerprint fingerprint_of_nodes(const SharedGame& game);

}  // namespace rink::game
