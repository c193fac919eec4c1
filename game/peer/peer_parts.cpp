// A peer's own part as a whole: taken over from others, copied to its replica, and given other
// borders.
#include <algorithm>
#include <cassert>

#include "im/basics/checked.h"

#include "game/peer/peer.h"

namespace rink::peer {

void Peer::enter(std::uint32_t window, double start) {
  assert(owned_.empty() && ghosts_.empty() && start >= subdomain_.world().now());
  window_ = window, start_ = start;
  subdomain_.advance(start);
}

/// `begin` decides the owners.
void Peer::take(const Handover& part) {
  for (const auto& [body, state] : part.bodies) {
    if (body >= subdomain_.body_count() || subdomain_.is_there(body)) continue;
    extent_max_ = std::max(extent_max_, state.extent().maxCoeff());
    subdomain_.put(body, state);
    ghosts_.push_back(body);
  }
  entered_holds_.insert(entered_holds_.end(), part.rest_contacts.begin(), part.rest_contacts.end());
  keys_.insert(keys_.end(), part.keys.begin(), part.keys.end());
}

/// A new peer has no halo until its first verdict, and no zone.
void Peer::make_room(PeerNumber peer_count) {
  assert(peer_count > halos_.size());
  halos_.resize(peer_count, usual_halo_);
  is_repeating_.resize(peer_count, false), is_present_.resize(peer_count, false);
  known_.resize(peer_count), coming_.resize(peer_count), presses_.resize(peer_count);
  claims_.resize(peer_count), verdicts_.resize(peer_count), handovers_.resize(peer_count);
}

/// Checks all own bodies anew.
void Peer::divide(const Division& division) {
  assert(division.peer_count() >= division_.peer_count());
  if (division.peer_count() > division_.peer_count()) make_room(division.peer_count());
  division_ = division;
  margin_ = -1.0;
  outskirts_.clear();
  for (const std::uint32_t body : owned_) outskirts_.push_back({body, reach_of(body)});
}

/// Call it before the journal is cleared.
void Peer::note_changed() {
  changed_.clear(), free_flights_.clear(), left_.clear();
  for (const auto& kept : subdomain_.before().flights())
    if (roles_[kept.body] == own)
      (subdomain_.has_flown_freely(kept.body) ? free_flights_ : changed_).push_back(kept.body);
}

PartChange Peer::change(bool is_whole) const {
  PartChange change{.step = 0,
                    .time = subdomain_.world().now(),
                    .is_whole = is_whole,
                    .bodies = {},
                    .gone = {},
                    .rest_contacts = {},
                    .keys = {},
                    .log = {}};
  std::vector<std::uint32_t> bodies = is_whole ? owned_ : changed_;
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  for (const std::uint32_t body : bodies)
    if (roles_[body] == own) change.bodies.push_back({body, subdomain_.state(body)});
  if (!is_whole) {
    for (const std::uint32_t body : free_flights_)
      if (roles_[body] == own)
        change.free_flights.push_back(FreeFlightState::of(body, subdomain_.flight(body)));
    change.gone = left_;
    change.log = log_;
  }
  const auto is_own = [&](physics::Partner p) {
    return p < physics::partner::field_parts && roles_[p] == own;
  };
  for (const RestContact& rest : subdomain_.rest_contacts())
    if (is_own(rest.low) || is_own(rest.high)) change.rest_contacts.push_back(rest);
  for (const std::vector<Key>* keys : {&due_, &keys_})
    for (const Key& key : *keys)
      if (key.input != 0 && roles_[key.bat] == own) change.keys.push_back(key);
  return change;
}

/// Nothing is in contact with the puck, and every peer that has it derives the same state from its
/// owner's.
void Peer::put_back(const Handover::Body& scored, const Vector2& place) {
  const std::uint32_t body = scored.number;
  assert(body < roles_.size() && place.allFinite());
  const bool was_own = roles_[body] == own;
  std::erase(ghosts_, body);
  for (std::vector<std::uint32_t>& known : known_) std::erase(known, body);
  if (!subdomain_.is_there(body)) subdomain_.put(body, scored.state);
  extent_max_ = std::max(extent_max_, scored.state.extent().maxCoeff());
  subdomain_.place(body, place);
  const Box reach = Box::around(place, extent_of(body));
  owners_[body] = division_.owner_of(place);
  const auto insert = [body](std::vector<std::uint32_t>& list) {
    list.insert(std::upper_bound(list.begin(), list.end(), body), body);
  };
  if (owners_[body] == number_) {
    if (!was_own) own_from_now(body);
    else if (keeps_changes_) changed_.push_back(body);
    homes_[body] = home_of(place, 0);
    watch(body, watched);
    for (PeerNumber peer = 0; peer < division_.peer_count(); ++peer)
      if (peer != number_ && is_in_region(peer, reach)) insert(known_[peer]);
  } else {
    if (was_own) disown(body);
    std::erase(watched_, body);
    is_watched_[body] = not_watched;
    roles_[body] = is_in_region(number_, reach) ? ghost : away;
    if (roles_[body] == ghost) insert(ghosts_);
    else subdomain_.drop(body);
  }
  if (!is_margin_fit()) choose_margin();
  subdomain_.begin_window();
  if constexpr (checks_whole_structures) check();
}

}  // namespace rink::peer
