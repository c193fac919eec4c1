// Impacts without end that nothing presses: inelastic collapse, cooled gases, grazing contact, and
// masses that differ by twelve orders.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/contact/contact_bounds.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

PuckSpec puck_at(const Vector2& position, const Vector2& velocity = {0.0, 0.0}, double mass = 1.0) {
  PuckSpec puck;
  puck.position = position;
  puck.velocity = velocity;
  puck.mass = mass;
  return puck;
}

/// Below 7 - 4 sqrt(3) = 0.0718 three balls on a line collide infinitely often in finite time
/// (McNamara and Young 1992), more balls at higher restitutions.
TEST(Collapse, OfBallsOnALineEndsInOneInstant) {
  for (const double e : {0.0, 0.02, 0.05, 0.07, 0.1, 0.3})
    for (const int count : {3, 5, 12}) {
      SCOPED_TRACE(testing::Message() << count << " balls of restitution " << e);
      World world(rink_of(20, 1, e));
      for (int i = 0; i < count; ++i)
        world.add(puck_at({5.0 + 0.37 * i, 0.5}, {i == 0           ? 1.0
                                                  : i + 1 == count ? -1.0
                                                                   : 0.0,
                                                  0.0}));
      Watch watch(world, {});
      watch.run(4.0, 1.0);  // until before the walls, which take momentum
      EXPECT_NEAR(world.momentum().x(), 0.0, 1e-12);
      watch.run(26.0, 1.0);
      EXPECT_LT(world.counters().events(), 200u * static_cast<unsigned>(count));
    }
}

TEST(Collapse, AgainstAWallEnds) {
  for (const double e : {0.0, 0.1, 0.2}) {
    World world(rink_of(4, 1, e));
    for (int i = 0; i < 4; ++i) world.add(puck_at({0.3 + 0.2 * i, 0.5}, {-1.0, 0.0}));
    Watch watch(world, {});
    watch.run(20.0, 1.0);
    EXPECT_LT(world.counters().events(), 2000u);
  }
}

TEST(CooledGas, OfAnyRestitutionNeverStopsTime) {
  for (const double e : {0.0, 0.1, 0.4, 0.8}) {
    SCOPED_TRACE(testing::Message() << "restitution " << e);
    World world(rink_of(2, 2, e));
    std::mt19937_64 random(4);
    scatter_pucks(world, random, 250, 0.1, 10.0);
    Watch watch(world, {});
    watch.run(20.0, 0.5);
  }
}

TEST(Grazing, ContactPassesWithoutAnImpulseOrWithATinyOne) {
  for (const double e : {0.0, 0.5, 1.0})
    for (int i = -60; i <= 60; ++i) {
      World world(rink_of(4, 2, e));
      const BodyId resting = world.add(puck_at({2.0, 1.0}));
      const BodyId passing =
          world.add(puck_at({1.0, 1.08 + 1e-17 * i * std::pow(1.3, std::abs(i))}, {3.0, 0.0}));
      Watch watch(world, {});
      watch.run(0.5);
      EXPECT_NEAR(world.velocity(passing).x(), 3.0, 1e-6);
      EXPECT_LT(world.velocity(resting).norm(), 1e-3);
      EXPECT_NEAR((world.momentum() - Vector2(3.0, 0.0)).norm(), 0.0, 1e-14);
    }
}

TEST(Grazing, BatSlidesPastAPuckAndARowAlongAWall) {
  for (const double e : {0.0, 0.5, 1.0}) {
    World world(rink_of(4, 2, e, 0.2, 1.0));
    BatSpec bat;
    bat.half_extent = {0.05, 0.1};
    bat.position = {0.5, 0.1};
    const BodyId sliding = world.add(bat);
    for (int i = 0; i < 5; ++i) world.add(puck_at({1.0 + 0.08 * i + 1e-13 * i, 0.24}));
    Watch watch(world, {sliding});
    watch.set_thrust(sliding, {6, 0});
    watch.run(0.6);
    EXPECT_GT(world.position(sliding).x(), 1.2);
    watch.set_thrust(sliding, {-6, 6});
    watch.run(3.0);
  }
}

TEST(Masses, RatiosTo1e12FollowTheFormula) {
  for (const double ratio : {1e-12, 1e-9, 1e-4, 1e4, 1e9, 1e12})
    for (const double e : {0.0, 0.5, 1.0}) {
      World world(rink_of(8, 1, e));
      const BodyId a = world.add(puck_at({1.0, 0.5}, {1.0, 0.0}, 1.0)),
                   b = world.add(puck_at({2.0, 0.5}, {-1.0, 0.0}, ratio));
      world.advance(0.6);
      // The light one's velocity changes by up to 4 m/s in four roundings of half an ulp, 4
      // x 2.2e-16 each; without restitution the two part at 1e-14 of the speeds all the same, or
      // they would meet again at once.
      const double tolerance = 4e-15 + (e == 0.0 ? 1e-14 * 2.0 : 0.0);
      EXPECT_NEAR(world.velocity(a).x(), 1.0 - 2.0 * (1.0 + e) * ratio / (1.0 + ratio), tolerance)
          << ratio;
      EXPECT_NEAR(world.velocity(b).x(), -1.0 + 2.0 * (1.0 + e) / (1.0 + ratio), tolerance)
          << ratio;
    }
}

/// Not without loss, where the number of impacts is that of the exact series: pi sqrt(M/m)/2 each
/// time a light body is caught between heavy ones.
TEST(Masses, OfTwelveOrdersUnderThrustKeepTheBounds) {
  for (const double e : {0.0, 0.5, 0.9})
    for (const double bat_mass : {1e-6, 1.0, 1e6})
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(testing::Message()
                     << "restitution " << e << ", bats of " << bat_mass << " kg, seed " << seed);
        World world(rink_of(2, 1, e, 0.2, 1.0));
        std::mt19937_64 random(seed);
        scatter_posts(world, random, 1);
        const std::vector<BodyId> bats = scatter_bats(world, random, 2, bat_mass);
        scatter_pucks(world, random, 12, 1e-6, 1e6);
        Watch watch(world, bats);
        for (int key = 0; key < 20; ++key) {
          watch.set_thrust(bats[random() % bats.size()],
                           6.0 * Vector2(static_cast<double>(random() % 3) - 1.0,
                                         static_cast<double>(random() % 3) - 1.0));
          ASSERT_NO_FATAL_FAILURE(watch.run(0.1));
        }
      }
}

}  // namespace
}  // namespace rink::physics::test
