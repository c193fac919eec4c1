// What a lost node had played last, as the node says that keeps a copy of its part.
#pragma once

#include "game/peer/division.h"
#include "game/peer/session/part_change.h"

namespace rink::game {

/// The lost node may have told some of it, or nobody.
struct StandIn {
  peer::PeerNumber node = 0;  ///< the lost one
  peer::PartChange change{};  ///< with all its bodies, of the stretch to whose end all go back
};

template <class Stream>
bool exchange(Stream& stream, StandIn& stand_in) {
  return stream.number(stand_in.node) && exchange(stream, stand_in.change);
}

}  // namespace rink::game
