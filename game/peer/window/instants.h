// Instants at which a run may depend on events anywhere in the field: docs/peer-to-peer.md, "Counts
// of one instant".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/peer/messages.h"
#include "game/peer/window/share.h"

namespace rink::peer {

/// A short time about which all peers report, because events in it may be too many together.
struct AskedInstant {
  double low, high;  ///< s
  bool is_unsolved;  ///< some peer could not solve a joint impact in it
};

/// What a run has at single instants, as far as own bodies are concerned.
struct RunInstants {
  std::uint64_t at_once_max = 0;  ///< no fewer own events than any world counts at one instant
  std::vector<CriticalInstant> critical{};  ///< by time
};

/// Events within this of each other may be of one instant, whoever else is in the world [s].
double instant_margin(double time);
/// Own events are those with an own body. Instants with more of them than `usual` are critical.
RunInstants instants_of(const Share& share, std::uint64_t usual);
/// One for each, which come by time and do not overlap.
std::vector<InstantReport> reports_on(const Share& share, std::span<const AskedInstant> asked);

}  // namespace rink::peer
