// Chooses who keeps which part, and hands out what is kept.
#include "game/peer/session/replicas.h"

#include <algorithm>
#include <cassert>

#include "game/peer/session/part_change.h"
#include "game/peer/standby/part_at_start.h"

namespace rink::peer {

std::optional<PeerNumber> Replicas::keeper_of(PeerNumber peer, const State& state) {
  std::optional<PeerNumber> first;
  for (const PeerNumber other : state.cuts.peers()) {
    if (other == peer) continue;
    if (other > peer) return other;
    if (!first) first = other;
  }
  return first;
}

void Replicas::begin(const Start& start, const State& now, double halo, const Validator& scene) {
  const Division division = now.division();
  for (const PeerNumber peer : now.members)
    if (peer != number_ && keeps(peer, now))
      of(peer).begin(part_at_start(start, division, peer, halo, scene));
}

void Replicas::make_room(PeerNumber slots) {
  assert(number_ < slots);
  if (slots > replicas_.size()) replicas_.resize(slots);
}

void Replicas::rewind(std::uint64_t step) {
  for (StandbyCopy& replica : replicas_)
    if (!replica.rewind(step)) replica = {};
}

void Replicas::drop_others(const State& now, const State& next) {
  for (PeerNumber peer = 0; peer < replicas_.size(); ++peer)
    if (peer != number_ && !replicas_[peer].is_empty() && !keeps(peer, now) && !keeps(peer, next))
      replicas_[peer] = {};
}

std::vector<Key> Replicas::log(PeerNumber peer) const {
  assert(peer < replicas_.size());
  return replicas_[peer].log();
}

std::optional<PeerNumber> Replicas::first_unkept(const State& now, const Losses& losses) {
  for (const PeerNumber peer : now.members) {
    if (!losses.is_gone(peer) || now.is_fresh(peer)) continue;
    const auto keeper = keeper_of(peer, now);
    if (!keeper || losses.is_gone(*keeper)) return peer;
  }
  return std::nullopt;
}

std::vector<PeerNumber> Replicas::parts_of(PeerNumber by, const State& now, const Losses& losses) {
  std::vector<PeerNumber> parts{by};
  for (const PeerNumber peer : now.members)
    if (losses.is_gone(peer) && !now.is_fresh(peer) && keeper_of(peer, now) == by)
      parts.push_back(peer);
  return parts;
}

Handover Replicas::share(std::span<const Part> parts, const Division& division, PeerNumber to,
                         double halo) {
  Handover message;
  for (const Part& part : parts) {
    for (const auto& [body, state] : part.bodies) {
      const Box place = Box::around(place_of(state, part.time), state.extent()).grown(1e-6);
      if (state.flags != 0 || division.is_near(to, place, halo))
        message.bodies.push_back({body, state});
    }
    message.rest_contacts.insert(message.rest_contacts.end(), part.rest_contacts.begin(),
                                 part.rest_contacts.end());
    message.keys.insert(message.keys.end(), part.keys.begin(), part.keys.end());
  }
  return message;
}

}  // namespace rink::peer
