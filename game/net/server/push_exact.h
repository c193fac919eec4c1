// Tells clients that compute what they cannot know.
#pragma once

#include "game/net/server/server.h"
#include "game/replication/exact/exact_feed.h"
#include "rti/federation_execution.h"

namespace rink::game {

/// After the server has published with `stamp` and the execution has matched that, before its
/// flush.
void push_exact(const Server& server, ExactFeed& feed, const rti::Stamp& stamp,
                rti::FederationExecution& execution);

}  // namespace rink::game
