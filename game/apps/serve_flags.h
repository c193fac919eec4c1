// The flags of rink serve.
#pragma once

#include "game/apps/flags.h"
#include "game/net/server/serve_options.h"

namespace rink::game {

void add_options(Flags& flags, ServeOptions& options);

/// What a host of matches does unless it is told otherwise.
void host_by_default(const Flags& flags, ServeOptions& options);

}  // namespace rink::game
