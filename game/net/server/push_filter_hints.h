// Passes facts beside regions from the game to the RTI's filter.
#pragma once

#include "game/net/server/server.h"
#include "game/replication/game_facts.h"
#include "rti/federation_execution.h"

namespace rink::game {

/// Call it after the last `publish` has reached the RTI and before the next match: sets teams,
/// owners and what is always relevant for new objects and players (docs/im.md, "Roles"); for
/// filters that use them, also headings, motions and facts, which `facts` remembers from call to
/// call. Earlier facts stay, so a tick without
/// newcomers costs a filter of regions nothing. For flights the server must `hand_in_flights`.
void push_filter_hints(const Server& server, rti::FederationExecution& federation,
                       GameFacts& facts);

}  // namespace rink::game
