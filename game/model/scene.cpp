// Scenes derived from scenes, by another seed or size, and the fingerprint of a scene.
#include "game/model/scene.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/model/state_hash.h"

namespace rink::game {
namespace {

using physics::BodyKind;

std::uint64_t placed_count(const Scene& scene, BodyKind kind) {
  return kind == BodyKind::bat ? scene.placed.bats.size() : scene.placed.pucks.size();
}

std::uint64_t count_of(const Scene& scene, BodyKind kind) {
  std::uint64_t total = placed_count(scene, kind);
  for (const Population& population : scene.populations)
    total += population.kind == kind ? population.count : 0;
  return total;
}

/// Refuses numbers of pucks or bats that the scene's populations cannot give.
void require_reachable(const Scene& scene, BodyKind kind, std::uint64_t wanted) {
  const std::string name = kind == BodyKind::bat ? "bats" : "pucks";
  const std::uint64_t placed = placed_count(scene, kind), total = count_of(scene, kind),
                      least = std::max<std::uint64_t>(placed, 1);
  if (total == placed)
    throw SceneError("the scene " + scene.name + " has no population of " + name +
                     ", so it cannot have " + std::to_string(wanted) + " " + name + " instead of " +
                     std::to_string(total));
  if (wanted < least)
    throw SceneError("the scene " + scene.name + " cannot have " + std::to_string(wanted) + " " +
                     name + ": expected at least " + std::to_string(least));
}

/// Removes scripted keys of players whose bats are gone.
void drop_keys_of_absent(Scene& scene, std::uint32_t bat_count) {
  std::erase_if(scene.keys,
                [bat_count](const InputEvent& event) { return event.player >= bat_count; });
}

void scale_places(Bodies& bodies, double factor) {
  assert(factor > 0.0);
  for (Puck& puck : bodies.pucks) puck.body.position *= factor;
  for (Bat& bat : bodies.bats) bat.body.position *= factor;
  for (Post& post : bodies.posts) post.body.position *= factor;
}

/// Shares `wanted` bodies among the populations of their kind in proportion; each gets what its
/// cumulative share rounds to, so the sum is exact.
void share(std::vector<Population>& populations, BodyKind kind, std::uint64_t wanted) {
  std::uint64_t total = 0, before = 0, given = 0;
  for (const Population& population : populations)
    total += population.kind == kind ? population.count : 0;
  assert(total > 0 && "somebody must be there to share among");
  for (Population& population : populations) {
    if (population.kind != kind) continue;
    before += population.count;
    const std::uint64_t until_here = (2 * wanted * before + total) / (2 * total);
    assert(until_here >= given);
    population.count = static_cast<std::uint32_t>(until_here - given);
    given = until_here;
  }
  assert(before == total && given == wanted);
}

/// A scene without friction has the fingerprint that it had before there was any.
void add_friction(StateHash& hash, const physics::WorldSpec& world) {
  if (world.puck_friction > 0.0) hash.add(std::uint64_t{1}), hash.add(world.puck_friction);
  if (!world.surface_friction) return;
  hash.add(std::uint64_t{2});
  const std::size_t count = world.restitution.material_count();
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b <= a; ++b)
      for (const physics::PairTable* table : {&world.surface_friction->coefficient,
                                              static_cast<const physics::PairTable*>(
                                                  &world.surface_friction->tangential_restitution)})
        hash.add(
            (*table)(static_cast<physics::MaterialId>(a), static_cast<physics::MaterialId>(b)));
}

void add_world(StateHash& hash, const physics::WorldSpec& world) {
  const physics::Field& field = world.field;
  for (const double number :
       {field.length, field.width, field.goal_width, world.puck_drag, world.bat_drag})
    hash.add(number);
  hash.add(std::uint64_t{field.wall});
  hash.add(std::uint64_t{field.bats_keep_to_half});
  const std::size_t count = world.restitution.material_count();
  hash.add(std::uint64_t{count});
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b <= a; ++b)
      hash.add(world.restitution(static_cast<physics::MaterialId>(a),
                                 static_cast<physics::MaterialId>(b)));
  add_friction(hash, world);
}

