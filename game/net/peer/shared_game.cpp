// From a scene to windows and back to one hash.
#include "game/net/peer/shared_game.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "game/control/game_hash.h"
#include "game/model/state_hash.h"

namespace rink::game {

namespace {

std::vector<InputEvent> merged(const Scene& scene, const std::vector<InputEvent>& recorded) {
  std::vector<InputEvent> keys = scene.keys;
  keys.insert(keys.end(), recorded.begin(), recorded.end());
  std::stable_sort(keys.begin(), keys.end(), [](const InputEvent& a, const InputEvent& b) { return std::tuple(a.time, a.player) < std::tuple(b.time, b.player); });
  return keys;
}

const Scene& shareable(const Scene& scene) {
  if (scene.world.field.goal_width > 0.0) throw SceneError("scene '" + scene.name + "' has goals (field.goal_width), and peers cannot yet bring scored pucks back: expected a scene without, such as arena");
  return scene;
}

BatController controller_of(const Scene& scene, std::uint32_t player) { return BatController(scene.bodies.bats[player].thrust); }

}  // namespace

SharedGame::SharedGame(const Scene& scene, const std::vector<InputEvent>& recorded) : scene_(shareable(scene)), keys_(merged(scene, recorded)), start_(scene) {
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

std::uint64_t SharedGame::hash(std::uint64_t world, double until) const {
  std::vector<BatController> players;
  std::vector<const BatController*> hands;
  for (std::uint32_t k = 0; k < start_.player_count(); ++k) players.push_back(controller_of(scene_, k));
  for (const InputEvent& event : keys_)
    if (event.time <= until) players[event.player].press(event.key, event.kind == InputKind::key_down);
  for (const BatController& player : players) hands.push_back(&player);
  return begun_game_hash(world, start_.entities(), hands, {}).value();
}

PlayedPart SharedGame::play(const Terms& terms, peer::PeerNumber number, peer::Mail& mail) const {
  const physics::World& whole = start_.world();
  const std::uint32_t body_count = whole.body_count();
  peer::Peer peer(whole.spec(), division(terms.peer_count), number, body_count, first_halo(terms.window));
  for (std::uint32_t body = 0; body < body_count; ++body) peer.consider(body, physics::Portion::state_in(whole, body));
  for (const peer::Key& key : thrusts()) peer.press_first(key);
  const auto window_count = static_cast<std::uint64_t>(std::max(1.0, std::ceil(terms.until / terms.window)));
  // The last window ends at `until`, the one that is prepared then, and never played, one window later.
  const auto end_of = [&](std::uint64_t k) { return k == window_count ? terms.until : k > window_count ? terms.until + terms.window : static_cast<double>(k) * terms.window; };
  peer.begin(end_of(1));
  for (std::uint64_t k = 1; k <= window_count; ++k) peer::play_window(peer, terms.peer_count, mail, end_of(k + 1));

  PlayedPart part{.counters = peer.counters(), .owned = peer.owned().size(), .ghosts = peer.ghosts().size(), .halo = peer.halo()};
  std::vector<peer::Arrivals> parts(terms.peer_count);
  parts[number] = peer::own_bodies(peer);
  const std::vector<std::uint8_t> bytes = written(parts[number]);
  for (peer::PeerNumber to = 0; to < terms.peer_count; ++to)
    if (to != number) mail.send(to, bytes), part.result_bytes += bytes.size();
  for (peer::PeerNumber from = 0; from < terms.peer_count; ++from)
    if (from != number && !read(mail.receive(from), parts[from])) throw peer::ProtocolError("peer " + std::to_string(from) + " sent what is no list of bodies");
  const auto world = peer::hash_of_whole(whole.spec(), body_count, parts);
  if (!world) throw peer::ProtocolError("not every body has one owner in the end");
  part.hash = hash(*world, terms.until);
  return part;
}

}  // namespace rink::game
