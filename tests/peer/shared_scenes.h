// Random scenes to be shared among peers: everything that is hard about a border, with divisions
// and keys.
#pragma once

#include <algorithm>
#include <cmath>

#include "game/peer/division.h"
#include "game/peer/messages.h"
#include "tests/physics/scenes.h"

namespace rink::peer::test {

using physics::test::uniform;
using Random = std::mt19937_64;

/// To be divided without a scene.
inline const physics::Field field = physics::test::rink_of(4.0, 2.0).field;

inline std::uint32_t below(Random& random, std::uint32_t count) {
  return static_cast<std::uint32_t>(random() % count);
}

/// Rectangles by cuts at random places, or through the middle, as many as there are peers or more;
/// each peer has one at least.
inline Division random_division(const physics::Field& field, Random& random,
                                PeerNumber peer_count) {
  std::vector<Zone> zones{{{0.0, 0.0, field.length, field.width}, 0}};
  const std::size_t count = peer_count + below(random, 3);
  while (zones.size() < count) {
    const std::size_t which = below(random, static_cast<std::uint32_t>(zones.size()));
    const Box box = zones[which].box;
    const bool is_across = below(random, 2) == 0;
    const double low = is_across ? box.low_x : box.low_y,
                 high = is_across ? box.high_x : box.high_y;
    const double share = below(random, 3) == 0 ? 0.5 : uniform(random, 0.1, 0.9);
    const double cut = low + share * (high - low);
    if (!(cut > low && cut < high) || high - low < 0.05) continue;
    Box one = box, two = box;
    (is_across ? one.high_x : one.high_y) = (is_across ? two.low_x : two.low_y) = cut;
    zones[which].box = one;
    zones.push_back({two, 0});
  }
  for (std::size_t k = 0; k < zones.size(); ++k)
    zones[k].peer = k < peer_count ? static_cast<PeerNumber>(k) : below(random, peer_count);
  return Division(field, std::move(zones), peer_count);
}

struct SharedScene {
  physics::World world;
  std::vector<Key> keys;
};

inline void add_row(physics::World& world, const Vector2& first, const Vector2& step, int count,
                    double radius, const Vector2& velocity) {
  for (int k = 0; k < count; ++k) {
    physics::PuckSpec puck;
    puck.position = first + step * k;
    puck.radius = radius;
    if (k == 0) puck.velocity = velocity;
    if (world.is_free(puck.position, puck.radius)) world.add(puck);
  }
}

/// Cradles along and across: rows that touch to the bit, hit by a fast one.
inline void add_cradles(physics::World& world, Random& random, int count) {
  const double radius = 0.03125;
  for (int k = 0; k < count; ++k) {
    const bool is_across = below(random, 2) == 0;
    const Vector2 step = is_across ? Vector2(0.0, 2.0 * radius) : Vector2(2.0 * radius, 0.0);
    const int length = 4 + static_cast<int>(below(random, is_across ? 10 : 20));
    const double x = 0.0625 * std::floor(uniform(random, 4.0, 28.0)),
                 y = 0.0625 * std::floor(uniform(random, 4.0, 12.0));
    add_row(world, {x, y}, step, length, radius, {0.0, 0.0});
    physics::PuckSpec striker;
    striker.radius = radius;
    striker.position = Vector2(x, y) - step * 3.0;
    striker.velocity = step.normalized() * 2.0;
    if (world.is_free(striker.position, radius)) world.add(striker);
  }
}

/// A triangle of pucks that touch, hit from the left.
inline void add_rack(physics::World& world, Random& random, int rows) {
  const double reach = 0.0625 + 4e-16, x = uniform(random, 0.5, 2.5), y = uniform(random, 0.6, 1.4);
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i <= row; ++i) {
      physics::PuckSpec puck{
          .position = {x + 0.5 * std::sqrt(3.0) * reach * row, y + reach * (i - 0.5 * row)},
          .radius = 0.03125};
      if (world.is_free(puck.position, puck.radius)) world.add(puck);
    }
  physics::PuckSpec striker{
      .position = {x - 0.2, y}, .velocity = {4.0, 0.0}, .radius = 0.03125, .mass = 2.0};
  if (world.is_free(striker.position, striker.radius)) world.add(striker);
}

