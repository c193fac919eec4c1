// Runs rink peer as a rank of MPI.
#pragma once

#include "game/apps/peer_flags.h"
#include "game/net/exit_status.h"

namespace rink::game {

/// Plays the part of one rank; a rank that must end early ends all.
ExitStatus share_among_ranks(PeerOptions options);

}  // namespace rink::game
