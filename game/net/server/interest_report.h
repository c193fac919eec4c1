// What a server reports of its filter's decisions to a watcher.
#pragma once

#include "game/match/interest_seen.h"
#include "game/net/server/server.h"
#include "rti/federation_execution.h"

namespace rink::game {

/// As of the last match of `execution`, which `server` is part of. Things are called by their
/// objects' handles. Takes a pass over federates and one over the scope of the one that plays
/// `asked`.
InterestSeen interest_report(const Server& server, const rti::FederationExecution& execution,
                             rti::ObjectHandle asked);

}  // namespace rink::game
