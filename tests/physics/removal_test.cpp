// A body that is removed is gone at once: whoever was due to hit it, leant on it or stood between
// it and others goes on without it.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "tests/physics/scenes.h"
#include "tests/physics/slab_scene.h"

namespace rink::physics::test {
namespace {

TEST(Removal, OfAPostLetsAPuckPassThatWasDueToHitIt) {
  for (const double radius : {0.0, 0.02, 0.05, 0.3})
    for (const double begin : {0.0, 0.125}) {
      SCOPED_TRACE(testing::Message() << "radius " << radius << ", removed at " << begin);
      World world(rink_of(4, 2));
      const BodyId post = world.add(PostSpec{.position = {2.0, 1.0}, .radius = radius}),
                   puck = world.add(PuckSpec{.position = {1.0, 1.0}, .velocity = {1.0, 0.0}});
      world.advance(begin);
      world.remove(post);
      world.advance(2.0);
      EXPECT_EQ(world.counters().post_impacts, 0u);
      EXPECT_EQ(world.position(puck), Vector2(3.0, 1.0));
      EXPECT_EQ(world.velocity(puck), Vector2(1.0, 0.0));
    }
}

/// One that is restored there predicts everything anew, and knows no post.
void expect_to_go_on_as_if_restored(World& world, const std::optional<SlabPlan>& plan) {
  std::optional<World> restored = World::restore(world.save(), plan);
  ASSERT_TRUE(restored);
  for (int stop = 0; stop < 4; ++stop) {
    const double until = world.now() + 0.25;
    world.advance(until), restored->advance(until);
    ASSERT_EQ(world.hash(), restored->hash());
    ASSERT_EQ(world.counters().post_impacts, restored->counters().post_impacts);
  }
}

TEST(Removal, OfPostsLeavesAWorldThatNeverHadThem) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    WorldSpec spec = rink_of(4, 2, seed % 2 == 0 ? 1.0 : 0.7, seed % 3 == 0 ? 0.2 : 0.0);
    if (seed % 4 == 0) spec.puck_friction = 0.2;
    if (seed % 5 == 0)
      spec.surface_friction = SurfaceFriction{PairTable(1, 0.5), RestitutionTable(1, 0.5)};
    const bool has_tiles = seed % 4 == 1;
    spec.slabs.reset();
    if (has_tiles) spec.slabs = small_tiles(4, 1, 1.0);
    World world(spec);
    const std::vector<BodyId> posts = scatter_posts(world, random, 12),
                              bats = scatter_bats(world, random, 3);
    scatter_pucks(world, random, 60);
    for (const BodyId bat : bats)
      world.set_thrust(bat, {uniform(random, -6.0, 6.0), uniform(random, -6.0, 6.0)});
    for (const BodyId post : posts) {
      world.advance(world.now() + uniform(random, 0.0, 0.2));
      world.remove(post);
      expect_to_go_on_as_if_restored(world, spec.slabs);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

/// A bat presses a puck to a post in line with it; then both accelerate at M a/(M + m).
TEST(Removal, OfAPostFreesWhoIsPressedToIt) {
  constexpr double thrust = 4.0, bat_mass = 3.0, puck_mass = 1.0;
  World world(rink_of(4, 2, 0.5));
  const BodyId bat = world.add(BatSpec{.position = {1.0, 1.0}, .mass = bat_mass}),
               puck = world.add(PuckSpec{.position = {1.1, 1.0}, .mass = puck_mass}),
               post = world.add(PostSpec{.position = {1.2, 1.0}, .radius = 0.05});
  world.set_thrust(bat, {thrust, 0.0});
  world.advance(1.0);
  ASSERT_EQ(world.velocity(bat), Vector2(0.0, 0.0));
  ASSERT_EQ(world.velocity(puck), Vector2(0.0, 0.0));
  const double from = world.position(puck).x();
  world.remove(post);
  world.advance(1.5);
  const double acceleration = thrust * bat_mass / (bat_mass + puck_mass);
  EXPECT_NEAR(world.position(puck).x() - from, 0.5 * acceleration * 0.25, 1e-9);
  EXPECT_EQ(world.velocity(puck), world.velocity(bat));
}

/// A bat presses a puck into the gap between two posts, where it stands.
TEST(Removal, OfAPostWakesWhoStoodOnIt) {
  World world(rink_of(2, 2, 0.5));
  const BodyId left = world.add(PostSpec{.position = {0.95, 0.5}, .radius = 0.03}),
               right = world.add(PostSpec{.position = {1.05, 0.5}, .radius = 0.03}),
               puck = world.add(PuckSpec{.position = {1.0, 0.5491}}),
               bat = world.add(BatSpec{.position = {1.0, 0.64}, .half_extent = {0.3, 0.05}});
  world.set_thrust(bat, {0.0, -20.0});
  world.advance(1.0);
  const Vector2 stood = world.position(puck);
  world.advance(1.1);
  ASSERT_EQ(world.position(puck), stood);
  ASSERT_TRUE(world.is_held(puck));
  world.remove(right);
  world.advance(1.15);
  EXPECT_GT(world.position(puck).x(), stood.x() + 1e-3);
  EXPECT_LE(world.max_overlap(), 1e-9);
  EXPECT_TRUE(world.is_in_play(left));
}

}  // namespace
}  // namespace rink::physics::test
