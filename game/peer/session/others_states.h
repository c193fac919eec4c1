// Holds what another peer says of bodies between two windows against those that are here, too.
#pragma once

#include <span>
#include <string>

#include "game/peer/division.h"
#include "game/peer/messages.h"
#include "game/peer/standby/part_record.h"
#include "game/peer/window/share.h"

namespace rink::peer {

/// Between windows a ghost is bit for bit its owner's body. The fault, as in "says that body 7 is
/// as it is not"; empty if all of these that are here are so.
std::string fault_of_known(const Share& share, std::span<const Handover::Body> bodies,
                           std::span<const FreeFlightState> free_flights);

/// As that, of what `from` has committed, whose states are `bodies`.
std::string fault_of_record(const Share& share, PeerNumber from, const PartRecord& record,
                            std::span<const Handover::Body> bodies);

/// As that, of all bodies of `from`, each once, in its zones by `division`.
std::string fault_of_part(const Share& share, const Division& division, PeerNumber from,
                          const Handover& part);

}  // namespace rink::peer
