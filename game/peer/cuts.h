// A field cut in two, and its parts again, down to one zone for each peer, so that small changes of
// the division are possible.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "game/peer/division.h"

namespace rink::peer {

/// A tree. The zone of a peer that leaves goes to those on the other side of its innermost cut.
class Cuts {
 public:
  /// Cuts across the longer side recursively, so that the peers of both parts get equally many of
  /// `places`; equal places give equal cuts.
  static Cuts by_count(const physics::Field& field, std::vector<Vector2> places,
                       PeerNumber peer_count);

  /// A field that is all of peer 0.
  static Cuts whole(const physics::Field& field) { return by_count(field, {}, 1); }

  /// The division for so many peers, some of which may have no zone.
  Division division(PeerNumber peer_count) const;
  bool has(PeerNumber peer) const;
  /// `peer` must have a zone, and not be the only one (both asserted).
  Cuts without(PeerNumber peer) const;
  /// The zone of `of` (which must have one, asserted) cut in two across its longer side, the upper
  /// part for `newcomer`, which must have none.
  Cuts with(PeerNumber newcomer, PeerNumber of) const;
  /// The peers with zones, sorted, and the areas of these [m^2].
  const std::vector<PeerNumber>& peers() const { return peers_; }
  double area_of(PeerNumber peer) const;
  /// Each cut moved half of the way to where its parts' loads per peer would be equal if each were
  /// spread evenly, provided that one of them is above `tolerance` times the mean; a part keeps a
  /// tenth of its fair share of the room. `loads`: of each peer, by number. Equal loads give equal
  /// cuts; nothing if no cut moves.
  std::optional<Cuts> balanced(std::span<const double> loads, double tolerance) const;

  /// Asserts that these are one tree: each part below one cut, which lies within what it cuts, and
  /// each peer with one zone.
  void check() const;

  /// Writes to a message and reads back, into cuts of the same field; false for invalid cuts, such
  /// as zones of no width.
  template <class Stream>
  bool exchange(Stream& stream) {
    std::vector<Node> nodes;
    const bool is_whole =
        exchange_part(stream, root_, {0.0, 0.0, field_.length, field_.width}, 0, nodes);
    if (is_whole) nodes_ = std::move(nodes), root_ = 0, list_peers();
    return is_whole;
  }

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
  std::size_t copied(std::size_t node, PeerNumber left_out, std::vector<Node>& nodes) const;
  const Node* find(std::size_t node, const Box& box, PeerNumber peer, Box& found) const;
  /// A cut precedes its parts. Cuts that are read nest at most `depth_max` deep and have at most
  /// `nodes_max` nodes.
  static constexpr int depth_max = 128;
  static constexpr std::size_t nodes_max = 1024;
  template <class Stream>
  bool exchange_part(Stream& stream, std::size_t from, const Box& box, int depth,
                     std::vector<Node>& nodes) {
    const std::size_t node = nodes.size();
    Node here = from < nodes_.size() ? nodes_[from] : Node{};
    bool is_cut = from < nodes_.size() && !is_leaf(from);
    const std::size_t low = is_cut ? here.low : nodes_.size(),
                      high = is_cut ? here.high : nodes_.size();
    if (node >= nodes_max || depth > depth_max || !stream.truth(is_cut)) return false;
    nodes.push_back(here);
    if (!is_cut) return nodes[node].low = node, stream.number(nodes[node].peer);
    if (!stream.truth(here.is_along_x) || !stream.number(here.side)) return false;
    if (!(here.side > (here.is_along_x ? box.low_x : box.low_y) &&
          here.side < (here.is_along_x ? box.high_x : box.high_y)))
      return false;
    const auto [below, above] = parts_of(box, here.is_along_x, here.side);
    here.low = nodes.size();
    if (!exchange_part(stream, low, below, depth + 1, nodes)) return false;
    here.high = nodes.size();
    if (!exchange_part(stream, high, above, depth + 1, nodes)) return false;
    nodes[node] = here;
    return true;
  }
  static std::pair<Box, Box> parts_of(const Box& box, bool is_along_x, double side);
  std::size_t cut(const Box& box, std::span<Vector2> places, PeerNumber first,
                  PeerNumber peer_count);
  void lay_out(std::size_t node, const Box& box, std::vector<Zone>& zones) const;
  std::vector<PeerNumber> peers_below(std::size_t node) const;
  void list_peers();
  std::size_t checked_count(std::size_t node, const Box& box) const;
  bool shift(std::size_t node, const Box& from, const Box& to, std::span<const double> loads,
             double tolerance);

  physics::Field field_;
  std::vector<Node> nodes_;
  std::size_t root_ = 0;
  std::vector<PeerNumber> peers_;  ///< sorted: asked for many times in every window
};

}  // namespace rink::peer
