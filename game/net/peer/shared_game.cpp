// From a scene to windows and back to one hash.
#include "game/net/peer/shared_game.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "game/control/game_hash.h"
#include "game/model/state_hash.h"
#include "game/net/peer/crowd.h"

namespace rink::game {

namespace {

std::vector<InputEvent> merged(std::vector<InputEvent> keys, const std::vector<InputEvent>& further) {
  keys.insert(keys.end(), further.begin(), further.end());
  std::stable_sort(keys.begin(), keys.end(), [](const InputEvent& a, const InputEvent& b) { return std::tuple(a.time, a.player) < std::tuple(b.time, b.player); });
  return keys;
}

const Scene& shareable(const Scene& scene) {
  if (scene.world.field.goal_width > 0.0) throw SceneError("scene '" + scene.name + "' has goals (field.goal_width), and peers cannot yet bring scored pucks back: expected a scene without, such as arena");
  return scene;
}

BatController controller_of(const Scene& scene, std::uint32_t player) { return BatController(scene.bodies.bats[player].thrust); }

}  // namespace

SharedGame::SharedGame(const Scene& scene, const std::vector<InputEvent>& recorded) : scene_(shareable(scene)), keys_(merged(scene.keys, recorded)), start_(scene) {
  for (const InputEvent& key : keys_)
    if (key.kind == InputKind::enter || key.kind == InputKind::leave)
      throw SceneError("player " + std::to_string(key.player) + (key.kind == InputKind::enter ? " enters" : " leaves") + " at " + std::to_string(key.time) +
                       " s, and peers cannot yet add or remove bats: expected keys alone");
}

Luggage SharedGame::luggage() const {
  StateHash keys;
  for (const InputEvent& key : keys_) keys.add(key.time), keys.add(std::uint64_t{key.player} << 32 | static_cast<std::uint64_t>(key.kind) << 8 | static_cast<std::uint64_t>(key.key));
  return {.self_test = peer::self_test_hash(), .scene = fingerprint(scene_), .keys = keys.value()};
}

/// Posts cost nothing, so they do not count.
peer::Division SharedGame::division(peer::PeerNumber peer_count) const {
  std::vector<Vector2> places;
  for (const Entity& entity : start_.entities())
    if (entity.kind != physics::BodyKind::post) places.push_back(start_.position(entity.id));
  return peer::Division::by_count(scene_.world.field, std::move(places), peer_count);
}

/// Two large bodies side by side, and what the fastest of them fly in a window; peers widen or narrow it as they go.
double SharedGame::first_halo(double window) const {
  double extent = 0.0, speed = 0.0;
  for (const Entity& entity : start_.entities()) {
    extent = std::max(extent, entity.half_extent.maxCoeff());
    speed = std::max(speed, start_.velocity(entity.id).norm());
  }
  return 4.0 * extent + 2.0 * speed * window + 1e-3;
}

std::vector<peer::Key> SharedGame::thrusts() const {
  std::vector<BatController> players;
  for (std::uint32_t k = 0; k < start_.player_count(); ++k) players.push_back(controller_of(scene_, k));
  std::vector<peer::Key> keys;
  for (const InputEvent& event : keys_) {
    players[event.player].press(event.key, event.kind == InputKind::key_down);
    keys.push_back({event.time, start_.bat(event.player)->index, players[event.player].thrust()});
  }
  return keys;
}

std::uint64_t SharedGame::hash(std::uint64_t world, std::span<const InputEvent> keys, double until) const {
  std::vector<BatController> players;
  std::vector<const BatController*> hands;
  for (std::uint32_t k = 0; k < start_.player_count(); ++k) players.push_back(controller_of(scene_, k));
  for (const InputEvent& event : keys)
    if (event.time <= until) players[event.player].press(event.key, event.kind == InputKind::key_down);
  for (const BatController& player : players) hands.push_back(&player);
  return begun_game_hash(world, start_.entities(), hands, {}).value();
}

std::vector<peer::Seat> SharedGame::seats(std::span<const Guest> guests) const {
  std::vector<peer::Seat> seats;
  std::vector<std::uint8_t> is_taken(start_.player_count(), 0);
  for (peer::PeerNumber number = 0; number < guests.size(); ++number)
    for (std::uint64_t player = guests[number].first_bat, end = player + guests[number].bat_count; player < end; ++player) {
      if (player >= is_taken.size() || std::exchange(is_taken[player], std::uint8_t{1}) != 0)
        throw peer::ProtocolError("peer " + std::to_string(number) + " plays bat " + std::to_string(player) + ", which is taken or not there");
      const auto k = static_cast<std::uint32_t>(player);
      seats.push_back({.bat = start_.bat(k)->index, .peer = number, .period = decision_period, .phase = decision_phase(k), .puck_count = guests[number].puck_count});
    }
  return seats;
}

/// Everybody's together.
std::vector<InputEvent> SharedGame::keys_with(std::span<const peer::Arrivals> logs) const {
  std::vector<InputEvent> keys;
  for (const peer::Arrivals& log : logs)
    for (const peer::Key& key : log.keys) {
      if (key.bat >= start_.world().body_count() || !start_.entity({key.bat}).player || key.input == 0) throw peer::ProtocolError("a log has keys of body " + std::to_string(key.bat) + ", which nobody plays");
      keys.push_back(event_of(key.input, key.time, *start_.entity({key.bat}).player));
    }
  return merged(keys_, keys);
}

PlayedPart SharedGame::play(const Terms& terms, std::span<const Guest> guests, peer::PeerNumber number, peer::Mail& mail, const Manner& manner) const {
  const physics::World& whole = start_.world();
  peer::Peer peer(whole.spec(), division(terms.peer_count), number, whole.body_count(), first_halo(terms.window));
  for (std::uint32_t body = 0; body < whole.body_count(); ++body) peer.consider(body, physics::Portion::state_in(whole, body));
  for (const peer::Key& key : thrusts()) peer.press_first(key);
  for (const peer::Seat& seat : seats(guests)) peer.seat(seat);
  Crowd crowd(scene_, start_, manner.players, scene_.seed, guests[number].first_bat, guests[number].bat_count, terms.until);
  const auto window_count = static_cast<std::uint64_t>(std::max(1.0, std::ceil(terms.until / terms.window)));
  // The last window ends at `until`, the one that is prepared then, and never played, one window later.
  const auto end_of = [&](std::uint64_t k) { return k == window_count ? terms.until : k > window_count ? terms.until + terms.window : static_cast<double>(k) * terms.window; };
  std::vector<peer::Key> log;
  peer.begin(end_of(1));
  for (std::uint64_t k = 1; k <= window_count; ++k) {
    if (manner.before_window) manner.before_window(peer.now());
    peer::play_window(peer, terms.peer_count, mail, end_of(k + 1));
    log.insert(log.end(), peer.log().begin(), peer.log().end());
    crowd.act(peer);
  }
  PlayedPart part = end(terms, peer, std::move(log), mail);
  part.presses = crowd.presses();
  return part;
}

/// Everybody tells everybody what it has, and what its players did.
PlayedPart SharedGame::end(const Terms& terms, const peer::Peer& peer, std::vector<peer::Key> log, peer::Mail& mail) const {
  PlayedPart part{.counters = peer.counters(), .owned = peer.owned().size(), .ghosts = peer.ghosts().size(), .halo = peer.halo(), .keys = {}};
  std::vector<peer::Arrivals> parts(terms.peer_count);
  parts[peer.number()] = peer::own_bodies(peer);
  parts[peer.number()].keys = std::move(log);
  const std::vector<std::uint8_t> bytes = written(parts[peer.number()]);
  for (peer::PeerNumber to = 0; to < terms.peer_count; ++to)
    if (to != peer.number()) mail.send(to, bytes), part.result_bytes += bytes.size();
  for (peer::PeerNumber from = 0; from < terms.peer_count; ++from)
    if (from != peer.number() && !read(mail.receive(from), parts[from])) throw peer::ProtocolError("peer " + std::to_string(from) + " sent what is no list of bodies");
  const physics::World& whole = start_.world();
  const auto world = peer::hash_of_whole(whole.spec(), whole.body_count(), parts);
  if (!world) throw peer::ProtocolError("not every body has one owner in the end");
  part.keys = keys_with(parts);
  part.hash = hash(*world, part.keys, terms.until);
  return part;
}

}  // namespace rink::game
