// What the game hands the RTI's filter beside regions.
#pragma once

#include "game/net/server/server.h"
#include "rti/federation_execution.h"

namespace rink::game {

/// To be called between the last `publish`, once the RTI has heard it, and the next match: says of
/// the objects and players which that made known of what team they are, whose they are, and what is
/// always relevant (docs/im.md, "Roles"); to filters that ask, where players look and how things
/// fly on. What was said before stays, so a tick in which nobody comes costs a filter of regions
/// nothing. For flights the server must `hand_in_flights`.
void push_filter_hints(const Server& server, rti::FederationExecution& federation);

}  // namespace rink::game
