// The members of a session begin to play at one instant.
#pragma once

#include "game/net/peer/network/session_network.h"

namespace rink::game {

/// Agrees on the start: the first peer sends it when all are ready. Returns the instant [s of the
/// clock], one message late at the others. Throws SessionError.
double start_together(SessionNetwork& network, double (*now_s)());

}  // namespace rink::game
