// Answers for all peers at once.
#include "game/peer/window/halos.h"

#include <algorithm>

namespace rink::peer {

Halos::Halos(const Division& division, PeerNumber number, double halo)
    : division_(division),
      number_(number),
      halos_(division.peer_count(), halo),
      annexes_(division.peer_count()),
      former_annexes_(division.peer_count()),
      is_present_(division.peer_count(), true),
      usual_reach_(0.5 * halo),
      widths_(halos_) {
  assert(number < division.peer_count() && halo > 0.0);
  find_neighbours();
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

double Halos::deepest_annex() const {
  double deepest = 0.0;
  for (PeerNumber peer = 0; peer < peer_count(); ++peer)
    for (const Box& annex : annexes_[peer])
      for (const Box& zone : own_zones())
        if (peer != number_ && is_present_[peer] && annex.meets(zone))
          deepest =
              std::max(deepest, std::min({annex.high_x - zone.low_x, annex.high_y - zone.low_y,
                                          zone.high_x - annex.low_x, zone.high_y - annex.low_y}));
  return deepest;
}

void Halos::set_annexes(PeerNumber peer, std::vector<Box> annexes) {
  assert(peer < annexes_.size());
  former_annexes_[peer].insert(former_annexes_[peer].end(), annexes_[peer].begin(),
                               annexes_[peer].end());
  annexes_[peer] = std::move(annexes);
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
  widths_.resize(peer_count(), halo);
  annexes_.resize(peer_count()), former_annexes_.resize(peer_count());
  reach_ = infinity;  // what anybody has may be in anybody's zone now
  find_neighbours();
}

void Halos::keep_to_neighbours(bool is_late) {
  assert(!is_late || own_zones().empty());
  keeps_to_neighbours_ = true;
  if (is_late) reach_ = usual_reach_;
  find_neighbours();
}

void Halos::end_run(double reach) {
  assert(reach >= 0.0);
  next_reach_ = std::max(reach, usual_reach_);
  reach_ = std::max(reach_, next_reach_);
  for (PeerNumber peer = 0; peer < peer_count(); ++peer)
    widths_[peer] = std::max(widths_[peer], halos_[peer]);
  find_neighbours();
}

void Halos::begin_window() {
  reach_ = next_reach_;
  widths_ = halos_;
  for (std::vector<Box>& former : former_annexes_) former.clear();
  find_neighbours();
}

void Halos::make_way(double reach) {
  if (reach <= reach_) return;
  reach_ = reach;
  find_neighbours();
}

/// Each may have bodies as far beyond its zones as its halo is wide, and bodies in its zones reach
/// as far beyond them as `reach_`.
bool Halos::may_reach(PeerNumber peer) const {
  const double width = std::max(widths_[number_], reach_);
  return std::ranges::any_of(own_zones(),
                             [&](const Box& zone) {
                               return division_.is_near(peer, zone.grown(width),
                                                        std::max(widths_[peer], reach_));
                             }) ||
         looks_at(peer, number_) || looks_at(number_, peer);
}

/// Whether an annex of the one may have bodies of the other.
bool Halos::looks_at(PeerNumber viewer, PeerNumber owner) const {
  const double width = std::max(widths_[owner], reach_);
  const auto is_met = [&](const Box& annex) { return division_.is_near(owner, annex, width); };
  return std::ranges::any_of(annexes_[viewer], is_met) ||
         std::ranges::any_of(former_annexes_[viewer], is_met);
}

void Halos::find_neighbours() {
  const bool are_all = !keeps_to_neighbours_ || reach_ == infinity;
  neighbours_.clear();
  for (PeerNumber peer = 0; peer < peer_count(); ++peer)
    if (peer != number_ && is_present_[peer] && (are_all || may_reach(peer)))
      neighbours_.push_back(peer);
}

}  // namespace rink::peer
