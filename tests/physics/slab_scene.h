// Scenes for windows that are played by tiles, and what must be as the plain loop has it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "game/physics/world.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {

/// Pucks on a lattice at some packing, jittered, of different masses; now and then with posts, or
/// with walls or pucks that lose
/// energy, some of them all that they can, with drag, and with books of energy.
struct SlabScene {
  explicit SlabScene(std::uint64_t seed) : random(seed) {
    const int columns = 8 + static_cast<int>(random() % 28);
    const double packing = uniform(random, 0.03, 0.72),
                 spacing = std::sqrt(3.141592653589793 * 0.04 * 0.04 / packing);
    spec = rink_of(columns * spacing, columns * spacing);
    spec.accounts_energy = seed % 3 == 0;
    if (random() % 8 == 0) spec.restitution = RestitutionTable(1, uniform(random, 0.5, 1.0));
    else if (seed % 5 == 2) spec.restitution = RestitutionTable(1, uniform(random, 0.05, 1.0));
    if (seed % 11 == 4) spec.restitution = RestitutionTable(1, 0.0);
    if (seed % 7 == 3) spec.puck_drag = uniform(random, 0.05, 2.0);
    const bool is_uneven = random() % 2 == 0;
    const double jitter = std::max(0.0, 0.49 * (spacing - 0.0801));
    const double fast = random() % 4 == 0 ? 20.0 : 2.0;
    for (int k = 0; k < columns * columns; ++k) {
      PuckSpec puck;
      puck.position = {(k % columns + 0.5) * spacing + uniform(random, -jitter, jitter),
                       (k / columns + 0.5) * spacing + uniform(random, -jitter, jitter)};
      const double angle = uniform(random, 0.0, 6.283185307179586),
                   speed = random() % 16 == 0 ? fast : uniform(random, 0.0, 2.0);
      puck.velocity = {speed * std::cos(angle), speed * std::sin(angle)};
      if (random() % 10 == 0) puck.velocity = {0.0, 0.0};
      puck.mass = is_uneven ? std::pow(10.0, uniform(random, -1.0, 1.0)) : 1.0;
      pucks.push_back(puck);
    }
    posts = random() % 4 == 0 ? 5 : 0;
    duration = uniform(random, 0.2, 1.5) * std::sqrt(0.05 / packing) * (packing > 0.4 ? 0.2 : 1.0);
  }

  World world(QueuePolicy queue, const std::optional<SlabPlan>& plan = std::nullopt) const {
    WorldSpec with = spec;
    with.queue = queue, with.slabs = plan;
    World world(with);
    world.record_events(true);
    for (const PuckSpec& puck : pucks) world.add(puck);
    std::mt19937_64 places(7);
    scatter_posts(world, places, posts);
    return world;
  }

  std::mt19937_64 random;
  WorldSpec spec;
  std::vector<PuckSpec> pucks;
  int posts = 0;
  double duration = 0.0;
};

/// The same pucks in a match: goals, and bats among them of which most are long enough to stand in
/// many cells of the grid; some rest, and some coast.
struct MatchScene : SlabScene {
  explicit MatchScene(std::uint64_t match_seed) : SlabScene(match_seed), seed(match_seed) {
    spec.field.goal_width = 0.3 * spec.field.width;
    posts = 3;
    duration *= 2.0;
  }

  World world(QueuePolicy queue, const std::optional<SlabPlan>& plan = std::nullopt) const {
    WorldSpec with = spec;
    with.queue = queue, with.slabs = plan;
    World world(with);
    world.record_events(true);
    std::mt19937_64 places(seed);
    const double side = spec.field.length;
    for (int bats = 1 + static_cast<int>(seed % 6); bats > 0; --bats) {
      BatSpec bat;
      bat.half_extent = {uniform(places, 0.03, 0.3), uniform(places, 0.03, 0.3)};
      bat.position = {uniform(places, 0.3, side - 0.3), uniform(places, 0.3, side - 0.3)};
      if (bats % 3 != 0) bat.velocity = {uniform(places, -1.0, 1.0), uniform(places, -1.0, 1.0)};
      bat.mass = 3.0;
      if (world.is_free(bat.position, bat.half_extent)) world.add(bat);
    }
    scatter_posts(world, places, posts);
    for (const PuckSpec& puck : pucks)
      if (world.is_free(puck.position, puck.radius)) world.add(puck);
    return world;
  }

  std::uint64_t seed;
};

inline void expect_same(const World& slabs, const World& plain) {
  ASSERT_EQ(slabs.hash(), plain.hash());
  const Counters &a = slabs.counters(), &b = plain.counters();
  for (std::size_t kind = 0; kind < event_kind_names.size(); ++kind)
    EXPECT_EQ(a.*counter_of_kind[kind], b.*counter_of_kind[kind]) << event_kind_names[kind];
  EXPECT_EQ(a.joint_impacts, b.joint_impacts);
  EXPECT_EQ(a.bodies_touched, b.bodies_touched);
  EXPECT_EQ(slabs.dissipated(), plain.dissipated());
  EXPECT_EQ(slabs.work_of_thrust(), plain.work_of_thrust());
  EXPECT_EQ(slabs.energy_introduced(), plain.energy_introduced());
  ASSERT_EQ(slabs.events().size(), plain.events().size());
  for (std::size_t k = 0; k < slabs.events().size(); ++k) {
    const Event &x = slabs.events()[k], &y = plain.events()[k];
    ASSERT_TRUE(x.time == y.time && x.kind == y.kind && x.body == y.body && x.other == y.other)
        << k << " at " << x.time << " and " << y.time;
  }
}

inline SlabPlan small_tiles(int cells, int radius, double window) {
  return {.tile_cells = cells,
          .block_radius = radius,
          .window = window,
          .bodies_min = 0,
          .last_pass_max = 1.0};
}

}  // namespace rink::physics::test
