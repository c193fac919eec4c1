// The zones of all peers, and how far beyond its own each of them looks: equal at all peers.
#pragma once

#include <cassert>
#include <vector>

#include "game/peer/division.h"

namespace rink::peer {

/// Also knows which peers play on, and which of them is the own one.
class Halos {
 public:
  /// `halo` [m] is the first width for all.
  Halos(const Division& division, PeerNumber number, double halo);

  PeerNumber number() const { return number_; }
  PeerNumber peer_count() const { return division_.peer_count(); }
  const Division& division() const { return division_; }
  PeerNumber owner_of(const Vector2& place) const { return division_.owner_of(place); }
  std::span<const Box> own_zones() const { return division_.zones_of(number_); }
  double of(PeerNumber peer) const {
    assert(peer < halos_.size());
    return halos_[peer];
  }
  double own() const { return halos_[number_]; }
  bool is_present(PeerNumber peer) const {
    assert(peer < is_present_.size());
    return is_present_[peer];
  }
  PeerNumber present_count() const;
  /// The widest of all others that are present [m].
  double widest_other() const;
  /// True if every present peer has the whole field. Peers may differ about absent ones.
  bool are_whole() const;
  bool is_near(PeerNumber peer, const Box& box) const {
    assert(peer < halos_.size());
    return division_.is_near(peer, box, halos_[peer]);
  }

  void set(PeerNumber peer, double halo) {
    assert(peer < halos_.size() && halo >= 0.0);
    halos_[peer] = halo;
  }
  void set_present(PeerNumber peer, bool is_present) {
    assert(peer < is_present_.size() && (is_present || peer != number_));
    is_present_[peer] = is_present;
  }
  /// Changes the zones, perhaps for more peers: these look `halo` [m] far, and are not present yet.
  void divide(const Division& division, double halo);

 private:
  Division division_;
  PeerNumber number_;
  std::vector<double> halos_;     ///< by peer [m]
  std::vector<bool> is_present_;  ///< by peer
};

}  // namespace rink::peer
