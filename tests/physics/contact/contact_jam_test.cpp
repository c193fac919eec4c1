// Bodies that exactly fill the room between two things, at rest or moving along them: nothing can
// make their contacts part, and time must advance all the same.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/physics/contact/contact_bounds.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

constexpr double radius = 0.04;

World channel(double gap, double restitution) {
  return World(rink_of(1.0, 2.0 * radius + gap, restitution));
}

/// The way along the channel is that of a puck that only meets its ends: the first at 0.46 m, then
/// every 0.92 m, each time slower by the restitution.
double place_along(double time, double restitution) {
  double x = 0.5, v = 1.0, left = time;
  for (;;) {
    const double way = v > 0.0 ? 1.0 - radius - x : x - radius, needed = way / std::abs(v);
    if (needed > left) return x + v * left;
    x += std::copysign(way, v), left -= needed, v *= -restitution;
  }
}

TEST(PuckThatFillsAChannel, KeepsItsWayAlongAndLosesItsWayAcrossWhateverTheGap) {
  for (const double restitution : {0.0, 0.3, 0.5, 0.9}) {
    for (const double gap : {0.0, 2e-9, 1e-7, 1e-6}) {
      SCOPED_TRACE(testing::Message() << "restitution " << restitution << ", gap " << gap);
      World world = channel(gap, restitution);
      const BodyId puck = world.add(PuckSpec{
          .position = {0.5, radius + 0.5 * gap}, .velocity = {1.0, 1.0}, .radius = radius});
      Watch watch(world, {});
      ASSERT_NO_FATAL_FAILURE(watch.run(0.4));
      EXPECT_LE(std::abs(world.velocity(puck).y()),
                gap == 0.0 ? 0.0 : 1e-5);  // in a gap it may go on to and fro, at less than a gap
                                           // in a tenth of a second
      EXPECT_NEAR(world.position(puck).x(), place_along(0.4, restitution), 1e-12);
      if (restitution == 0.0) continue;
      ASSERT_NO_FATAL_FAILURE(watch.run(2.6));
      EXPECT_NEAR(world.position(puck).x(), place_along(3.0, restitution), 1e-9);
    }
  }
}

TEST(PuckThatFillsAChannel, LosesItsWayAcrossEvenWhereImpactsLoseNothingSinceItHasNoneToGo) {
  World world = channel(0.0, 1.0);
  const BodyId puck =
      world.add(PuckSpec{.position = {0.5, radius}, .velocity = {1.0, 1.0}, .radius = radius});
  world.advance(3.0);
  EXPECT_EQ(world.now(), 3.0);
  EXPECT_EQ(world.velocity(puck).y(), 0.0);
  EXPECT_NEAR(world.position(puck).x(), place_along(3.0, 1.0), 1e-12);
  EXPECT_LT(world.counters().events(), 20'000u);
}

TEST(BatThatFillsAChannel, MovesAlongItUnderItsKeys) {
  for (const double restitution : {0.0, 0.3, 0.5}) {
    World world(rink_of(1.0, 0.2, restitution, 0.0, 1.0));
    const BodyId bat =
        world.add(BatSpec{.position = {0.3, 0.1}, .half_extent = {0.04, 0.1}, .mass = 3.0});
    Watch watch(world, {bat});
    watch.set_thrust(bat, {6.0, 6.0});
    ASSERT_NO_FATAL_FAILURE(watch.run(2.0));
    EXPECT_NEAR(world.position(bat).x(), 0.96, 1e-9) << restitution;
    EXPECT_EQ(watch.events_in(5.0), 0u) << restitution;
    watch.set_thrust(bat, {-6.0, 0.0});
    ASSERT_NO_FATAL_FAILURE(watch.run(0.2));
    EXPECT_LT(world.position(bat).x(), 0.9) << restitution;
  }
}

TEST(ColumnOfPucksThatFillsAField, IsBrokenByOneThatHitsIt) {
  for (const double restitution : {0.0, 0.5, 0.9}) {
    World world(rink_of(1.0, 0.375, restitution));
    for (const double y : {0.0625, 0.1875, 0.3125})
      world.add(PuckSpec{.position = {0.5, y}, .radius = 0.0625});
    world.add(PuckSpec{.position = {0.2, 0.2}, .velocity = {1.0, 0.2}, .radius = 0.0625});
    Watch watch(world, {});
    ASSERT_NO_FATAL_FAILURE(watch.run(5.0)) << restitution;
  }
}

/// Sizes that are sums of powers of two, so that rows of bodies fill the field to the bit.
TEST(RandomJams, LetTimeAdvance) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    std::mt19937_64 random(seed);
    const double restitution = std::array{0.0, 0.3, 0.5, 0.9}[random() % 4];
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", restitution " << restitution);
    World world(
        rink_of(1.0, 0.25 + 0.125 * static_cast<double>(random() % 3), restitution, 0.0, 1.0));
    std::vector<BodyId> bats;
    const auto place = [&](double step) {
      return 0.0625 + step * static_cast<double>(random() % 16);
    };
    for (int k = 0; k < 3; ++k) {
      const BatSpec bat{.position = {place(0.0625), place(0.03125)},
                        .half_extent = {0.03125, 0.0625},
                        .mass = 2.0};
      if (bat.position.y() + 0.0625 <= world.spec().field.width && bat.position.x() <= 0.96875 &&
          world.is_free(bat.position, bat.half_extent))
        bats.push_back(world.add(bat));
    }
    for (int k = 0; k < 24; ++k) {
      const Vector2 at(place(0.0625) - 0.03125, place(0.0625) - 0.03125);
      if (at.y() + 0.03125 > world.spec().field.width || at.x() + 0.03125 > 1.0 ||
          !world.is_free(at, 0.03125))
        continue;
      world.add(PuckSpec{.position = at,
                         .velocity = {uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)},
                         .radius = 0.03125,
                         .mass = uniform(random, 0.1, 2.0)});
    }
    for (int k = 0; k < 10; ++k) {
      for (const BodyId bat : bats)
        world.set_thrust(bat, 10.0 * Vector2(static_cast<double>(random() % 3) - 1.0,
                                             static_cast<double>(random() % 3) - 1.0));
      while (world.advance(world.now() + 0.2)) {
      }
      ASSERT_LE(world.max_overlap(), 1e-9);
    }
    EXPECT_LT(static_cast<double>(world.counters().events()), 1e4 * 2.0 * world.body_count());
  }
}

}  // namespace
}  // namespace rink::physics::test
