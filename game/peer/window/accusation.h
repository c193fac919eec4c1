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
    if (text_.empty()) text_ = "peer " + std::to_string(peer) + " " + fault, peer_ = peer;
    return false;
  }
  bool is_made() const { return !text_.empty(); }
  const std::string& text() const { return text_; }
  PeerNumber peer() const {
    assert(is_made());
    return peer_;
  }

 private:
  std::string text_;
  PeerNumber peer_ = 0;
};

}  // namespace rink::peer
