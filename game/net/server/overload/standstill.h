// The ticks that a host of matches missed because it stood still.
#pragma once

#include <cmath>
#include <cstdint>

#include "game/net/server/hosted_match.h"
#include "game/net/server/serve_options.h"

namespace rink::game {

/// How many ticks from the one that was due at `due_s` [s] on are left out at `now_s`: players did
/// not see that time pass. Nodes wait for each other, so they leave out none.
inline std::uint64_t ticks_stood_still(const ServeOptions& options, double due_s, double now_s) {
  if (options.hosted.empty() || is_node(options) || now_s <= due_s + HostedMatch::stood_still_s)
    return 0;
  return static_cast<std::uint64_t>(std::floor((now_s - due_s) * options.rate_hz));
}

}  // namespace rink::game
