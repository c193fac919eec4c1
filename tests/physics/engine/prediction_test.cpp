// How many pairs a bat's prediction solves, and what a prediction takes for two impacts at once.
#include "game/physics/engine/prediction.h"

#include <gtest/gtest.h>

#include "game/physics/engine/engine.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

/// Pairs solved per change of a key, which makes the bat look at all in its sight: the mean over
/// 2,000 of them, 1 ms apart.
double pairs_per_key(World& world, const std::vector<BodyId>& bats) {
  std::mt19937_64 random(7);
  const auto axis = [&] { return 6.0 * (static_cast<double>(random() % 3) - 1.0); };
  std::uint64_t pairs = 0, keys = 0;
  while (keys < 2000) {
    world.advance(world.now() + 1e-3);
    const BodyId bat = bats[random() % bats.size()];
    const Vector2 thrust(axis(), axis());
    if (world.thrust(bat) == thrust) continue;
    const std::uint64_t before = world.counters().predictions;
    world.set_thrust(bat, thrust);
    pairs += world.counters().predictions - before, ++keys;
  }
  return static_cast<double>(pairs) / static_cast<double>(keys);
}

TEST(Prediction, ABatInACrowdSolvesAtMostFivePairsPerKey) {
  World world(rink_of(20.0, 10.0, 0.9, 0.2, 1.0));
  std::mt19937_64 random(2);
  std::vector<BodyId> bats;
  while (bats.size() < 100) {
    const BatSpec bat{.position = {uniform(random, 0.1, 19.9), uniform(random, 0.1, 9.9)},
                      .half_extent = {0.04, 0.1},
                      .mass = 3.0};
    if (world.is_free(bat.position, bat.half_extent)) bats.push_back(world.add(bat));
  }
  scatter_pucks(world, random, 1000, 0.2, 0.2);
  EXPECT_LT(pairs_per_key(world, bats), 5.0);
  EXPECT_GT(world.counters().bat_impacts, 100u);
}

/// It is in sight of every tenth of 1,000 pucks or more, and boxes tell that few can come in time.
TEST(Prediction, ALongBatSolvesAtMostFivePairsPerKey) {
  World world(rink_of(10.0, 2.0, 0.9, 0.2, 1.0));
  std::mt19937_64 random(3);
  const BodyId bat =
      world.add(BatSpec{.position = {5.0, 1.0}, .half_extent = {0.05, 0.9}, .mass = 50.0});
  for (int tries = 0; world.body_count() < 1001 && tries < 100'000; ++tries) {
    const PuckSpec puck{.position = {uniform(random, 0.02, 9.98), uniform(random, 0.02, 1.98)},
                        .velocity = {uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)},
                        .radius = 0.02,
                        .mass = 0.2};
    if (world.is_free(puck.position, puck.radius)) world.add(puck);
  }
  ASSERT_EQ(world.body_count(), 1001u);
  EXPECT_LT(pairs_per_key(world, {bat}), 5.0);
  EXPECT_GT(world.counters().bat_impacts, 100u);
}

/// A puck that slides along a wall which it will hit meets that wall anew in each of its cells; and
/// of two that see each other again, one may know already when they meet.
TEST(Prediction, WhatIsKnownAlreadyIsNoSecondImpact) {
  Engine engine(rink_of(40.0, 2.0));
  BodyState slider;
  slider.flight = {1.0, 0.3, 0.6, -0.01, 0.0, 0.04};
  engine.add(slider);
  BodyState hunter = slider;
  hunter.flight = {1.0, 1.4, 1.6, 0.002, 0.0, 0.04};
  engine.add(hunter);
  BodyState hunted = slider;
  hunted.flight = {2.6, 1.45, 1.2, 0.002, 0.0, 0.04};
  engine.add(hunted);
  const Engine::Parts parts = engine.parts();
  engine.predict_pending();
  const Real until = 25.0;
  for (std::uint32_t body = parts.events.first(until); body != NextEvents::none;
       body = parts.events.first(until)) {
    engine.process(body, parts.events.time(body));
    for (std::uint32_t other = 0; other < parts.bodies.count(); ++other)
      EXPECT_FALSE(parts.events[other].is_tied) << other << " at " << parts.clock.now;
  }
  EXPECT_GT(parts.record.counters().crossings, 10u);
  EXPECT_GT(parts.record.counters().disc_impacts, 0u);
}

}  // namespace
}  // namespace rink::physics::test
