// Runs the steps of peer.h in their order, message by message.
#include "game/peer/protocol.h"

#include <algorithm>
#include <cassert>

#include "game/physics/body_hash.h"

namespace rink::peer {

namespace {

template <class Message>
void receive(Peer& peer, PeerNumber from, std::span<const std::uint8_t> bytes) {
  Message message;
  if (!read(bytes, message))
    throw ProtocolError("peer " + std::to_string(from) + " sent what is no message");
  peer.receive(from, std::move(message));
}

/// Sends what `make(to)` makes to each addressee, and receives theirs.
template <class Make>
void exchange_with(const Addressees& addressees, Peer& peer, Mail& mail, Make&& make,
                   const std::function<void()>& meanwhile) {
  for (const PeerNumber to : addressees.to) mail.send(to, written(make(to)));
  if (meanwhile) meanwhile();
  for (const PeerNumber from : addressees.from)
    receive<decltype(make(from))>(peer, from, mail.receive(from));
  if (peer.accusation().is_made()) throw ProtocolError(peer.accusation().text());
}

/// True for a body of which the engine's hash has no more than its flight.
bool flies_straight(const BodyState& state, const physics::WorldSpec& spec) {
  return state.kind != physics::BodyKind::bat && state.acceleration == Vector2(0.0, 0.0) &&
         state.drag == Vector2::Constant(spec.puck_drag);
}

}  // namespace

std::vector<std::vector<std::uint8_t>> Mail::share(PeerNumber own, PeerNumber peer_count,
                                                   std::vector<std::uint8_t> bytes) {
  assert(own < peer_count && bytes.size() <= shared_max);
  std::vector<std::vector<std::uint8_t>> all(peer_count);
  for (PeerNumber to = 0; to < peer_count; ++to)
    if (to != own) send(to, bytes);
  for (PeerNumber from = 0; from < peer_count; ++from)
    if (from != own) all[from] = receive(from);
  all[own] = std::move(bytes);
  return all;
}

void agree(Peer& peer, PeerNumber peer_count, Mail& mail) {
  const std::vector<std::uint8_t> own = written(peer.verdicts().own());
  const bool is_long = own.size() > Mail::shared_max;
  const auto verdicts =
      mail.share(peer.number(), peer_count, is_long ? std::vector<std::uint8_t>() : own);
  assert(verdicts.size() == peer_count && "who carries the mail gives one of each");
  for (PeerNumber to = 0; to < peer_count && is_long; ++to)
    if (to != peer.number()) mail.send(to, own);
  for (PeerNumber from = 0; from < peer_count; ++from)
    if (from != peer.number())
      receive<Verdict>(peer, from, verdicts[from].empty() ? mail.receive(from) : verdicts[from]);
  if (peer.accusation().is_made()) throw ProtocolError(peer.accusation().text());
}

Addressees claim_addressees(const Peer& peer) {
  return {peer.halos().neighbours(), peer.halos().neighbours()};
}

Addressees repeat_addressees(const Peer& peer) {
  Addressees addressees{peer.halos().neighbours(), {}};
  std::erase_if(addressees.to, [&](PeerNumber to) { return !peer.verdicts().repeats(to); });
  if (peer.verdicts().repeats(peer.number())) addressees.from = peer.halos().neighbours();
  return addressees;
}

Addressees handover_addressees(const Peer& peer) {
  const auto watches = [&](PeerNumber watcher, PeerNumber watched) {
    const std::vector<PeerNumber>& watchers = peer.verdicts().of(watched).watchers;
    return std::ranges::find(watchers, watcher) != watchers.end();
  };
  Addressees addressees;
  for (PeerNumber other = 0; other < peer.halos().peer_count(); ++other) {
    if (other == peer.number() || !peer.halos().is_present(other)) continue;
    const bool is_neighbour = peer.halos().has_neighbour(other);
    if (is_neighbour || watches(other, peer.number())) addressees.to.push_back(other);
    if (is_neighbour || watches(peer.number(), other)) addressees.from.push_back(other);
  }
  return addressees;
}

void play_window(Peer& peer, PeerNumber peer_count, Mail& mail, double next) {
  const auto exchange = [&](const Addressees& addressees, auto&& make,
                            const std::function<void()>& meanwhile) {
    exchange_with(addressees, peer, mail, make, meanwhile);
  };
  play_steps(peer, next, exchange, [&] { agree(peer, peer_count, mail); }, {});
}

Handover own_bodies(const Peer& peer) {
  Handover all;
  const physics::WorldSpec& spec = peer.world().spec();
  for (const std::uint32_t body : peer.owned()) {
    const BodyState state = peer.share().state(body);
    if (state.flags == 0 && flies_straight(state, spec) && !spec.surface_friction)
      all.free_flights.push_back(FreeFlightState::of(body, state.flight));
    else all.bodies.push_back({body, state});
  }
  assert(all.free_flights.size() + all.bodies.size() == peer.owned().size());
  return all;
}

std::optional<std::uint64_t> hash_of_whole(const physics::WorldSpec& spec, std::uint32_t body_count,
                                           std::span<const Handover> parts) {
  /// The place of a body in one of the parts.
  struct Place {
    const BodyState* state = nullptr;
    const FreeFlightState* free_flights = nullptr;
  };
  std::vector<Place> places(body_count);
  std::uint32_t known = 0;
  const auto take = [&](std::uint32_t body, Place place) {
    if (body >= body_count || places[body].state != nullptr || places[body].free_flights != nullptr)
      return false;
    places[body] = place;
    return ++known, true;
  };
  for (const Handover& part : parts) {
    for (const auto& [body, state] : part.bodies)
      if (!take(body, {&state, nullptr})) return std::nullopt;
    for (const FreeFlightState& free_flights : part.free_flights)
      if (!take(free_flights.number, {nullptr, &free_flights})) return std::nullopt;
  }
  if (known != body_count) return std::nullopt;
  physics::BodyHash hash;
  for (const auto& [state, free_flights] : places) {
    if (free_flights != nullptr) {
      physics::Flight flight{};
      free_flights->write_to(flight);
      hash.add(flight, nullptr, nullptr, 0, std::nullopt);
      continue;
    }
    const bool is_straight = flies_straight(*state, spec);
    hash.add(state->flight, is_straight ? nullptr : &state->acceleration,
             is_straight ? nullptr : &state->drag, state->flags,
             spec.surface_friction ? std::optional(state->spin) : std::nullopt);
  }
  return hash.value();
}

std::uint64_t self_test_hash() {
  physics::WorldSpec spec;
  spec.field = {
      .length = 2.0, .width = 1.0, .goal_width = 0.0, .wall = 0, .bats_keep_to_half = false};
  spec.puck_drag = 0.2, spec.bat_drag = 3.0;
  spec.restitution = physics::RestitutionTable(1, 0.7);
  physics::World world(spec);
  world.add(physics::PostSpec{.position = {1.0, 0.5}, .radius = 0.05});
  const physics::BodyId bat = world.add(physics::BatSpec{.position = {0.2, 0.5}});
  for (int k = 0; k < 24; ++k) {
    const double x = 0.35 + 0.2 * (k % 8), y = 0.15 + 0.35 * (k / 8), angle = 2.4 * k;
    const physics::PuckSpec puck{
        .position = {x, y}, .velocity = {1.0 - 0.01 * angle, 0.03 * angle - 0.5}, .mass = 1.0 + k};
    if (world.is_free(puck.position, puck.radius)) world.add(puck);
  }
  world.set_thrust(bat, {7.0, 1.0});
  while (world.advance(3.0)) {
  }
  return world.hash();
}

}  // namespace rink::peer
