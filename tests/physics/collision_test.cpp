// Impacts whose outcome has a closed form, and what no impact may change.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

PuckSpec puck_at(double x, double y, double vx, double vy, double mass = 1.0) {
  PuckSpec puck;
  puck.position = {x, y};
  puck.velocity = {vx, vy};
  puck.mass = mass;
  return puck;
}

void expect_near(const Vector2& value, const Vector2& expected, double tolerance) {
  EXPECT_NEAR(value.x(), expected.x(), tolerance);
  EXPECT_NEAR(value.y(), expected.y(), tolerance);
}

TEST(Collision, HeadOnPucksOfUnequalMassFollowNewton) {
  const double m = 1.0, n = 3.0, e = 0.7;
  World world(rink_of(10, 10, e));
  const BodyId a = world.add(puck_at(4, 5, 1, 0, m)), b = world.add(puck_at(6, 5, -2, 0, n));
  world.advance(1.0);
  const double centre = (m * 1.0 + n * -2.0) / (m + n);
  EXPECT_NEAR(world.velocity(a).x(), centre - e * n / (m + n) * 3.0, 1e-15);
  EXPECT_NEAR(world.velocity(b).x(), centre + e * m / (m + n) * 3.0, 1e-15);
  const double impact = (2.0 - 0.08) / 3.0;
  EXPECT_NEAR(world.position(a).x(), 4 + impact + world.velocity(a).x() * (1 - impact), 1e-14);
}

TEST(Collision, ObliquePucksExchangeOnlyTheirNormalSpeeds) {
  World world(rink_of(10, 10));
  const double offset = 0.04;  // impact parameter: half the reach, so the normal is at 30 degrees
  const BodyId a = world.add(puck_at(4, 5, 1, 0)), b = world.add(puck_at(6, 5 + offset, 0, 0));
  world.advance(3.0);
  const double c = std::cos(std::asin(0.5)), s = 0.5;
  expect_near(
      world.velocity(b), {c * c, c * s},
      2e-14);  // the place in the field is known to 1e-15 m, the normal to that over the reach
  expect_near(world.velocity(a), {1 - c * c, -c * s}, 2e-14);
}

TEST(Collision, DragDelaysTheSameImpactByTheWarpedClock) {
  const double g = 0.4;
  World world(rink_of(10, 10, 1.0, g));
  const BodyId a = world.add(puck_at(4, 5, 2, 0)), b = world.add(puck_at(6, 5, 0, 0));
  world.advance(3.0);
  const double impact = -std::log1p(-g * 1.92 / 2.0) / g;
  EXPECT_NEAR(world.motion(a).time, impact, 1e-14);
  EXPECT_NEAR(world.velocity(b).x(), 2.0 * std::exp(-g * 3.0), 1e-14);
  EXPECT_NEAR(world.position(b).x(), 6.0 + 2.0 * (std::exp(-g * impact) - std::exp(-g * 3.0)) / g,
              1e-13);
}

TEST(Collision, PuckThatDragStopsShortNeverArrives) {
  World world(rink_of(10, 10, 1.0, 1.0));
  const BodyId a = world.add(puck_at(4, 5, 1.9, 0));
  world.add(puck_at(6, 5, 0, 0));
  world.advance(1000.0);
  EXPECT_EQ(world.counters().disc_impacts, 0u);
  EXPECT_NEAR(world.position(a).x(), 5.9, 1e-13);
}

TEST(Collision, WallsReflectAndTheCornerReflectsTwice) {
  World world(rink_of(4, 3));
  const BodyId puck = world.add(puck_at(1, 1, -1, -1));
  world.advance(2.0);
  expect_near(world.velocity(puck), {1, 1}, 0.0);
  expect_near(world.position(puck), {1.08, 1.08}, 1e-14);
  EXPECT_EQ(world.counters().wall_impacts, 2u);
}

TEST(Collision, PostReflectsAboutItsNormal) {
  World world(rink_of(10, 10));
  const double reach = 0.14, offset = reach * std::sin(0.3);
  PostSpec post;
  post.position = {6, 5};
  post.radius = 0.1;
  world.add(post);
  const BodyId puck = world.add(puck_at(4, 5 + offset, 1, 0));
  world.advance(3.0);
  expect_near(world.velocity(puck), {-std::cos(0.6), std::sin(0.6)}, 1e-13);
}

