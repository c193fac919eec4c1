// All predicted at once, each pair asked once, or one by one: the same bits.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "game/physics/world.h"
#include "tests/physics/scenes.h"

namespace rink::physics {
namespace {

using namespace test;

constexpr double crowd_side = 2.5;  // m

/// A crowd, some of whom lie still, and posts, in the left of a long field; at its far end there is
/// room for a bat, whom nobody meets for seconds.
World crowd(std::uint64_t seed, std::uint32_t count, double still_share) {
  WorldSpec spec = rink_of(crowd_side + 20.0, crowd_side);
  World world(spec);
  std::mt19937_64 random(seed);
  const auto place = [&] {
    return Vector2(uniform(random, 0.1, crowd_side - 0.1), uniform(random, 0.1, crowd_side - 0.1));
  };
  while (world.body_count() < 3) {
    const PostSpec post{.position = place(), .radius = 0.1};
    if (world.is_free(post.position, post.radius)) world.add(post);
  }
  while (world.body_count() < count + 3) {
    PuckSpec puck{.position = place(), .radius = uniform(random, 0.03, 0.05)};
    if (uniform(random, 0.0, 1.0) >= still_share)
      puck.velocity = {uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0)};
    if (world.is_free(puck.position, puck.radius)) world.add(puck);
  }
  return world;
}

/// Where somebody flies on a curve each body asks for itself.
World asked_one_by_one(std::uint64_t seed, std::uint32_t count, double still_share) {
  World world = crowd(seed, count, still_share);
  world.add(BatSpec{.position = {crowd_side + 19.0, 0.5 * crowd_side}});
  return world;
}

TEST(FirstPredictions, OfPairsAskedOnceHaveTheBitsOfBodiesAskedOneByOne) {
  std::uint64_t impacts = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto count = static_cast<std::uint32_t>(10 * seed);
    const double still_share = seed % 2 == 0 ? 0.0 : 0.3;
    World at_once = crowd(seed, count, still_share),
          one_by_one = asked_one_by_one(seed, count, still_share);
    for (const double until : {0.2, 1.0}) {
      at_once.advance(until);
      one_by_one.advance(until);
      for (std::uint32_t body = 0; body < at_once.body_count(); ++body) {
        ASSERT_EQ(at_once.position({body}), one_by_one.position({body})) << "seed " << seed;
        ASSERT_EQ(at_once.velocity({body}), one_by_one.velocity({body})) << "seed " << seed;
      }
      ASSERT_EQ(at_once.counters().events(), one_by_one.counters().events()) << "seed " << seed;
    }
    impacts += at_once.counters().disc_impacts;
  }
  EXPECT_GT(impacts, 2'000u);
}

/// A snapshot's predictions are all made anew, in the midst of flights.
TEST(FirstPredictions, OfARestoredWorldGoOnWithTheSameBits) {
  World world = crowd(5, 200, 0.0);
  world.advance(0.3);
  std::optional<World> restored = World::restore(world.save());
  ASSERT_TRUE(restored);
  world.advance(1.5), restored->advance(1.5);
  EXPECT_EQ(restored->hash(), world.hash());
}

TEST(Position, HasTheBitsOfTheMotionThatItFollows) {
  for (const double drag : {0.0, 0.3}) {
    World world(rink_of(3.0, 2.0, 0.9, drag, 1.0));
    std::mt19937_64 random(3);
    const std::vector<BodyId> bats = scatter_bats(world, random, 2);
    scatter_posts(world, random, 2);
    scatter_pucks(world, random, 30);
    world.set_thrust(bats[0], {1.0, 0.5});
    for (int k = 1; k <= 100; ++k) {
      world.advance(0.01 * k);
      for (std::uint32_t body = 0; body < world.body_count(); ++body)
        ASSERT_EQ(world.position({body}), world.motion({body}).at(world.now()).position);
    }
  }
}

}  // namespace
}  // namespace rink::physics
