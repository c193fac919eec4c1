// What rests costs nothing: the counters of a few fenced-in movers do not know how many others
// there are.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

constexpr double fence = 2.0, spacing = 0.22;

void add_fence(World& world) {
  for (int i = 0; 0.08 + 0.13 * i < fence; ++i) {
    world.add(PostSpec{.position = {fence, 0.08 + 0.13 * i}, .radius = 0.06});
    world.add(PostSpec{.position = {0.08 + 0.13 * i, fence + 0.1}, .radius = 0.06});
  }
}

/// 30 pucks and a bat under keys behind a fence in a corner, and resting pucks on a lattice outside
/// it, `count` bodies in all; the field grows with their number.
Counters counters_among(std::uint32_t count, double puck_drag) {
  const double side = 0.25 * std::sqrt(static_cast<double>(count));
  World world(rink_of(side, side, 0.95, puck_drag, 1.0));
  add_fence(world);
  const BodyId bat = world.add(BatSpec{.position = {1.0, 1.0}, .mass = 3.0});
  for (int i = 0; i < 30; ++i)
    world.add(PuckSpec{.position = {0.1 + 0.16 * (i % 10), 0.2 + 0.25 * (i / 10)},
                       .velocity = {1.0 - 0.07 * i, 0.4 + 0.05 * i}});
  for (double y = 0.1; y + 0.05 < side; y += spacing)
    for (double x = 0.1; x + 0.05 < side && world.body_count() < count; x += spacing)
      if (x > fence + 0.15 || y > fence + 0.25) world.add(PuckSpec{.position = {x, y}});
  EXPECT_EQ(world.body_count(), count);
  for (int key = 0; key < 20; ++key) {
    world.set_thrust(bat, {key % 3 == 0 ? 6.0 : -3.0, key % 2 == 0 ? 5.0 : -5.0});
    world.advance(0.25 * (key + 1));
  }
  EXPECT_GT(world.counters().impacts(), 200u);
  EXPECT_GT(world.counters().bat_impacts, 10u);
  return world.counters();
}

void expect_equal_counters(std::uint32_t few, std::uint32_t many) {
  for (const double puck_drag : {0.0, 0.1}) {
    SCOPED_TRACE(puck_drag);
    const Counters a = counters_among(few, puck_drag), b = counters_among(many, puck_drag);
    EXPECT_EQ(a.impacts(), b.impacts());
    EXPECT_EQ(a.predictions, b.predictions);
    EXPECT_EQ(a.crossings, b.crossings);
    EXPECT_EQ(a.stale_events, b.stale_events);
    EXPECT_EQ(a.evaluations, b.evaluations);
    EXPECT_EQ(a.bodies_touched, b.bodies_touched);
    EXPECT_TRUE(a == b);  // every other counter
  }
}

TEST(Skipping, FencedInMoversCostTheSameAmongAThousandAndAHundredThousandAtRest) {
  expect_equal_counters(1'000, 100'000);
}

TEST(SkippingLong, FencedInMoversCostTheSameAmongAThousandAndAMillionAtRest) {
  expect_equal_counters(1'000, 1'000'000);
}

TEST(Skipping, ARestingCrowdIsNeverLookedAt) {
  World world(rink_of(20.0, 20.0));
  for (int i = 0; i < 2000; ++i)
    world.add(PuckSpec{.position = {1.0 + 0.4 * (i % 45), 1.0 + 0.4 * (i / 45)}});
  world.advance(100.0);
  EXPECT_TRUE(world.counters() == Counters{});
}

TEST(Skipping, NobodyIsEvaluatedButThoseWhoHaveAnEventOrAreAskedFor) {
  World world(rink_of(30.0, 110.0, 1.0, 0.1));
  for (int i = 0; i < 1000; ++i)
    world.add(PuckSpec{.position = {1.0, 0.05 + 0.1 * i}, .velocity = {1.0 + 1e-3 * i, 0.0}});
  double seen = 0.0;
  for (int step = 1; step <= 1000; ++step) {
    world.advance(5e-3 * step);
    seen = world.position({999}).x();
  }
  EXPECT_NEAR(seen, 1.0 + 1.999 * -std::expm1(-0.5) / 0.1, 1e-13);
  EXPECT_EQ(world.counters().evaluations, 0u);
  EXPECT_EQ(world.counters().bodies_touched, 0u);
  EXPECT_EQ(world.counters().events(), 0u);
  EXPECT_GT(world.counters().crossings, 1000u);
}

TEST(Skipping, AMoverFindsThoseThatWereAddedAtRestLater) {
  World world(rink_of(4.0, 2.0));
  const BodyId mover = world.add(PuckSpec{.position = {0.5, 1.0}, .velocity = {1.0, 0.0}});
  for (int i = 0; i < 20; ++i) world.add(PuckSpec{.position = {0.1 + 0.1 * i, 0.1}});
  world.advance(1.0);
  const BodyId late = world.add(PuckSpec{.position = {2.5, 1.0}});
  world.advance(2.5);
  EXPECT_EQ(world.counters().disc_impacts, 1u);
  EXPECT_EQ(world.velocity(mover), Vector2(0.0, 0.0));
  EXPECT_EQ(world.velocity(late), Vector2(1.0, 0.0));
}

}  // namespace
}  // namespace rink::physics::test
