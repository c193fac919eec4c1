// The division of the field into the zones of peers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "game/peer/box.h"
#include "game/physics/body.h"

namespace rink::peer {

using PeerNumber = std::uint32_t;

/// A rectangle of the field that `peer` owns, its low sides included, its high sides not. At the
/// rim of the field it extends without end, since pucks in a goal lie outside.
struct Zone {
  Box box{};
  PeerNumber peer = 0;
};

/// Zones that cover the field, each place once.
class Division {
 public:
  /// The reason, with a place, why the zones are no division of the field among `peer_count` peers;
  /// nothing if they are one.
  static std::optional<std::string> objection(const physics::Field& field,
                                              std::span<const Zone> zones, PeerNumber peer_count);
  /// There must be no objection (asserted).
  Division(const physics::Field& field, std::vector<Zone> zones, PeerNumber peer_count);
  /// Strips of equal width along the longer side, one for each peer.
  static Division into_strips(const physics::Field& field, PeerNumber peer_count);

  PeerNumber peer_count() const { return peer_count_; }
  PeerNumber owner_of(const Vector2& place) const;
  /// The zones of a peer, with open rims. Those of one peer are adjacent in the list.
  std::span<const Box> zones_of(PeerNumber peer) const;
  /// Whether `box` meets what lies within `halo` of the zones of `peer` along both axes; and
  /// whether it lies within it as a whole, by one of its zones.
  bool is_near(PeerNumber peer, const Box& box, double halo) const;
  bool is_within(PeerNumber peer, const Box& box, double halo) const;

  /// Asserts that each peer's zones are at its place in the list, and not empty.
  void check() const;

 private:
  PeerNumber peer_count_;
  std::vector<Box> zones_;           // in order of peers
  std::vector<std::size_t> begins_;  // of each peer's zones in these
};

}  // namespace rink::peer
