// Bodies that start in overlap: those that approach collide at once, none is ever moved, none gains
// energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

WorldSpec rink_with_overlap(double length, double width, double restitution = 1.0,
                            double drag = 0.0) {
  WorldSpec spec = rink_of(length, width, restitution, drag, drag);
  spec.allow_overlap = true;
  return spec;
}

TEST(Overlap, DiscsThatApproachCollideNowAndDiscsThatPartNever) {
  for (const double direction : {1.0, -1.0}) {
    World world(rink_with_overlap(4.0, 2.0));
    const BodyId a = world.add(PuckSpec{.position = {2.0, 1.0}, .velocity = {direction, 0.0}}),
                 b = world.add(PuckSpec{.position = {2.05, 1.0}, .velocity = {-direction, 0.0}});
    EXPECT_NEAR(world.max_overlap(), 0.03, 1e-15);
    world.advance(0.0);
    EXPECT_EQ(world.position(a), Vector2(2.0, 1.0));
    EXPECT_EQ(world.position(b), Vector2(2.05, 1.0));
    EXPECT_EQ(world.velocity(a).x(), -1.0);
    EXPECT_EQ(world.velocity(b).x(), 1.0);
    EXPECT_EQ(world.counters().disc_impacts, direction > 0.0 ? 1u : 0u);
    world.advance(0.5);
    EXPECT_EQ(world.counters().disc_impacts, direction > 0.0 ? 1u : 0u);
    EXPECT_EQ(world.max_overlap(), 0.0);
  }
}

TEST(Overlap, DiscsWithOneCentrePartFreely) {
  World world(rink_with_overlap(4.0, 2.0));
  const BodyId a = world.add(PuckSpec{.position = {2.0, 1.0}, .velocity = {1.0, 0.0}});
  world.add(PuckSpec{.position = {2.0, 1.0}});
  world.advance(1.0);
  EXPECT_EQ(world.position(a), Vector2(3.0, 1.0));
  EXPECT_EQ(world.counters().events(), 0u);
}

/// A gas in which 1 % of the discs lie on another.
struct OverlappingGas {
  World world;
  double deepest, energy;

  OverlappingGas(double restitution, double drag, std::uint64_t seed)
      : world(rink_with_overlap(8.0, 8.0, restitution, drag)) {
    std::mt19937_64 random(seed);
    scatter_posts(world, random, 4);
    const std::vector<BodyId> pucks = scatter_pucks(world, random, 1980, 0.5, 2.0);
    EXPECT_EQ(pucks.size(), 1980u);
    for (int i = 0; i < 20; ++i) {
      const double angle = uniform(random, 0.0, 6.283185307179586),
                   apart = uniform(random, 0.0, 0.08);
      PuckSpec puck;
      puck.position = world.position(pucks[static_cast<std::size_t>(99 * i)]) +
                      Vector2(apart * std::cos(angle), apart * std::sin(angle));
      puck.position = puck.position.cwiseMax(Vector2(0.04, 0.04)).cwiseMin(Vector2(7.96, 7.96));
      puck.velocity = {uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0)};
      world.add(puck);
    }
    deepest = world.max_overlap();
    energy = world.kinetic_energy();
  }
};

TEST(Overlap, OfOnePercentOfAGasNeitherHangsNorGrowsNorGainsEnergy) {
  for (const double restitution : {1.0, 0.9, 0.5, 0.0})
    for (const double drag : {0.0, 0.3}) {
      SCOPED_TRACE(testing::Message() << "restitution " << restitution << " drag " << drag);
      OverlappingGas gas(restitution, drag, 5);
      EXPECT_GT(gas.deepest, 0.02);
      double deepest = gas.deepest, energy = gas.energy;
      std::vector<Vector2> before;
      for (BodyId body; body.index < gas.world.body_count(); ++body.index)
        before.push_back(gas.world.position(body));
      gas.world.advance(0.0);
      for (BodyId body; body.index < gas.world.body_count(); ++body.index)
        ASSERT_EQ(gas.world.position(body), before[body.index]);
      for (int step = 1; step <= 20; ++step) {
        gas.world.advance(0.05 * step);
        const double overlap = gas.world.max_overlap(), left = gas.world.kinetic_energy();
        ASSERT_LE(overlap, deepest + 1e-12) << step;
        ASSERT_LE(left, energy * (1.0 + 1e-12)) << step;
        deepest = overlap, energy = left;
      }
      if (restitution == 1.0 && drag == 0.0) {
        EXPECT_NEAR(energy, gas.energy, 1e-11 * gas.energy);
        EXPECT_EQ(deepest, 0.0);
      }
      EXPECT_LT(gas.world.counters().events(), 2000u * 1000u);
    }
}

TEST(Overlap, OfBatsPucksAndPostsUnderKeysLetsTimeAdvance) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    World world(rink_with_overlap(2.0, 1.0, seed % 3 == 0 ? 1.0 : seed % 3 == 1 ? 0.5 : 0.0, 0.5));
    std::mt19937_64 random(seed);
    std::vector<BodyId> bats;
    const auto anywhere = [&] {
      return Vector2(uniform(random, 0.2, 1.8), uniform(random, 0.2, 0.8));
    };
    for (int i = 0; i < 3; ++i) world.add(PostSpec{.position = anywhere(), .radius = 0.06});
    for (int i = 0; i < 4; ++i)
      bats.push_back(
          world.add(BatSpec{.position = anywhere(), .half_extent = {0.04, 0.1}, .mass = 2.0}));
    for (int i = 0; i < 30; ++i)
      world.add(PuckSpec{.position = anywhere(),
                         .velocity = {uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)},
                         .mass = 0.3});
    EXPECT_GT(world.max_overlap(), 0.01);
    RandomKeys keys{std::mt19937_64(seed), 0.1};
    keys.play(world, bats, 3.0);
    EXPECT_EQ(world.now(), 3.0);
    EXPECT_LT(world.counters().events(), 3.0 * 1e4 * world.body_count());
    for (BodyId body; body.index < world.body_count(); ++body.index) {
      ASSERT_TRUE(world.position(body).allFinite());
      EXPECT_GE(world.position(body).minCoeff(), 0.0);
      EXPECT_LE(world.position(body).x(), 2.0);
      EXPECT_LE(world.position(body).y(), 1.0);
    }
  }
}

}  // namespace
}  // namespace rink::physics::test
