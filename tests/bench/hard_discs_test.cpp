// The minimal reference is right: the engine finds the same collisions at the same times.
#include "bench/reference/hard_discs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "game/physics/world.h"
#include "tests/physics/scenes.h"

namespace rink::bench {
namespace {

using physics::Event;
using physics::EventKind;
using physics::World;

HardDiscs reference_of(const World& world) {
  std::vector<HardDiscs::Disc> discs;
  for (physics::BodyId body; body.index < world.body_count(); ++body.index) {
    const physics::Motion m = world.motion(body);
    discs.push_back({m.position.x(), m.position.y(), m.velocity.x(), m.velocity.y(), m.time});
  }
  return HardDiscs(world.spec().field.length, world.radius({0}), discs);
}

TEST(HardDiscs, TwoMeetHeadOnAndReturnFromTheWalls) {
  const HardDiscs::Disc left{0.25, 0.5, 1.0, 0.0, 0.0}, right{0.75, 0.5, -1.0, 0.0, 0.0};
  HardDiscs discs(1.0, 0.05, {left, right});
  std::vector<HardDiscs::Collision> collisions;
  discs.advance(0.9, [&](const HardDiscs::Collision& c) { collisions.push_back(c); });
  ASSERT_EQ(collisions.size(), 1u);             // the next one comes at 1
  EXPECT_NEAR(collisions[0].time, 0.2, 1e-15);  // 0.5 - 2 radii apart, closing at 2
  EXPECT_NEAR(discs.disc(0).vx, 1.0, 1e-15);    // turned at 0.2, and at the wall 0.4 later
  EXPECT_NEAR(discs.disc(0).time, 0.6, 1e-15);
  EXPECT_EQ(discs.kinetic_energy(), 1.0);
}

TEST(HardDiscs, RefuseACellThatIsTooFull) {
  std::vector<HardDiscs::Disc> discs;
  for (int k = 0; k < 16; ++k) discs.push_back({0.1 + k % 4 * 0.03, 0.1 + k / 4 * 0.03, 0, 0, 0});
  EXPECT_THROW(HardDiscs(100.0, 0.01, discs), std::length_error);
  discs.pop_back();
  EXPECT_NO_THROW(HardDiscs(100.0, 0.01, discs));
}

TEST(HardDiscs, FindTheEnginesCollisionsInTheSameOrder) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const double side = physics::test::uniform(random, 0.6, 6.0);
    World world(physics::test::rink_of(side, side));
    physics::test::scatter_pucks(world, random, 2 + static_cast<int>(40.0 * side));
    HardDiscs discs = reference_of(world);
    const double energy = world.kinetic_energy();
    world.record_events(true);
    // Errors of rounding grow tenfold in a collision or two, so that few can be compared.
    while (world.counters().disc_impacts < 3u * world.body_count() / 2u && world.now() < 20.0)
      world.advance(world.now() + 0.01);
    std::vector<HardDiscs::Collision> found;
    discs.advance(world.now(), [&](const HardDiscs::Collision& c) { found.push_back(c); });
    std::size_t k = 0;
    for (const Event& event : world.events()) {
      if (event.kind != EventKind::puck_puck) continue;
      ASSERT_LT(k, found.size());
      ASSERT_EQ(std::minmax(event.body.index, event.other->index),
                std::minmax(found[k].low, found[k].high));
      ASSERT_NEAR(event.time, found[k].time, 1e-6);
      ++k;
    }
    EXPECT_EQ(k, found.size());
    EXPECT_NEAR(discs.kinetic_energy() / energy, 1.0, 1e-13);
    EXPECT_LT(discs.max_overlap(), 1e-12);
  }
}

}  // namespace
}  // namespace rink::bench
