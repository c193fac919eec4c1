// The zones of all peers, and how far beyond its own each of them looks: equal at all peers.
#pragma once

#include <algorithm>
#include <cassert>
#include <span>
#include <vector>

#include "game/peer/division.h"

namespace rink::peer {

/// Also knows which peers play on, which of them is the own one, and which are its neighbours:
/// those with whom it exchanges claims and handovers, because what either of them has may reach the
/// other in this window (docs/peer-to-peer.md, "Neighbours"). At first these are all others.
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
  /// Whether the box meets the peer's halo, or an annex.
  bool is_near(PeerNumber peer, const Box& box) const {
    assert(peer < halos_.size());
    return division_.is_near(peer, box, halos_[peer]) ||
           std::ranges::any_of(annexes_[peer], [&](const Box& annex) { return annex.meets(box); });
  }
  /// Boxes beyond its halo at which the peer looks, too.
  const std::vector<Box>& annexes(PeerNumber peer) const {
    assert(peer < annexes_.size());
    return annexes_[peer];
  }
  /// How far into own zones annexes of others reach, from the nearest side [m].
  double deepest_annex() const;

  void set(PeerNumber peer, double halo) {
    assert(peer < halos_.size() && halo >= 0.0);
    halos_[peer] = halo;
  }
  void set_annexes(PeerNumber peer, std::vector<Box> annexes);
  void set_present(PeerNumber peer, bool is_present) {
    assert(peer < is_present_.size() && (is_present || peer != number_));
    is_present_[peer] = is_present;
    find_neighbours();
  }
  /// Changes the zones, perhaps for more peers: these look `halo` [m] far, and are not present yet.
  void divide(const Division& division, double halo);

  /// Sorted; the relation is mutual, and equal at all peers.
  const std::vector<PeerNumber>& neighbours() const { return neighbours_; }
  bool has_neighbour(PeerNumber peer) const {
    return std::binary_search(neighbours_.begin(), neighbours_.end(), peer);
  }
  /// Otherwise all others stay neighbours. Before the first window, and equal at all peers.
  /// `is_late`: for a peer without zones that comes when others know their neighbours already.
  void keep_to_neighbours(bool is_late);
  bool are_kept_to_neighbours() const { return keeps_to_neighbours_; }
  /// Verdicts do not announce bodies that reach no farther than this from their places [m]: half of
  /// the first halo.
  double usual_reach() const { return usual_reach_; }
  /// After verdicts have set halos, and before handovers: the widest `reach` [m] that a verdict
  /// announced, or 0. Neighbours are then at least those of this window, and may be more.
  void end_run(double reach);
  /// At a commit: neighbours of the next window, in which groups are as the last verdicts said.
  void begin_window();
  /// A body of this `reach` [m] comes where it was not, as all peers know.
  void make_way(double reach);

 private:
  void find_neighbours();
  bool may_reach(PeerNumber peer) const;
  bool looks_at(PeerNumber viewer, PeerNumber owner) const;

  Division division_;
  PeerNumber number_;
  std::vector<double> halos_;  ///< by peer [m]
  std::vector<std::vector<Box>> annexes_,
      former_annexes_;            ///< by peer: of now, and those since the window began
  std::vector<bool> is_present_;  ///< by peer
  bool keeps_to_neighbours_ = false;
  double usual_reach_;          ///< m
  std::vector<double> widths_;  ///< by peer: the widest halo since the window began [m]
  double reach_ = infinity,     ///< how far from their places bodies reach with those that
                                ///< touch them [m]; infinite where nobody has said it yet
      next_reach_ = infinity;   ///< from the next window on
  std::vector<PeerNumber> neighbours_;
};

}  // namespace rink::peer
