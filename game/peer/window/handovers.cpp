// Chooses the bodies that others need, and enters theirs.
#include "game/peer/window/handovers.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

namespace rink::peer {

namespace {

bool holds(const std::vector<std::uint32_t>& sorted, std::uint32_t body) {
  return std::binary_search(sorted.begin(), sorted.end(), body);
}

/// Of these contacts, those with one of the bodies.
void add_contacts(const std::vector<RestContact>& contacts,
                  const std::vector<std::uint32_t>& sorted, std::vector<RestContact>& added) {
  for (const RestContact& rest : contacts)
    if (holds(sorted, rest.low) || holds(sorted, rest.high)) added.push_back(rest);
}

}  // namespace

Handovers::Handovers(Share& share, const Halos& halos, const TimedKeys& keys,
                     Accusation& accusation)
    : share_(share),
      halos_(halos),
      keys_(keys),
      accusation_(accusation),
      received_(halos.peer_count()),
      wanted_(halos.peer_count()) {}

Handover Handovers::for_repeat(PeerNumber peer, const Window& window) {
  assert(peer < halos_.peer_count() && peer != halos_.number());
  Handover message;
  message.window = window.number;
  std::vector<std::uint32_t> sent;
  for (const std::uint32_t body : share_.roles().owned()) {
    if (share_.knows(peer, body) || !halos_.is_near(peer, share_.start_reach(body, window.start)))
      continue;
    message.bodies.push_back({body, share_.subdomain().state_before(body)});
    sent.push_back(body);
  }
  std::sort(sent.begin(), sent.end());
  add_contacts(share_.subdomain().rest_contacts_before(), sent, message.rest_contacts);
  for (const Key& key : keys_.due())
    if (holds(sent, key.bat)) message.keys.push_back(key);
  share_.tell(peer, sent);
  return message;
}

void Handovers::note_wanted(PeerNumber peer, std::vector<std::uint32_t> bodies) {
  assert(peer < wanted_.size());
  wanted_[peer] = std::move(bodies);
  std::ranges::sort(wanted_[peer]);
}

Handover Handovers::for_next(PeerNumber peer, const Window& window, double until,
                             const Homes& homes, const ClaimTrace& trace) {
  assert(peer < halos_.peer_count() && peer != halos_.number() && until >= window.end);
  const physics::Subdomain& subdomain = share_.subdomain();
  Handover message;
  message.window = window.number;
  std::vector<std::uint32_t> there;
  for (const Reach& reach : homes.outskirts()) {
    if (!halos_.is_near(peer, reach.box)) continue;
    there.push_back(reach.body);
    if (!share_.knows(peer, reach.body))
      message.bodies.push_back({reach.body, share_.state(reach.body)});
    else if (!holds(wanted_[peer], reach.body)) continue;
    else if (subdomain.has_flown_freely(reach.body))
      message.free_flights.push_back(FreeFlightState::of(reach.body, subdomain.flight(reach.body)));
    else if (!trace.steps_of(reach.body).empty())
      message.bodies.push_back({reach.body, share_.state(reach.body)});
  }
  std::sort(there.begin(), there.end());
  add_contacts(subdomain.rest_contacts(), there, message.rest_contacts);
  for (const Key& key : keys_.later())
    if (holds(there, key.bat) &&
        (key.time <= until || halos_.owner_of(share_.world().position({key.bat})) == peer))
      message.keys.push_back(key);
  share_.expect(peer, std::move(there));
  return message;
}

void Handovers::receive(PeerNumber from, Handover handover) {
  assert(from < received_.size() && from != halos_.number());
  received_[from] = std::move(handover);
}

void Handovers::report(PeerNumber from, std::uint32_t body) {
  accusation_.report(from, "hands over body " + std::to_string(body) + ", which it does not own");
}

void Handovers::complete(const ClaimCheck& check) {
  for (PeerNumber from = 0; from < received_.size(); ++from) {
    check_states(from, check);
    complete(received_[from], from, check);
  }
}

void Handovers::check_states(PeerNumber from, const ClaimCheck& check) {
  const auto may_show = [&](std::uint32_t body) {
    return body < share_.roles().body_count() && share_.roles().has_ghost_of(from, body);
  };
  const auto report_other = [&](std::uint32_t body) {
    accusation_.report(
        from, "hands over body " + std::to_string(body) + " in another state than it has claimed");
  };
  for (const auto& [body, state] : received_[from].bodies)
    if (may_show(body) && check.contradicts(body, state)) report_other(body);
  for (const FreeFlightState& flight : received_[from].free_flights)
    if (may_show(flight.number) && check.contradicts(flight)) report_other(flight.number);
}

/// Most ghosts already have their owners' states; the others follow from their states at the
/// window's start.
void Handovers::complete(Handover& handover, PeerNumber from, const ClaimCheck& check) {
  const physics::Subdomain& subdomain = share_.subdomain();
  for (const FreeFlightState& free_flight : handover.free_flights) {
    const std::uint32_t body = free_flight.number;
    if (body >= share_.roles().body_count() || !share_.roles().has_ghost_of(from, body)) {
      report(from, body);
      continue;
    }
    if (!check.is_uncertain(body) && subdomain.has_flown_freely(body) &&
        free_flight.is_as(subdomain.flight(body)))
      continue;
    handover.bodies.push_back({body, subdomain.state_before(body)});
    free_flight.write_to(handover.bodies.back().state.flight);
  }
}

bool Handovers::may_hand_over(PeerNumber from, std::uint32_t body) const {
  const Roles& roles = share_.roles();
  return body < roles.body_count() &&
         (roles.of(body) == Role::away || roles.has_ghost_of(from, body));
}

/// What is there of `from` in the next window is a ghost of its already, or comes with this.
bool Handovers::brings(PeerNumber from, std::span<const std::uint32_t> brought,
                       std::uint32_t body) const {
  return body < share_.roles().body_count() &&
         (share_.roles().has_ghost_of(from, body) || std::ranges::binary_search(brought, body));
}

void Handovers::drop_keys(PeerNumber from, std::span<const std::uint32_t> brought,
                          Handover& handover) {
  std::erase_if(handover.keys, [&](const Key& key) {
    if (brings(from, brought, key.bat)) return false;
    accusation_.report(
        from, "hands over a key of bat " + std::to_string(key.bat) + ", which it does not own");
    return true;
  });
}

void Handovers::drop_contacts(PeerNumber from, std::span<const std::uint32_t> brought,
                              Handover& handover) {
  std::erase_if(handover.rest_contacts, [&](const RestContact& rest) {
    if (brings(from, brought, rest.low) || brings(from, brought, rest.high)) return false;
    accusation_.report(from, "hands over a rest contact of bodies " + std::to_string(rest.low) +
                                 " and " + std::to_string(rest.high) +
                                 ", neither of which it owns");
    return true;
  });
}

Handover Handovers::enter(PeerNumber from) {
  assert(from < received_.size());
  Handover handover = std::exchange(received_[from], {});
  std::erase_if(handover.bodies, [&](const Handover::Body& body) {
    if (may_hand_over(from, body.number)) return false;
    report(from, body.number);
    return true;
  });
  if (!handover.keys.empty() || !handover.rest_contacts.empty()) {
    std::vector<std::uint32_t> brought;
    for (const Handover::Body& body : handover.bodies) brought.push_back(body.number);
    std::ranges::sort(brought);
    drop_keys(from, brought, handover), drop_contacts(from, brought, handover);
  }
  for (const auto& [body, state] : handover.bodies)
    if (!share_.subdomain().is_there(body) || !are_same(share_.state(body), state))
      share_.put(body, state);
  return handover;
}

void Handovers::make_room(PeerNumber peer_count) {
  assert(peer_count >= received_.size());
  received_.resize(peer_count), wanted_.resize(peer_count);
}

}  // namespace rink::peer
