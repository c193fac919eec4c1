// The loss of a peer that has said that it was interrupted.
#pragma once

#include <string>

#include "game/peer/protocol.h"

namespace rink::game {

/// It goes on nowhere else, but has not finished what it played.
class PeerInterrupted : public peer::PeerGone {
 public:
  PeerInterrupted(peer::PeerNumber peer, const std::string& what) : PeerGone(peer, false, what) {}
};

}  // namespace rink::game
