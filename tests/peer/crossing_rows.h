// Random scenes of rows that touch, struck at many places at one instant: joint impacts across many
// borders.
#pragma once

#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {

/// Rows that cross and touch each other and perhaps bats, hit from all sides at one instant by
/// strikers, who are as far from those at whom they aim as they get by then.
inline SharedScene crossing_rows(std::uint64_t number, double until) {
  Random random(31 * number + 7);
  static const double restitutions[] = {1.0, 1.0, 0.9, 0.5, 0.0};
  physics::WorldSpec spec = physics::test::rink_of(4.0, 2.0, restitutions[below(random, 5)],
                                                   0.2 * (below(random, 3) == 0), 1.0);
  if (below(random, 4) == 0) spec.puck_friction = 0.6;
  SharedScene scene{physics::World(spec), {}};
  physics::World& world = scene.world;
  const auto step = [&](std::uint32_t count) {
    return 0.0625 * (1 + below(random, count)) - 0.03125 * (below(random, 3) == 0);
  };
  std::vector<physics::BodyId> bats;
  for (std::uint32_t k = below(random, 2) * below(random, 6); k > 0; --k) {
    const double x = step(60), y = step(30), along = 0.03125 * (1 + below(random, 4)),
                 across = 0.03125 * (1 + below(random, 4));
    physics::BatSpec bat{.position = {x, y}, .half_extent = {along, across}, .mass = 3.0};
    if (world.is_free(bat.position, bat.half_extent)) bats.push_back(world.add(bat));
  }
  for (std::uint32_t k = 3 + below(random, 10); k > 0; --k) {
    const bool is_across = below(random, 2) == 0;
    const int length = 3 + static_cast<int>(below(random, is_across ? 20 : 50));
    const double x = step(60), y = step(30);
    add_row(world, {x, y}, is_across ? Vector2(0.0, 0.0625) : Vector2(0.0625, 0.0), length, 0.03125,
            {0.0, 0.0});
  }
  const double wait = uniform(random, 0.01, 0.06);
  const Vector2 ways[] = {{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}};
  for (std::uint32_t k = 2 + below(random, 8); k > 0; --k) {
    const physics::BodyId aim{below(random, world.body_count())};
    const double speed = 1.0 + 0.25 * below(random, 5);
    const Vector2 way = ways[below(random, 4)];
    physics::PuckSpec striker{.position = world.position(aim) - way * (0.0625 + speed * wait),
                              .velocity = way * speed,
                              .radius = 0.03125,
                              .mass = 0.5 + below(random, 2)};
    if (world.kind(aim) == physics::BodyKind::puck && world.velocity(aim).norm() == 0.0 &&
        world.is_free(striker.position, striker.radius))
      world.add(striker);
  }
  press_keys(scene, random, bats, 0.05, until);
  return scene;
}

}  // namespace rink::peer::test
