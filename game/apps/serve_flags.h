// The flags of rink serve.
#pragma once

#include "game/apps/flags.h"
#include "game/net/server/serve_options.h"

namespace rink::game {

void add_options(Flags& flags, ServeOptions& options);

/// Sets the defaults of a host of matches.
void host_by_default(const Flags& flags, ServeOptions& options);

}  // namespace rink::game
