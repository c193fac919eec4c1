// A field cut in two, and its parts again, down to one zone for each peer: a division that can change by little.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "game/peer/division.h"

namespace rink::peer {

/// A tree. A peer that goes leaves its zone to those on the other side of its innermost cut.
class Cuts {
 public:
  /// Across the longer side, again and again, each time so that the peers of both parts get equally many of `places`: the same for all who know these.
  static Cuts by_count(const physics::Field& field, std::vector<Vector2> places, PeerNumber peer_count);

  /// For so many peers, of whom some may have no zone.
  Division division(PeerNumber peer_count) const;
  bool has(PeerNumber peer) const;
  /// `peer` must have a zone, and not be the only one (both asserted).
  Cuts without(PeerNumber peer) const;
  /// Each cut moved half of the way to where its parts' loads per peer would be equal if each were spread evenly, provided that one of them is above `tolerance` times the mean; a
  /// part keeps a tenth of its fair share of the room. `loads`: of each peer, by number. The same for all who know these; nothing if no cut moves.
  std::optional<Cuts> balanced(std::span<const double> loads, double tolerance) const;

 private:
  /// A leaf's `low` is its own place in the list.
  struct Node {
    std::size_t low = 0, high = 0;  ///< the parts
    bool is_along_x = false;        ///< whether the parts differ in x
    double side = 0.0;              ///< where the cut is [m]
    PeerNumber peer = 0;            ///< of a leaf
  };
  explicit Cuts(const physics::Field& field) : field_(field) {}
  bool is_leaf(std::size_t node) const { return nodes_[node].low == node; }
  std::size_t cut(const Box& box, std::span<Vector2> places, PeerNumber first, PeerNumber peer_count);
  void lay_out(std::size_t node, const Box& box, std::vector<Zone>& zones) const;
  std::vector<PeerNumber> peers_below(std::size_t node) const;
  bool shift(std::size_t node, const Box& from, const Box& to, std::span<const double> loads, double tolerance);

  physics::Field field_;
  std::vector<Node> nodes_;
  std::size_t root_ = 0;
};

}  // namespace rink::peer
