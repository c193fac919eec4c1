// What rink serve does otherwise as a rank of MPI: all ranks have the same command line.
#pragma once

#include "game/net/peer/ranks/rank_network.h"
#include "game/net/server/serve_options.h"

namespace rink::game {

/// Gives this rank a port and files of its own. Throws std::runtime_error if there is no such port.
void become_rank(ServeOptions& options, const rti::Ranks& ranks);

}  // namespace rink::game
