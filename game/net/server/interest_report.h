// Makes the report of a server's filter decisions for a watcher.
#pragma once

#include "game/match/interest_seen.h"
#include "game/net/server/server.h"
#include "rti/federation_execution.h"

namespace rink::game {

/// The decisions of the last match of `execution`, to which `server` belongs. Things are named by
/// their objects' handles. Takes a pass over federates and one over the scope of the one that plays
/// `asked`.
InterestSeen interest_report(const Server& server, const rti::FederationExecution& execution,
                             rti::ObjectHandle asked);

}  // namespace rink::game
