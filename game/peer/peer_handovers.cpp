// Handovers of bodies between two windows, and the peers that have them afterwards.
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

Handover Peer::handover_for_repeat(PeerNumber peer) {
  assert(peer < known_.size() && peer != number_);
  Handover message;
  message.window = window_;
  std::vector<std::uint32_t> sent;
  for (const std::uint32_t body : owned_) {
    if (knows(peer, body) || !is_in_region(peer, start_reach(body))) continue;
    message.bodies.push_back({body, subdomain_.state_before(body)});
    sent.push_back(body);
  }
  std::sort(sent.begin(), sent.end());
  for (const RestContact& rest : subdomain_.rest_contacts_before())
    if (contains(sent, rest.low) || contains(sent, rest.high))
      message.rest_contacts.push_back(rest);
  for (const Key& key : due_)
    if (contains(sent, key.bat)) message.keys.push_back(key);
  std::vector<std::uint32_t>& known = known_[peer];
  known.insert(known.end(), sent.begin(), sent.end());
  std::sort(known.begin(), known.end());
  counters_.arrival_bytes += measured(message);
  return message;
}

Handover Peer::handover_for(PeerNumber peer, double until) {
  assert(peer < coming_.size() && peer != number_ && until >= end_);
  Handover message;
  message.window = window_;
  std::vector<std::uint32_t> there;
  for (const Reach& reach : outskirts_) {
    if (!is_in_region(peer, reach.box)) continue;
    there.push_back(reach.body);
    if (!knows(peer, reach.body))
      message.bodies.push_back({reach.body, subdomain_.state(reach.body)});
    else if (subdomain_.has_flown_freely(reach.body))
      message.free_flights.push_back(
          FreeFlightState::of(reach.body, subdomain_.flight(reach.body)));
    else if (!steps_of(reach.body).empty())
      message.bodies.push_back({reach.body, subdomain_.state(reach.body)});
  }
  std::sort(there.begin(), there.end());
  for (const RestContact& rest : subdomain_.rest_contacts())
    if (contains(there, rest.low) || contains(there, rest.high))
      message.rest_contacts.push_back(rest);
  for (const Key& key : keys_)
    if (contains(there, key.bat) &&
        (key.time <= until || division_.owner_of(subdomain_.world().position({key.bat})) == peer))
      message.keys.push_back(key);
  message.observations = observations_for(peer);
  coming_[peer] = std::move(there);
  counters_.arrival_bytes += measured(message);
  return message;
}

/// Most ghosts already have their owners' states; the others follow from their states at the
/// window's start.
void Peer::complete_free_flights(Handover& handover, PeerNumber from) {
  for (const FreeFlightState& free_flights : handover.free_flights) {
    const std::uint32_t body = free_flights.number;
    if (body >= roles_.size() || roles_[body] != ghost || owners_[body] != from) {
      report(from, "hands over body " + std::to_string(body) + ", which it does not own");
      continue;
    }
    const bool is_doubtful =
        doubts_[static_cast<std::size_t>(std::lower_bound(ghosts_.begin(), ghosts_.end(), body) -
                                         ghosts_.begin())] < infinity;
    if (!is_doubtful && subdomain_.has_flown_freely(body) &&
        free_flights.is_as(subdomain_.flight(body)))
      continue;
    handover.bodies.push_back({body, subdomain_.state_before(body)});
    free_flights.write_to(handover.bodies.back().state.flight);
  }
}

void Peer::enter_bodies(const Handover& handover, PeerNumber from) {
  for (const auto& [body, state] : handover.bodies) {
    if (body >= subdomain_.body_count() || roles_[body] == own ||
        (roles_[body] == ghost && owners_[body] != from)) {
      report(from, "hands over body " + std::to_string(body) + ", which it does not own");
      continue;
    }
    extent_max_ = std::max(extent_max_, state.extent().maxCoeff());
    if (!subdomain_.is_there(body) || !are_same(subdomain_.state(body), state))
      subdomain_.put(body, state);
  }
}

}  // namespace rink::peer