TEST(Collision, BatCornerIsRounded) {
  World world(rink_of(10, 10));
  BatSpec bat;
  bat.position = {6, 5};
  bat.half_extent = {0.05, 0.2};
  bat.mass = 2.0;
  const BodyId b = world.add(bat);
  const double angle = 0.7;
  const BodyId puck = world.add(puck_at(4, 5.2 + 0.04 * std::sin(angle), 1, 0));
  world.advance(1.95);
  const double impact = 6 - 0.05 - 0.04 * std::cos(angle) - 4;
  EXPECT_NEAR(world.motion(puck).time, impact, 1e-13);
  const double impulse = 2.0 * std::cos(angle) / (1.0 + 0.5);
  expect_near(world.velocity(puck), {1 - impulse * std::cos(angle), impulse * std::sin(angle)},
              1e-12);
  expect_near(world.velocity(b),
              {0.5 * impulse * std::cos(angle), -0.5 * impulse * std::sin(angle)}, 1e-12);
}

TEST(Collision, BatUnderAKeyFollowsTheClosedFormAndStrikesAtItsTime) {
  const double g = 1.5, a = 6.0;
  World world(rink_of(10, 10, 1.0, 0.0, g));
  BatSpec bat;
  bat.position = {2, 5};
  const BodyId b = world.add(bat);
  const BodyId puck = world.add(puck_at(3, 5, 0, 0));
  world.set_thrust(b, {a, 0});
  world.advance(0.3);
  const double s = -std::expm1(-g * 0.3) / g;
  EXPECT_NEAR(world.velocity(b).x(), a * s, 1e-14);
  EXPECT_NEAR(world.position(b).x(), 2 + a * (0.3 - s) / g, 1e-14);
  world.advance(1.0);
  const double hit = world.motion(puck).time, travel = a * (hit + std::expm1(-g * hit) / g) / g;
  EXPECT_NEAR(travel, 1.0 - 0.05 - 0.04, 1e-14);
}

TEST(Collision, BoxesMeetFaceToFaceOrPassEachOther) {
  World world(rink_of(10, 10));
  BatSpec bat;
  bat.position = {2, 5};
  bat.velocity = {1, 0};
  const BodyId a = world.add(bat);
  bat.position = {4, 5.0999};
  bat.velocity = {0, 0};
  const BodyId b = world.add(bat);
  bat.position = {4, 5.2001};
  const BodyId c = world.add(bat);
  world.advance(3.0);
  expect_near(world.velocity(a), {0, 0}, 0.0);
  expect_near(world.velocity(b), {1, 0}, 0.0);
  expect_near(world.velocity(c), {0, 0}, 0.0);
  EXPECT_EQ(world.counters().bat_bat_impacts, 1u);
}

TEST(Collision, BatKeepsToItsHalf) {
  WorldSpec spec = rink_of(4, 2);
  spec.field.bats_keep_to_half = true;
  World world(spec);
  BatSpec bat;
  bat.position = {1, 1};
  bat.velocity = {1, 0};
  bat.half = Half::left;
  const BodyId b = world.add(bat);
  world.advance(1.5);
  EXPECT_NEAR(world.position(b).x(), 1.95 - (1.5 - 0.95), 1e-14);
}

TEST(Collision, HalfwayLineStopsBatsOfAHalfAndNobodyElse) {
  WorldSpec spec = rink_of(4, 2);
  for (const bool keep : {false, true}) {
    spec.field.bats_keep_to_half = keep;
    World world(spec);
    const auto bat_of = [&](Half half, double x, double y, double vx) {
      BatSpec bat;
      bat.position = {x, y};
      bat.velocity = {vx, 0};
      bat.half = half;
      return world.add(bat);
    };
    const BodyId left = bat_of(Half::left, 1, 0.25, 1), right = bat_of(Half::right, 3, 0.5, -1);
    const BodyId both = bat_of(Half::both, 1, 0.75, 1), back = bat_of(Half::both, 3, 1, -1);
    const BodyId puck = world.add(puck_at(1, 1.5, 1, 0));
    world.advance(1.5);
    EXPECT_NEAR(world.position(left).x(), keep ? 1.4 : 2.5, 1e-14);
    EXPECT_NEAR(world.position(right).x(), keep ? 2.6 : 1.5, 1e-14);
    EXPECT_NEAR(world.position(both).x(), 2.5, 1e-14);
    EXPECT_NEAR(world.position(back).x(), 1.5, 1e-14);
    EXPECT_NEAR(world.position(puck).x(), 2.5, 1e-14);
    EXPECT_EQ(world.counters().wall_impacts, keep ? 2u : 0u);
  }
}

TEST(Collision, ChainOfMassesCountsTheDigitsOfPi) {
  const std::uint64_t digits[] = {3, 31, 314, 3141};
  for (int n = 0; n <= 3; ++n) {
    World world(rink_of(1e6, 1));
    world.add(puck_at(1, 0.5, 0, 0));
    world.add(puck_at(2, 0.5, -1, 0, std::pow(100.0, n)));
    world.advance(3000.0);
    EXPECT_EQ(world.counters().impacts(), digits[n]) << n;
    EXPECT_EQ(world.counters().hops, 0u);
  }
}