/// Equal pucks on a square grid, each with one of four velocities: meetings in numbers at one
/// instant.
inline void add_grid_of_ties(physics::World& world, Random& random) {
  const int columns = 4 + static_cast<int>(below(random, 8)),
            rows = 3 + static_cast<int>(below(random, 4));
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const std::uint32_t way = below(random, 4);
      physics::PuckSpec puck{.position = {0.25 + 0.25 * i, 0.25 + 0.25 * j}, .radius = 0.03125};
      puck.velocity = way == 0   ? Vector2(1.0, 0.0)
                      : way == 1 ? Vector2(-1.0, 0.0)
                      : way == 2 ? Vector2(0.0, 1.0)
                                 : Vector2(0.0, -1.0);
      world.add(puck);
    }
}

/// Pucks on a lattice, as dense as `packing`, a little out of place.
inline void add_gas(physics::World& world, Random& random, double packing, double speed_max,
                    double mass_max) {
  const double radius = 0.04, step = std::sqrt(3.141592653589793 * radius * radius / packing),
               room = 0.5 * step - radius;
  const physics::Field& field = world.spec().field;
  for (double y = 0.5 * step; y <= field.width - 0.5 * step; y += step)
    for (double x = 0.5 * step; x <= field.length - 0.5 * step; x += step) {
      physics::PuckSpec puck;
      const double dx = uniform(random, -0.9, 0.9), dy = uniform(random, -0.9, 0.9),
                   vx = uniform(random, -1.0, 1.0), vy = uniform(random, -1.0, 1.0);
      const double mass = std::pow(mass_max, uniform(random, 0.0, 1.0));
      puck.position = {x + dx * room, y + dy * room};
      puck.velocity = Vector2(vx, vy) * speed_max;
      puck.mass = mass;
      if (world.is_free(puck.position, puck.radius)) world.add(puck);
    }
}

inline void add_bullets(physics::World& world, Random& random, int count) {
  for (int k = 0; k < count; ++k) {
    const double x = uniform(random, 0.1, 3.9), y = uniform(random, 0.1, 1.9),
                 angle = uniform(random, 0.0, 6.283185307179586);
    physics::PuckSpec puck{.position = {x, y},
                           .velocity = Vector2(std::cos(angle), std::sin(angle)) * 60.0,
                           .radius = 0.02,
                           .mass = 1000.0};
    if (world.is_free(puck.position, puck.radius)) world.add(puck);
  }
}

/// Bats that fill a third of the field, so that keys press them to each other in groups, wherever
/// borders are.
inline std::vector<physics::BodyId> add_throng(physics::World& world, Random& random) {
  std::vector<physics::BodyId> bats;
  for (int tries = 0; bats.size() < 36 && tries < 400; ++tries) {
    const double x = uniform(random, 0.2, 3.8), y = uniform(random, 0.2, 1.8),
                 along = uniform(random, 0.06, 0.2), across = uniform(random, 0.06, 0.2);
    physics::BatSpec bat{.position = {x, y}, .half_extent = {along, across}, .mass = 3.0};
    if (world.is_free(bat.position, bat.half_extent)) bats.push_back(world.add(bat));
  }
  return bats;
}

inline void press_keys(SharedScene& scene, Random& random, const std::vector<physics::BodyId>& bats,
                       double interval, double until) {
  for (double time = 0.0; !bats.empty() && time < until;) {
    for (std::uint32_t at_once = 1 + below(random, 2) * below(random, 4); at_once > 0; --at_once) {
      const std::uint32_t bat = bats[random() % bats.size()].index;
      const double x = static_cast<double>(below(random, 3)) - 1.0,
                   y = static_cast<double>(below(random, 3)) - 1.0;
      scene.keys.push_back({time, bat, Vector2(x, y) * 6.0});
    }
    const double wait = uniform(random, 0.0, 2.0 * interval);
    time += wait;
  }
}

