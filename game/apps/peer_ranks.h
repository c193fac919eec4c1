// Runs rink peer as a rank of MPI.
#pragma once

#include "game/apps/peer_flags.h"
#include "game/apps/rank_command.h"
#include "game/net/exit_status.h"

namespace rink::game {

/// Plays the part of one rank.
ExitStatus share_among_ranks(PeerOptions options, RankCommand& command);

}  // namespace rink::game
