// Chooses who keeps which part, and hands out what is kept.
#include "game/peer/session/replicas.h"

#include <algorithm>
#include <cassert>
#include <utility>

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

void Replicas::begin(const physics::World& whole, const State& start, const Division& division) {
  for (const PeerNumber peer : start.members) {
    if (peer != number_ && !keeps(peer, start)) continue;
    PartChange part{.step = 0,
                    .time = 0.0,
                    .is_whole = true,
                    .bodies = {},
                    .gone = {},
                    .rest_contacts = {},
                    .keys = {},
                    .log = {}};
    for (std::uint32_t body = 0; body < whole.body_count(); ++body)
      if (division.owner_of(whole.position({body})) == peer)
        part.bodies.push_back({body, physics::Subdomain::state_in(whole, body)});
    add(peer, std::move(part));
  }
}

void Replicas::make_room(PeerNumber slots) {
  assert(number_ < slots);
  if (slots > replicas_.size()) replicas_.resize(slots);
}

bool Replicas::add(PeerNumber peer, PartChange change) {
  assert(peer < replicas_.size());
  return replicas_[peer].add(std::move(change));
}

void Replicas::rewind(std::uint64_t step) {
  for (PartReplica& replica : replicas_)
    if (!replica.rewind(step)) replica = PartReplica();
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

Handover Replicas::share(std::span<const PeerNumber> parts, const Division& division, PeerNumber to,
                         double halo) {
  Handover message;
  for (const PeerNumber peer : parts) {
    const Part& part = replicas_[peer].part();
    std::vector<std::uint32_t> bodies;
    for (const auto& [body, state] : part.bodies) {
      const Box place =
          Box::around(state.motion().at(part.time).position, state.extent()).grown(1e-6);
      if (state.flags != 0 || division.is_near(to, place, halo)) bodies.push_back(body);
    }
    std::sort(bodies.begin(), bodies.end());
    for (const std::uint32_t body : bodies) message.bodies.push_back({body, part.bodies.at(body)});
    message.rest_contacts.insert(message.rest_contacts.end(), part.rest_contacts.begin(),
                                 part.rest_contacts.end());
    message.keys.insert(message.keys.end(), part.keys.begin(), part.keys.end());
  }
  return message;
}

}  // namespace rink::peer
