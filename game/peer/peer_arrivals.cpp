// What goes from hand to hand between two windows, and who has whose bodies then.
#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "game/peer/peer.h"

namespace rink::peer {

namespace {

bool contains(const std::vector<std::uint32_t>& sorted, std::uint32_t body) {
  return std::binary_search(sorted.begin(), sorted.end(), body);
}

}  // namespace

bool Peer::knows(PeerNumber peer, std::uint32_t body) const { return contains(known_[peer], body); }
bool Peer::will_have(PeerNumber peer, std::uint32_t body) const {
  return contains(coming_[peer], body);
}

Box Peer::start_reach(std::uint32_t body) const {
  for (const Reach& group : groups_)
    if (group.body == body) return group.box;
  return Box::around(start_place(body), extent_of(body));
}

Arrivals Peer::arrivals_for_repeat(PeerNumber peer) {
  assert(peer < known_.size() && peer != number_);
  Arrivals message;
  message.window = window_;
  std::vector<std::uint32_t> sent;
  for (const std::uint32_t body : owned_) {
    if (knows(peer, body) || !is_in_region(peer, start_reach(body))) continue;
    message.bodies.push_back({body, portion_.state_before(body)});
    sent.push_back(body);
  }
  std::sort(sent.begin(), sent.end());
  for (const Hold& hold : portion_.holds_before())
    if (contains(sent, hold.low) || contains(sent, hold.high)) message.holds.push_back(hold);
  for (const Key& key : due_)
    if (contains(sent, key.bat)) message.keys.push_back(key);
  std::vector<std::uint32_t>& known = known_[peer];
  known.insert(known.end(), sent.begin(), sent.end());
  std::sort(known.begin(), known.end());
  counters_.arrival_bytes += measured(message);
  return message;
}

Arrivals Peer::arrivals_for(PeerNumber peer, double until) {
  assert(peer < coming_.size() && peer != number_ && until >= end_);
  Arrivals message;
  message.window = window_;
  std::vector<std::uint32_t> there;
  for (const Reach& reach : outskirts_) {
    if (!is_in_region(peer, reach.box)) continue;
    there.push_back(reach.body);
    if (!knows(peer, reach.body))
      message.bodies.push_back({reach.body, portion_.state(reach.body)});
    else if (portion_.has_only_flown(reach.body))
      message.flown.push_back(Flown::of(reach.body, portion_.flight(reach.body)));
    else if (!steps_of(reach.body).empty())
      message.bodies.push_back({reach.body, portion_.state(reach.body)});
  }
  std::sort(there.begin(), there.end());
  for (const Hold& hold : portion_.holds())
    if (contains(there, hold.low) || contains(there, hold.high)) message.holds.push_back(hold);
  for (const Key& key : keys_)
    if (contains(there, key.bat) &&
        (key.time <= until || division_.owner_of(portion_.world().position({key.bat})) == peer))
      message.keys.push_back(key);
  message.glimpses = glimpses_for(peer);
  coming_[peer] = std::move(there);
  counters_.arrival_bytes += measured(message);
  return message;
}

/// Most ghosts are already what their owners say; the others follow from what they were when the
/// window began.
void Peer::complete_flown(Arrivals& arrivals, PeerNumber from) {
  for (const Flown& flown : arrivals.flown) {
    const std::uint32_t body = flown.number;
    if (body >= roles_.size() || roles_[body] != ghost || owners_[body] != from) {
      accuse(from, "hands over body " + std::to_string(body) + ", which it does not own");
      continue;
    }
    const bool is_doubtful =
        doubts_[static_cast<std::size_t>(std::lower_bound(ghosts_.begin(), ghosts_.end(), body) -
                                         ghosts_.begin())] < infinity;
    if (!is_doubtful && portion_.has_only_flown(body) && flown.is_as(portion_.flight(body)))
      continue;
    arrivals.bodies.push_back({body, portion_.state_before(body)});
    flown.write_to(arrivals.bodies.back().state.flight);
  }
}

void Peer::enter_bodies(const Arrivals& arrivals, PeerNumber from) {
  for (const auto& [body, state] : arrivals.bodies) {
    if (body >= portion_.body_count() || roles_[body] == own ||
        (roles_[body] == ghost && owners_[body] != from)) {
      accuse(from, "hands over body " + std::to_string(body) + ", which it does not own");
      continue;
    }
    extent_max_ = std::max(extent_max_, state.extent().maxCoeff());
    if (!portion_.is_there(body) || !are_same(portion_.state(body), state))
      portion_.put(body, state);
  }
}

}  // namespace rink::peer
