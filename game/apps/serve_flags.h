// The flags of rink serve.
#pragma once

#include "game/apps/flags.h"
#include "game/net/server/serve_options.h"

namespace rink::game {

void add_options(Flags& flags, ServeOptions& options);

/// Sets the defaults of a host of matches.
void host_by_default(const Flags& flags, ServeOptions& options);

/// What --transport mpi stands for: a rank, whose clients come by TCP or UDP. Throws
/// std::invalid_argument for flags that say what the launcher says.
void serve_among_ranks(const Flags& flags, ServeOptions& options);

/// Throws std::runtime_error for a flag that nodes don't heed.
void require_heeded(const Flags& flags, const ServeOptions& options);

}  // namespace rink::game
