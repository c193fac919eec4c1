// The first message of another peer that cannot be true.
#pragma once

#include <cassert>
#include <string>

#include "game/peer/division.h"

namespace rink::peer {

class Accusation {
 public:
  /// `fault` continues "peer 3", as in "claims window 7 instead of 8". Only the first one counts.
  /// Always false, so that a check can end with it.
  bool report(PeerNumber peer, const std::string& fault) {
    assert(!fault.empty());
    if (fault_.empty()) fault_ = fault, peer_ = peer;
    return false;
  }
  bool is_made() const { return !fault_.empty(); }
  const std::string& fault() const { return fault_; }
  /// "peer 3" and its fault; empty if there is none.
  std::string text() const {
    return is_made() ? "peer " + std::to_string(peer_) + " " + fault_ : std::string();
  }
  PeerNumber peer() const {
    assert(is_made());
    return peer_;
  }

 private:
  std::string fault_;
  PeerNumber peer_ = 0;
};

}  // namespace rink::peer
