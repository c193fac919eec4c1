// Answers for all peers at once.
#include "game/peer/window/halos.h"

#include <algorithm>

namespace rink::peer {

Halos::Halos(const Division& division, PeerNumber number, double halo)
    : division_(division),
      number_(number),
      halos_(division.peer_count(), halo),
      is_present_(division.peer_count(), true) {
  assert(number < division.peer_count() && halo > 0.0);
}

PeerNumber Halos::present_count() const {
  return static_cast<PeerNumber>(std::count(is_present_.begin(), is_present_.end(), true));
}

double Halos::widest_other() const {
  double widest = 0.0;
  for (PeerNumber peer = 0; peer < peer_count(); ++peer)
    if (peer != number_ && is_present_[peer]) widest = std::max(widest, halos_[peer]);
  return widest;
}

bool Halos::are_whole() const {
  for (PeerNumber peer = 0; peer < peer_count(); ++peer)
    if (is_present_[peer] && halos_[peer] != infinity) return false;
  return true;
}

void Halos::divide(const Division& division, double halo) {
  assert(division.peer_count() >= peer_count() && halo > 0.0);
  division_ = division;
  halos_.resize(peer_count(), halo), is_present_.resize(peer_count(), false);
}

}  // namespace rink::peer