void add_bodies(StateHash& hash, const Bodies& bodies) {
  for (const Post& post : bodies.posts)
    hash.add(post.body.position), hash.add(post.body.radius),
        hash.add(std::uint64_t{post.body.material});
  hash.add(std::uint64_t{bodies.posts.size()});
  for (const Bat& bat : bodies.bats) {
    for (const Vector2& vector : {bat.body.position, bat.body.velocity, bat.body.half_extent})
      hash.add(vector);
    for (const double number : {bat.body.mass, bat.thrust}) hash.add(number);
    for (const auto number :
         {static_cast<unsigned>(bat.body.material), static_cast<unsigned>(bat.body.half),
          static_cast<unsigned>(bat.team)})
      hash.add(std::uint64_t{number});
  }
  hash.add(std::uint64_t{bodies.bats.size()});
  for (const Puck& puck : bodies.pucks) {
    for (const Vector2& vector : {puck.body.position, puck.body.velocity}) hash.add(vector);
    for (const double number : {puck.body.radius, puck.body.mass}) hash.add(number);
    hash.add(std::uint64_t{puck.body.material});
    if (puck.body.spin != 0.0) hash.add(puck.body.spin);
  }
  hash.add(std::uint64_t{bodies.pucks.size()});
}

}  // namespace

Scene with_seed(Scene scene, std::uint64_t seed) {
  scene.seed = seed;
  populate(scene);
  return scene;
}

Scene scaled_to_bats(Scene scene, std::uint32_t bat_count) {
  const std::uint64_t total = count_of(scene, BodyKind::bat), placed = scene.placed.bats.size();
  if (total == bat_count) return scene;
  require_reachable(scene, BodyKind::bat, bat_count);
  const double area_factor = static_cast<double>(bat_count) / static_cast<double>(total),
               factor = std::sqrt(area_factor);
  scene.world.field.length *= factor;
  scene.world.field.width *= factor;
  scene.world.field.goal_width *= factor;
  scale_places(scene.placed, factor);
  for (Population& population : scene.populations)
    if (population.kind != BodyKind::bat)
      population.count = static_cast<std::uint32_t>(std::llround(population.count * area_factor));
  assert(placed <= bat_count && factor > 0.0);
  share(scene.populations, BodyKind::bat, bat_count - placed);
  drop_keys_of_absent(scene, bat_count);
  populate(scene);
  assert(scene.bodies.bats.size() == bat_count);
  return scene;
}

Scene with_count(Scene scene, BodyKind kind, std::uint32_t count) {
  assert(kind != BodyKind::post && "no scene is asked for a number of posts");
  if (count_of(scene, kind) == count) return scene;
  require_reachable(scene, kind, count);
  share(scene.populations, kind, count - placed_count(scene, kind));
  if (kind == BodyKind::bat) drop_keys_of_absent(scene, count);
  populate(scene);
  assert((kind == BodyKind::bat ? scene.bodies.bats.size() : scene.bodies.pucks.size()) == count);
  return scene;
}

std::uint64_t fingerprint(const Scene& scene) {
  StateHash hash;
  add_world(hash, scene.world);
  add_bodies(hash, scene.bodies);
  hash.add(std::uint64_t{scene.rules.goals_to_win.value_or(0)});
  hash.add(scene.rules.face_off_delay);
  hash.add(scene.rules.face_off_distance);
  if (scene.rules.possession_s > 0.0)
    hash.add(std::uint64_t{4}), hash.add(scene.rules.possession_s);
  if (scene.network_grid > 0.0) hash.add(std::uint64_t{3}), hash.add(scene.network_grid);
  return hash.value();
}

}  // namespace rink::game
