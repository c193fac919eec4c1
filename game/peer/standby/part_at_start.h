// The part of a peer at the start, which all know.
#pragma once

#include "game/peer/division.h"
#include "game/peer/standby/part_record.h"
#include "game/peer/start.h"
#include "game/peer/validation.h"

namespace rink::peer {

/// What `peer` has of the whole if it looks `halo` [m] far: as Peer::consider and Peer::begin
/// decide.
PartSnapshot part_at_start(const Start& start, const Division& division, PeerNumber peer,
                           double halo, const Validator& scene);

}  // namespace rink::peer