TEST(Goal, IsReportedAtItsExactTimeAndThePuckLeavesPlay) {
  WorldSpec spec = rink_of(4, 2);
  spec.field.goal_width = 0.6;
  World world(spec);
  const BodyId puck = world.add(puck_at(1, 1, -2, 0.1));
  const auto goal = world.advance(10.0);
  ASSERT_TRUE(goal);
  EXPECT_NEAR(goal->time, 0.5, 1e-15);
  EXPECT_EQ(goal->puck, puck);
  EXPECT_EQ(goal->end, End::left);
  EXPECT_EQ(world.now(), goal->time);
  EXPECT_FALSE(world.is_in_play(puck));
  EXPECT_FALSE(world.advance(2.0));
  world.place(puck, {2, 1}, {3, 0});
  const auto second = world.advance(10.0);
  ASSERT_TRUE(second);
  EXPECT_NEAR(second->time, 2.0 + 2.0 / 3.0, 1e-15);
  EXPECT_EQ(second->end, End::right);
}

TEST(Goal, EdgeOfTheMouthDeflectsLikeAPostWithoutExtent) {
  WorldSpec spec = rink_of(4, 2);
  spec.field.goal_width = 0.6;
  World world(spec);
  const double angle = 0.5;
  const BodyId puck = world.add(puck_at(1, 0.7 + 0.04 * std::sin(angle), -1, 0));
  ASSERT_FALSE(world.advance(1.1));
  expect_near(world.velocity(puck), {std::cos(2 * angle), std::sin(2 * angle)}, 1e-12);
  EXPECT_EQ(world.counters().post_impacts, 1u);
}

TEST(Goal, PuckBesideTheMouthMeetsTheWall) {
  WorldSpec spec = rink_of(4, 2);
  spec.field.goal_width = 0.6;
  World world(spec);
  const BodyId puck = world.add(puck_at(1, 0.69, -1, 0));
  ASSERT_FALSE(world.advance(1.5));
  expect_near(world.velocity(puck), {1, 0}, 0.0);
}

TEST(Gas, ElasticPucksKeepTheirEnergyOverAMillionCollisions) {
  World world(rink_of(5, 5));
  std::mt19937_64 random(5);
  scatter_pucks(world, random, 1000, 0.3, 3.0);
  const double energy = world.kinetic_energy();
  for (int second = 1; world.counters().disc_impacts < 1000000; ++second) world.advance(second);
  EXPECT_NEAR(world.kinetic_energy() / energy, 1.0, 1e-13);
  EXPECT_LT(world.max_overlap(), 1e-12);
}

TEST(Gas, ImpactsAwayFromWallsKeepMomentum) {
  World world(rink_of(100, 100));  // too large for anyone to reach a wall
  std::mt19937_64 random(6);
  for (int i = 0; i < 400; ++i)
    world.add(puck_at(48 + 0.2 * (i % 20), 48 + 0.2 * (i / 20), uniform(random, -2, 2),
                      uniform(random, -2, 2), uniform(random, 0.1, 3)));
  const Vector2 before = world.momentum();
  world.advance(6.0);
  EXPECT_EQ(world.counters().wall_impacts, 0u);
  EXPECT_GT(world.counters().disc_impacts, 100u);
  expect_near(world.momentum(), before, 1e-12);
}

TEST(Gas, TakesTheSameImpactsAsSteppingInSmallTime) {
  // Brute force: between two samples 1e-4 s apart no pair may overlap, and every pair that would
  // have met without an event must have had one.
  World world(rink_of(2, 2, 0.9, 0.3));
  std::mt19937_64 random(7);
  const std::vector<BodyId> pucks = scatter_pucks(world, random, 40);
  for (int step = 1; step <= 20000; ++step) {
    world.advance(1e-4 * step);
    ASSERT_LT(world.max_overlap(), 1e-12) << step;
  }
  EXPECT_GT(world.counters().disc_impacts, 50u);
}

TEST(Skipping, RestingPucksCostNoEventsWhateverTheirNumber) {
  Counters counters[2];
  for (int scene = 0; scene < 2; ++scene) {
    World world(rink_of(20, 20));
    PuckSpec mover = puck_at(1, 1, 1, 0);
    world.add(mover);
    for (int i = 0; i < (scene == 0 ? 10 : 3000); ++i)
      world.add(puck_at(1 + 0.3 * (i % 60), 4 + 0.3 * (i / 60), 0, 0));
    world.advance(40.0);
    counters[scene] = world.counters();
  }
  EXPECT_EQ(counters[0].wall_impacts, 2u);
  EXPECT_EQ(counters[0].wall_impacts, counters[1].wall_impacts);
  EXPECT_EQ(counters[0].bodies_touched, counters[1].bodies_touched);
}

}  // namespace
}  // namespace rink::physics::test
