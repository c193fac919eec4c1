// Which peer owns which part of the field.
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

/// A rectangle of the field that `peer` owns, its low sides included, its high sides not. Where it
/// ends at the rim of the field it goes on without end, as pucks in a goal do.
struct Zone {
  Box box{};
  PeerNumber peer = 0;
};

/// Zones that cover the field, each place once.
class Division {
 public:
  /// Why these are no division of the field among `peer_count` peers, naming the place; nothing if
  /// they are one.
  static std::optional<std::string> objection(const physics::Field& field,
                                              std::span<const Zone> zones, PeerNumber peer_count);
  /// There must be no objection (asserted).
  Division(const physics::Field& field, std::vector<Zone> zones, PeerNumber peer_count);
  /// Strips of equal width along the longer side, one for each peer.
  static Division into_strips(const physics::Field& field, PeerNumber peer_count);

  PeerNumber peer_count() const { return peer_count_; }
  PeerNumber owner_of(const Vector2& place) const;
  /// With their rims open. Those of one peer stand side by side.
  std::span<const Box> zones_of(PeerNumber peer) const;
  /// Whether `box` meets what lies within `halo` of the zones of `peer` along both axes; and
  /// whether it lies within it as a whole, by one of its zones.
  bool is_near(PeerNumber peer, const Box& box, double halo) const;
  bool is_within(PeerNumber peer, const Box& box, double halo) const;

  /// Asserts that each peer's zones are where its beginning says, with room in them.
  void check() const;

 private:
  PeerNumber peer_count_;
  std::vector<Box> zones_;           // in order of peers
  std::vector<std::size_t> begins_;  // of each peer's zones in these
};

}  // namespace rink::peer
