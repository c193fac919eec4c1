// A stranger's scene is checked before it is read; what is told of its bodies, before it is
// believed.
#include "game/net/client/hosted_scene.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/match/sight.h"
#include "game/model/scene_file.h"

namespace rink::game {
namespace {

// What a match may say without being no match: beyond, an engine that takes its word would have no
// end of impacts, or no next instant.
constexpr double fastest_told = 100.0;  ///< m/s
constexpr double latest_told = 1e9;     ///< s, as in scenes

/// Where a body is and how it moves, as of `time`.
ToldBody told_of(const MirroredEntity& entity, double time) {
  ToldBody body{.position = entity.position_at(time), .held = {}};
  if (entity.trajectory && !entity.trajectory->is_resting())
    body.velocity = entity.motion.at(std::max(time, entity.motion.time)).velocity;
  body.velocity = body.velocity.cwiseMax(-fastest_told).cwiseMin(fastest_told);
  for (const Key key : all_keys)
    body.held.set(key, (entity.input.held >> static_cast<unsigned>(key) & 1u) != 0);
  return body;
}

bool is_kind(const MirroredEntity& entity, physics::BodyKind kind) {
  return entity.in_scope && entity.is_placed &&
         entity.shape.kind == static_cast<std::uint8_t>(kind);
}

}  // namespace

/// Checked before it is read: a population of a stranger's could be of any size.
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

std::optional<ToldRink> HostedScene::told(const Mirror& mirror, const MirroredEntity* own) const {
  assert(scene_.has_value());
  const std::size_t bats = scene_->bodies.bats.size(), pucks = scene_->bodies.pucks.size();
  ToldRink told{.time = mirror.newest().time, .bats = std::vector<ToldBody>(bats), .pucks = {}};
  if (std::abs(told.time) > latest_told || add_bats(mirror, told) != bats ||
      add_pucks(mirror, told) != pucks)
    return std::nullopt;
  told.own_felt = own != nullptr ? own->input.count : 0;
  return told;
}

/// How many there are.
std::size_t HostedScene::add_bats(const Mirror& mirror, ToldRink& told) const {
  std::size_t count = 0;
  for (const MirroredEntity& entity : mirror.entities()) {
    if (!is_kind(entity, physics::BodyKind::bat) || entity.shape.team >= told.bats.size()) continue;
    told.bats[entity.shape.team] = told_of(entity, told.time);
    ++count;
  }
  return count;
}

/// How many there are. They have no numbers, but are registered in their order.
std::size_t HostedScene::add_pucks(const Mirror& mirror, ToldRink& told) const {
  std::vector<const MirroredEntity*> found;
  for (const MirroredEntity& entity : mirror.entities())
    if (is_kind(entity, physics::BodyKind::puck)) found.push_back(&entity);
  std::ranges::sort(found, {}, &MirroredEntity::object);
  for (const MirroredEntity* puck : found) {
    ToldBody body = told_of(*puck, told.time);
    const double x = body.position.x();
    body.is_in_play = x > 0.0 && x < scene_->world.field.length;
    told.pucks.push_back(body);
  }
  return found.size();
}

}  // namespace rink::game
