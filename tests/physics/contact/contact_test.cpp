// Bodies pressed together: rest without events, release, jams, and random keys that press
// everything into everything.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/contact/pressed_bodies.h"
#include "tests/physics/scenes.h"
#include "tests/words.h"

namespace rink::physics::test {
namespace {

BatSpec bat_at(double x, double y, double mass = 3.0) { return thin_bat_at(x, y, 0.2, mass); }

class PressedAtEveryRestitution : public testing::TestWithParam<double> {};

/// Events between 5 and 15 s, when everything has settled.
std::uint64_t events_once_settled(World& world) {
  world.advance(5.0);
  const std::uint64_t before = world.counters().events();
  world.advance(15.0);
  EXPECT_LT(world.max_overlap(), 1e-9);
  return world.counters().events() - before;
}

TEST_P(PressedAtEveryRestitution, BatHeldAgainstAWallCostsNothing) {
  World world(rink_of(4, 2, GetParam(), 0.2, 1.0));
  const BodyId bat = world.add(bat_at(1, 1));
  world.set_thrust(bat, {-6, 0});
  EXPECT_EQ(events_once_settled(world), 0u);
  EXPECT_NEAR(world.position(bat).x(), 0.05, 1e-9);
  EXPECT_TRUE(world.is_resting(bat));
  world.set_thrust(bat, {6, 0});
  world.advance(15.1);
  EXPECT_GT(world.velocity(bat).x(), 0.5);
}

TEST_P(PressedAtEveryRestitution, BatHeldAgainstAWallStillSlidesAlongIt) {
  World world(rink_of(4, 4, GetParam(), 0.2, 1.0));
  const BodyId bat = world.add(bat_at(1, 1));
  world.set_thrust(bat, {-6, 0});
  world.advance(5.0);
  world.set_thrust(bat, {-6, 6});
  world.advance(5.2);
  const double s = -std::expm1(-0.2);
  EXPECT_NEAR(world.position(bat).y(), 1 + 6 * (0.2 - s), 1e-12);
  EXPECT_NEAR(world.position(bat).x(), 0.05, 1e-9);
}

TEST_P(PressedAtEveryRestitution, PuckPinnedToAWallRestsAndIsReleasedWhenTheBatWithdraws) {
  World world(rink_of(4, 2, GetParam(), 0.2, 1.0));
  const BodyId bat = world.add(bat_at(1, 1)), puck = world.add(light_puck_at(0.5, 1));
  world.set_thrust(bat, {-6, 0});
  EXPECT_EQ(events_once_settled(world), 0u);
  EXPECT_NEAR(world.position(puck).x(), 0.04, 1e-9);
  world.set_thrust(bat, {6, 0});
  world.advance(15.2);
  EXPECT_GT(world.position(bat).x(), 0.2);
  EXPECT_NEAR(world.position(puck).x(), 0.04, 1e-9);
}

TEST_P(PressedAtEveryRestitution, RowOfPucksIsPinnedToAWall) {
  World world(rink_of(4, 2, GetParam(), 0.2, 1.0));
  const BodyId bat = world.add(bat_at(1, 1));
  world.add(light_puck_at(0.5, 1));
  world.add(light_puck_at(0.3, 1));
  world.set_thrust(bat, {-6, 0});
  EXPECT_EQ(events_once_settled(world), 0u);
  EXPECT_NEAR(world.position(bat).x(), 0.16 + 0.05, 1e-5);
}

TEST_P(PressedAtEveryRestitution, PucksSideBySideArePinnedToAWall) {
  World world(rink_of(4, 2, GetParam(), 0.2, 1.0));
  const BodyId bat = world.add(bat_at(1, 1));
  world.add(light_puck_at(0.5, 0.9));
  world.add(light_puck_at(0.3, 1.1));
  world.set_thrust(bat, {-6, 0});
  EXPECT_EQ(events_once_settled(world), 0u);
}

TEST_P(PressedAtEveryRestitution, PuckIsPinnedInTheCornerOfTheField) {
  World world(rink_of(4, 2, GetParam(), 0.2, 1.0));
  const BodyId bat = world.add(bat_at(1, 0.3)), puck = world.add(light_puck_at(0.5, 0.1));
  world.set_thrust(bat, {-6, -6});
  world.advance(15.0);
  EXPECT_LT(world.max_overlap(), 1e-9);
  EXPECT_LT(world.counters().events(), 15 * 20000u);
  EXPECT_LT(world.position(puck).x(), 1.0);
}

TEST_P(PressedAtEveryRestitution, PuckSquirtsFromAPostOrStaysAndTimeAdvances) {
  for (const double offset : {0.0, 1e-12, 1e-6, 1e-3, 0.02}) {
    SCOPED_TRACE(offset);
    World world(rink_of(4, 2, GetParam(), 0.2, 1.0));
    PostSpec post;
    post.position = {0.5, 1};
    post.radius = 0.1;
    world.add(post);
    const BodyId bat = world.add(bat_at(1, 1));
    world.add(light_puck_at(0.8, 1 + offset));
    world.set_thrust(bat, {-6, 0});
    world.advance(10.0);
    EXPECT_LT(world.max_overlap(), 1e-9);
    EXPECT_LT(world.counters().events(), 100000u);
  }
}

TEST_P(PressedAtEveryRestitution, BatPushesAPuckAcrossTheFieldAsOneBody) {
  World world(rink_of(40, 2, GetParam(), 0.5, 1.0));
  const BodyId bat = world.add(bat_at(1, 1, 3.0)), puck = world.add(light_puck_at(1.2, 1, 1.0));
  world.set_thrust(bat, {6, 0});
  world.advance(6.0);
  if (GetParam() < 1.0) {
    EXPECT_EQ(world.velocity(bat).x(), world.velocity(puck).x());
    const std::uint64_t before = world.counters().events();
    world.advance(7.0);
    EXPECT_EQ(world.counters().events(), before);
    // Together they obey (m + n) dv/dt = m a - (m g + n h) v.
    const double drag = (3.0 * 1.0 + 1.0 * 0.5) / 4.0, terminal = 18.0 / 4.0 / drag;
    world.advance(7.5);
    const double v = world.velocity(bat).x();
    world.advance(8.0);
    EXPECT_NEAR(world.velocity(bat).x(), terminal + (v - terminal) * std::exp(-0.5 * drag), 1e-12);
  }
  world.set_thrust(bat, {0, 0});
  world.advance(world.now() + 0.5);
  EXPECT_GT(world.velocity(puck).x(), world.velocity(bat).x());  // less drag, so it runs ahead
}

TEST_P(PressedAtEveryRestitution, PushedPuckSlidesOffTheEndOfTheFace) {
  World world(rink_of(40, 4, GetParam(), 0.2, 1.0));
  const BodyId bat = world.add(bat_at(1, 1)), puck = world.add(light_puck_at(1.2, 1.1));
  world.set_thrust(bat, {6, 0});
  world.advance(2.0);
  world.set_thrust(bat, {6, -6});
  world.advance(4.0);
  EXPECT_LT(world.max_overlap(), 1e-9);
  EXPECT_GT(world.position(puck).y() - world.position(bat).y(), 0.2);
  EXPECT_LT(world.counters().events(), 20000u);
}

TEST_P(PressedAtEveryRestitution, OpposedBatsHoldAPuckBetweenThem) {
  World world(rink_of(4, 2, GetParam(), 0.2, 1.0));
  const BodyId left = world.add(bat_at(1, 1)), right = world.add(bat_at(2, 1));
  const BodyId puck = world.add(light_puck_at(1.4, 1));
  world.set_thrust(left, {6, 0});
  world.set_thrust(right, {-6, 0});
  EXPECT_EQ(events_once_settled(world), 0u);
  EXPECT_TRUE(world.is_held(puck));
}

INSTANTIATE_TEST_SUITE_P(Restitution, PressedAtEveryRestitution, testing::Values(0.0, 0.5, 0.9),
                         [](const auto& restitution) {
                           return "of_" + rink::test::words(restitution.param);
                         });

TEST(Collapse, ThreePucksOfAnyRestitutionSeparateInTime) {
  for (const double e : {0.0, 0.05, 0.2, 0.5, 0.9}) {
    SCOPED_TRACE(e);
    World world(rink_of(10, 1, e));
    for (int i = 0; i < 6; ++i) {
      PuckSpec puck = light_puck_at(3 + i * 0.5, 0.5);
      puck.velocity = {i < 3 ? 1.0 : -1.0, 0.0};
      world.add(puck);
    }
    world.advance(100.0);
    EXPECT_LT(world.max_overlap(), 1e-9);
    EXPECT_LT(world.counters().events(), 5000u);
  }
}

TEST(Determinism, CellSizeAndStopsOnTheWayNeverChangeABit) {
  for (int scene = 0; scene < 12; ++scene) {
    const double e = std::vector{0.0, 0.0, 0.5, 0.0, 0.9, 1.0}[static_cast<std::size_t>(scene % 6)];
    std::uint64_t expected = 0;
    for (int variant = 0; variant < 5; ++variant) {
      SCOPED_TRACE(testing::Message()
                   << "scene " << scene << " restitution " << e << " variant " << variant);
      WorldSpec spec = rink_of(4, 2, e, 0.2, 1.0);
      spec.cell_size = variant == 1 ? 0.6 : variant == 2 ? 5.0 : 0.0;
      World world(spec);
      std::mt19937_64 random(static_cast<std::uint64_t>(11 + scene)),
          stops(static_cast<std::uint64_t>(variant));
      scatter_posts(world, random, 2);
      const std::vector<BodyId> bats = scatter_bats(world, random, 6);
      scatter_pucks(world, random, 40, 0.1, 1.0);
      RandomKeys keys{std::mt19937_64(12), 0.05};
      for (double t = 0.0; t < 3.0;) {
        t = variant == 0
                ? 3.0
                : std::min(3.0, t + (variant == 3 ? 1.0 / 60.0 : uniform(stops, 0.0, 0.1)));
        keys.play(world, bats, t);
      }
      if (variant == 0) expected = world.hash();
      EXPECT_EQ(world.hash(), expected);
    }
  }
}

void soak(std::uint64_t seed, double restitution, double duration) {
  SCOPED_TRACE(testing::Message() << "seed " << seed << " restitution " << restitution);
  World world(rink_of(4, 2, restitution, 0.2, 1.0));
  std::mt19937_64 random(seed);
  scatter_posts(world, random, 3);
  const std::vector<BodyId> bats =
      scatter_bats(world, random, 8, std::pow(10.0, uniform(random, -0.5, 1.0)));
  scatter_pucks(world, random, 40, 0.05, 3.0);
  RandomKeys keys{std::mt19937_64(seed), 0.04};
  std::uint64_t before = 0;
  for (double t = 0.1; t < duration; t += 0.1) {
    keys.play(world, bats, t);
    ASSERT_LT(world.max_overlap(), 1e-9) << t;
    ASSERT_LT(world.counters().events() - before, 0.1 * 1e4 * world.body_count()) << t;
    before = world.counters().events();
  }
}

/// Goals, the halfway line, and whoever scores is put back where there is room.
void soak_with_goals(std::uint64_t seed, double restitution) {
  SCOPED_TRACE(testing::Message() << "seed " << seed << " restitution " << restitution);
  WorldSpec spec = rink_of(4, 2, restitution, 0.2, 1.0);
  spec.field.goal_width = 0.6;
  spec.field.bats_keep_to_half = true;
  World world(spec);
  std::mt19937_64 random(seed);
  std::vector<BodyId> bats;
  for (int i = 0; i < 6; ++i) {
    BatSpec bat;
    bat.position = {i % 2 == 0 ? 0.5 : 3.5, 0.3 + 0.5 * (i / 2)};
    bat.half_extent = {0.05, 0.12};
    bat.mass = 2.0;
    bat.half = i % 2 == 0 ? Half::left : Half::right;
    bats.push_back(world.add(bat));
  }
  const std::vector<BodyId> pucks = scatter_pucks(world, random, 30, 0.1, 1.0);
  for (double t = 0.02; t < 6.0; t += 0.02) {
    while (const auto goal = world.advance(t)) {
      ASSERT_TRUE(std::abs(world.position(goal->puck).y() - 1.0) < 0.3 + 1e-9);
      const Vector2 spot(uniform(random, 1.0, 3.0), uniform(random, 0.1, 1.9));
      if (world.is_free(spot, 0.04))
        world.place(goal->puck, spot, {uniform(random, -2, 2), uniform(random, -2, 2)});
    }
    const BodyId bat = bats[random() % bats.size()];
    const double x = static_cast<double>(random() % 3) - 1.0,
                 y = static_cast<double>(random() % 3) - 1.0;
    world.set_thrust(bat, {6.0 * x, 6.0 * y});
    ASSERT_LT(world.max_overlap(), 1e-9) << t;
    for (const BodyId puck : pucks)
      ASSERT_TRUE(world.position(puck).x() > -1e-9 && world.position(puck).x() < 4.0 + 1e-9) << t;
    for (std::size_t i = 0; i < bats.size(); ++i)
      ASSERT_TRUE(i % 2 == 0 ? world.position(bats[i]).x() < 1.95 + 1e-9
                             : world.position(bats[i]).x() > 2.05 - 1e-9);
  }
  EXPECT_TRUE(restitution == 0.0 ||
              world.counters().goals > 0u);  // without restitution the pucks soon lie still
  EXPECT_LT(world.counters().events(), 6u * 36u * 2000u);
}

TEST(Crowd, GoalsAndHalfwayLineHoldUnderRandomKeys) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    for (const double restitution : {0.0, 0.5, 1.0}) soak_with_goals(seed, restitution);
}

TEST(Crowd, RemovingAPressingBatFreesWhatItHeld) {
  World world(rink_of(4, 2, 0.5, 0.2, 1.0));
  const BodyId bat = world.add(bat_at(1, 1)), puck = world.add(light_puck_at(0.5, 1));
  world.set_thrust(bat, {-6, 0});
  world.advance(5.0);
  EXPECT_TRUE(world.is_held(puck));
  world.remove(bat);
  EXPECT_FALSE(world.is_held(puck));
  EXPECT_FALSE(world.is_in_play(bat));
  PuckSpec striker = light_puck_at(1.5, 1);
  striker.velocity = {-1, 0};
  world.add(striker);
  world.advance(15.0);
  EXPECT_GT(world.counters().disc_impacts, 0u);
}

TEST(Crowd, RandomKeysNeverOverlapOrStopTime) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    for (const double restitution : {0.0, 0.5, 1.0}) soak(seed, restitution, 2.0);
}

TEST(CrowdLong, RandomKeysNeverOverlapOrStopTime) {
  for (std::uint64_t seed = 100; seed < 300; ++seed)
    for (const double restitution : {0.0, 0.1, 0.5, 0.9, 1.0}) soak(seed, restitution, 5.0);
}

}  // namespace
}  // namespace rink::physics::test
