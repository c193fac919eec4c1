// The books of energy: work of thrust and losses, each from its own integral, must add up to the
// kinetic energy.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

void expect_balance(const World& world, double accuracy) {
  const double turned_over =
      world.energy_introduced() + std::abs(world.work_of_thrust()) + std::abs(world.dissipated());
  EXPECT_NEAR(world.kinetic_energy(),
              world.energy_introduced() + world.work_of_thrust() - world.dissipated(),
              accuracy * turned_over);
}

WorldSpec accounted(WorldSpec spec) {
  spec.accounts_energy = true;
  return spec;
}

TEST(Energy, OfAPuckUnderDragIsLostAsItsClosedFormSays) {
  const double g = 0.7, mass = 0.3, speed = 2.0;
  World world(accounted(rink_of(10, 10, 1.0, g)));
  PuckSpec puck;
  puck.position = {1, 5}, puck.velocity = {speed, 0}, puck.mass = mass;
  world.add(puck);
  world.advance(1.3);
  EXPECT_NEAR(world.energy_introduced(), 0.5 * mass * speed * speed, 1e-16);
  EXPECT_NEAR(world.dissipated(), 0.5 * mass * speed * speed * -std::expm1(-2 * g * 1.3), 1e-15);
  EXPECT_EQ(world.work_of_thrust(), 0.0);
}

TEST(Energy, OfAPuckUnderFrictionIsLostByTheWay) {
  WorldSpec spec = accounted(rink_of(10, 10));
  spec.puck_friction = 0.5;
  World world(spec);
  PuckSpec puck;
  puck.position = {1, 5}, puck.velocity = {0.8, 0.6}, puck.mass = 0.3;
  world.add(puck);
  world.advance(1.0);
  EXPECT_NEAR(world.dissipated(), 0.3 * 0.5 * 0.75, 1e-16);
  world.advance(5.0);
  EXPECT_NEAR(world.dissipated(), 0.5 * 0.3, 1e-16);
  EXPECT_EQ(world.kinetic_energy(), 0.0);
}

TEST(Energy, OfABatUnderAKeyIsThrustTimesWayLessDrag) {
  const double a = 6.0, g = 3.0, mass = 0.5, t = 0.9, s = -std::expm1(-g * t) / g;
  World world(accounted(rink_of(10, 10, 1.0, 0.0, g)));
  BatSpec bat;
  bat.position = {2, 5}, bat.mass = mass;
  world.set_thrust(world.add(bat), {a, 0});
  world.advance(t);
  const double way = a * (t - s) / g;
  EXPECT_NEAR(world.work_of_thrust(), mass * a * way, 1e-14);
  EXPECT_NEAR(world.dissipated(), mass * (a * way - 0.5 * a * s * a * s), 1e-14);
}

TEST(Energy, LostInAnImpactIsTheReducedMassTimesWhatRestitutionLeaves) {
  const double e = 0.6, m = 1.0, n = 3.0;
  World world(accounted(rink_of(10, 10, e)));
  PuckSpec puck;
  puck.position = {4, 5}, puck.velocity = {1, 0}, puck.mass = m;
  world.add(puck);
  puck.position = {6, 5}, puck.velocity = {-2, 0}, puck.mass = n;
  world.add(puck);
  world.advance(1.0);
  EXPECT_NEAR(world.dissipated(), 0.5 * m * n / (m + n) * (1 - e * e) * 9.0, 1e-14);
}

TEST(Energy, AddsUpInAMatchWithEverything) {
  for (const double friction : {0.0, 0.3})
    for (const double roughness : {0.0, 0.2})
      for (const double restitution : {0.0, 0.7, 1.0}) {
        SCOPED_TRACE(testing::Message() << friction << " " << roughness << " " << restitution);
        WorldSpec spec = accounted(rink_of(2.5, 1.5, restitution, 0.1, 1.5));
        spec.puck_friction = friction;
        spec.field.goal_width = 0.4;
        if (roughness > 0.0)
          spec.surface_friction =
              SurfaceFriction{PairTable(1, roughness), RestitutionTable(1, 0.3)};
        World world(spec);
        std::mt19937_64 random(41);
        const std::vector<BodyId> bats = scatter_bats(world, random, 3);
        scatter_posts(world, random, 2);
        scatter_pucks(world, random, 25, 0.3, 3.0);
        RandomKeys keys{std::mt19937_64(42), 0.1};
        double dissipated = 0.0;
        for (int step = 1; step <= 30; ++step) {
          keys.play(world, bats, 0.1 * step);
          expect_balance(world, 1e-13);
          EXPECT_GE(world.dissipated(), dissipated * (1 - 1e-9));
          dissipated = world.dissipated();
        }
        EXPECT_GT(world.work_of_thrust(), 0.1);
        world.remove(bats[1]);
        expect_balance(world, 1e-13);
      }
}

TEST(Energy, AddsUpOverAHundredThousandCollisions) {
  World world(accounted(rink_of(3, 3, 1.0, 0.05)));
  std::mt19937_64 random(43);
  scatter_pucks(world, random, 400, 0.3, 3.0);
  while (world.counters().disc_impacts < 100000 && world.now() < 100.0)
    world.advance(world.now() + 1.0);
  expect_balance(world, 1e-14);
}

TEST(Energy, BooksNeverChangeTheMotion) {
  std::uint64_t hashes[2];
  for (int is_kept = 0; is_kept < 2; ++is_kept) {
    WorldSpec spec = rink_of(2.5, 1.5, 0.8, 0.1, 1.5);
    spec.accounts_energy = is_kept == 1;
    World world(spec);
    std::mt19937_64 random(44);
    const std::vector<BodyId> bats = scatter_bats(world, random, 3);
    scatter_pucks(world, random, 25);
    RandomKeys keys{std::mt19937_64(45), 0.1};
    keys.play(world, bats, 3.0);
    hashes[is_kept] = world.hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace rink::physics::test
