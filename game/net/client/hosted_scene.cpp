// Checks a host's scene before reading it, and states of its bodies before using them, since the
// host is not trusted.
#include "game/net/client/hosted_scene.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/control/bat_controller.h"
#include "game/match/sight.h"
#include "game/model/scene_file.h"

namespace rink::game {
namespace {

// Limits of received states: beyond them an engine would have endless impacts, or no next instant.
constexpr double fastest_received = 100.0;  ///< m/s
constexpr double latest_received = 1e9;     ///< s, as in scenes

/// Where a body is and how it moves, as of `time`.
ReceivedBody received_body(const EntityReplica& entity, double time) {
  ReceivedBody body{.position = entity.position_at(time), .held = {}};
  if (entity.trajectory && !entity.trajectory->is_resting())
    body.velocity = entity.motion.at(std::max(time, entity.motion.time)).velocity;
  body.velocity = body.velocity.cwiseMax(-fastest_received).cwiseMin(fastest_received);
  for (const Key key : all_keys)
    body.held.set(key, (entity.input.held >> static_cast<unsigned>(key) & 1u) != 0);
  return body;
}

/// The steps along one axis of a push that together with keys that drive it along `way` (-1, 0 or
/// 1) gives `acceleration` [m/s^2].
std::int8_t steps_along(double acceleration, double thrust, double way) {
  if (acceleration == 0.0 || !(thrust > 0.0)) return 0;
  const double share = std::clamp(acceleration / thrust, -1.0, 1.0) - way;
  return static_cast<std::int8_t>(std::lround(std::clamp(share, -1.0, 1.0) * Push::whole));
}

/// What a bat's motion shows of its player's push.
Push push_of(const EntityReplica& entity, const KeysHeld& held) {
  if (!entity.trajectory || entity.trajectory->is_resting()) return {};
  const Vector2 way = direction(held), acceleration = entity.trajectory->acceleration;
  const auto thrust = static_cast<double>(entity.shape.thrust);
  return {steps_along(acceleration.x(), thrust, way.x()),
          steps_along(acceleration.y(), thrust, way.y())};
}

/// Numbers that a trajectory may hold lead beyond all numbers after a while.
bool is_anywhere(const ReceivedBody& body) {
  return body.position.allFinite() && body.velocity.allFinite();
}

bool is_kind(const EntityReplica& entity, physics::BodyKind kind) {
  return entity.in_scope && entity.is_placed &&
         entity.shape.kind == static_cast<std::uint8_t>(kind);
}

}  // namespace

/// The text is checked before it is read, since a population could be of any size.
std::optional<std::string> HostedScene::read(const std::string& text) {
  try {
    if (text.find("population") != std::string::npos)
      throw SceneError("a match has no populations");
    Scene scene = parse_scene(text, "match.toml");
    if (const auto objection = match_objection(scene)) throw SceneError(*objection);
    things_ = sight_of(scene).things;
    scene_ = std::move(scene);
  } catch (const SceneError& error) {
    return error.what();
  }
  return std::nullopt;
}

std::optional<ReceivedRink> HostedScene::received(const ReplicaSet& replicas,
                                                  const EntityReplica* own) const {
  assert(scene_.has_value());
  const std::size_t bats = scene_->bodies.bats.size(), pucks = scene_->bodies.pucks.size();
  ReceivedRink received{
      .time = replicas.newest().time, .bats = std::vector<ReceivedBody>(bats), .pucks = {}};
  if (std::abs(received.time) > latest_received || add_bats(replicas, received) != bats ||
      add_pucks(replicas, received) != pucks)
    return std::nullopt;
  received.own_felt = own != nullptr ? own->input.count : 0;
  return received;
}

/// Returns how many there are.
std::size_t HostedScene::add_bats(const ReplicaSet& replicas, ReceivedRink& received) const {
  std::size_t count = 0;
  for (const EntityReplica& entity : replicas.entities()) {
    if (!is_kind(entity, physics::BodyKind::bat) || entity.shape.team >= received.bats.size())
      continue;
    ReceivedBody& bat = received.bats[entity.shape.team];
    bat = received_body(entity, received.time);
    bat.push = push_of(entity, bat.held);
    if (is_anywhere(bat)) ++count;
  }
  return count;
}

/// Returns how many there are. They have no numbers, but are registered in their order.
std::size_t HostedScene::add_pucks(const ReplicaSet& replicas, ReceivedRink& received) const {
  std::vector<const EntityReplica*> found;
  for (const EntityReplica& entity : replicas.entities())
    if (is_kind(entity, physics::BodyKind::puck)) found.push_back(&entity);
  std::ranges::sort(found, {}, &EntityReplica::object);
  for (const EntityReplica* puck : found) {
    ReceivedBody body = received_body(*puck, received.time);
    const double x = body.position.x();
    body.is_in_play = x > 0.0 && x < scene_->world.field.length;
    if (is_anywhere(body)) received.pucks.push_back(body);
  }
  return received.pucks.size();
}

}  // namespace rink::game