/// A lattice of pucks, a little out of place, between two bats that drive at each other, now and
/// then askew.
inline void add_squeezed_heap(SharedScene& scene, Random& random, double until) {
  physics::World& world = scene.world;
  const physics::Field& field = world.spec().field;
  const int columns = 3 + static_cast<int>(below(random, 6)),
            rows = 3 + static_cast<int>(below(random, 5));
  const double step = 0.0802, length = step * columns, height = step * rows;
  const double x = uniform(random, 0.1, field.length - length - 0.1),
               y = uniform(random, 0.02, field.width - height - 0.02);
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      physics::PuckSpec puck{.position = {x + step * (i + 0.5), y + step * (j + 0.5)},
                             .mass = uniform(random, 0.1, 0.3)};
      puck.position += Vector2(uniform(random, 0.0, 1e-4), uniform(random, 0.0, 1e-4));
      if (world.is_free(puck.position, puck.radius)) world.add(puck);
    }
  for (const double side : {-1.0, 1.0}) {
    physics::BatSpec bat{
        .position = {side < 0.0 ? x - 0.041 : x + length + 0.041, y + 0.5 * height},
        .half_extent = {0.04, 0.45 * height},
        .mass = 3.0};
    if (!world.is_free(bat.position, bat.half_extent)) continue;
    const std::uint32_t number = world.add(bat).index;
    scene.keys.push_back({0.0, number, Vector2(-side, 0.0) * 12.0});
    for (double time = uniform(random, 0.05, 0.3); time < until;
         time += uniform(random, 0.05, 0.3)) {
      const double along = uniform(random, 6.0, 12.0), across = uniform(random, -6.0, 6.0);
      scene.keys.push_back({time, number, Vector2(-side * along, across)});
    }
  }
}

/// Heaps of pucks that bats press together, wherever borders are, and some that fly about.
inline SharedScene pressed_scene(std::uint64_t number, double until) {
  Random random(number + 1);
  const double restitutions[] = {0.5, 0.0, 0.9};
  physics::WorldSpec spec =
      physics::test::rink_of(4.0, 2.0, restitutions[number % 3], 0.2 * below(random, 2), 1.0);
  if (number % 5 == 4) spec.puck_friction = 0.6;
  SharedScene scene{physics::World(spec), {}};
  for (int heap = 0; heap < 6; ++heap) add_squeezed_heap(scene, random, until);
  physics::test::scatter_pucks(scene.world, random, 20, 0.05, 2.0);
  return scene;
}

/// Numbers of shared scenes from here on are those of pressed ones.
inline constexpr std::uint64_t first_pressed_scene = 1'000'000;

/// Scene `number` of many. `until` [s] is how long its keys go on.
inline SharedScene shared_scene(std::uint64_t number, double until) {
  if (number >= first_pressed_scene) return pressed_scene(number - first_pressed_scene, until);
  Random random(number + 1);
  static const double restitutions[] = {1.0, 1.0, 0.9, 0.5, 0.0, 0.7};
  const std::uint32_t kind = static_cast<std::uint32_t>(number % 10);
  const double restitution = kind < 4 ? 1.0 : restitutions[below(random, 6)];
  physics::WorldSpec spec = physics::test::rink_of(
      4.0, 2.0, restitution, kind == 4 || kind >= 6 ? 0.2 * below(random, 2) : 0.0, 1.0);
  if (kind >= 6 && below(random, 3) == 0) spec.field.goal_width = 0.5;
  if (kind == 8) spec.puck_friction = 0.6;
  if (kind == 9)
    spec.surface_friction =
        physics::SurfaceFriction{physics::PairTable(1, 0.2), physics::RestitutionTable(1, 0.3)};
  SharedScene scene{physics::World(spec), {}};
  physics::World& world = scene.world;
  std::vector<physics::BodyId> bats;
  const bool is_throng = number % 20 == 17;
  switch (kind) {
    case 0:
      add_gas(world, random, number % 30 == 0 ? 0.63 : uniform(random, 0.02, 0.6), 2.0, 1.0);
      break;  // 0.63 of the lattice is 0.6 of the field
    case 1:
      add_cradles(world, random, 4);
      break;
    case 2:
      add_rack(world, random, 5), add_rack(world, random, 4);
      break;
    case 3:
      add_grid_of_ties(world, random);
      break;
    case 4:
      add_gas(world, random, uniform(random, 0.02, 0.6), 2.0, 1000.0);
      break;
    case 5:
      add_bullets(world, random, 3), add_gas(world, random, 0.1, 1.0, 1.0);
      break;
    default:
      if (kind == 6) add_rack(world, random, 4);
      physics::test::scatter_posts(world, random, 2);
      bats = is_throng ? add_throng(world, random) : physics::test::scatter_bats(world, random, 6);
      physics::test::scatter_pucks(world, random, 40, 0.05, 2.0);
      press_keys(scene, random, bats, is_throng ? 0.02 : kind == 7 ? 0.5 : 0.05, until);
  }
  return scene;
}

}  // namespace rink::peer::test
