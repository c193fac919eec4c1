// When impacts that follow each other too fast are ended by a hop, how fast it parts, what energy
// it brings, and what stops instead.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

constexpr double hop_radius = 0.03125;

/// A puck between two walls that leave it `room` [m], on its way across at `speed` [m/s]. It meets
/// one or the other every room/speed seconds, and hardly loses any speed.
World puck_with_room(double room, const Vector2& velocity) {
  World world(rink_of(4, 2.0 * hop_radius + room, 1.0 - 1e-9));
  world.add(PuckSpec{
      .position = {2.0, hop_radius + 0.5 * room}, .velocity = velocity, .radius = hop_radius});
  return world;
}

TEST(Hop, EndsEightSlowOrTwentyFourImpactsOfAnySpeedWithinAContactTime) {
  const double contact_time = WorldSpec().contact_time;
  // The first of n impacts and the last are n - 1 ways apart.
  const struct {
    double room;
    std::uint64_t impacts;
    bool is_slow;
  } series[] = {{0.5e-6, 8, true}, {1e-6, 24, false}};
  for (const auto& [room, impacts, is_slow] : series) {
    SCOPED_TRACE(impacts);
    const double ways = static_cast<double>(impacts) - 1.0, speed = ways * room / contact_time;
    ASSERT_EQ(speed < 20.0 * contact_time, is_slow);
    const double step = contact_time / ways;
    World fast = puck_with_room(room, {0.0, 1.02 * speed});
    fast.advance((ways + 0.25) * step / 1.02);  // the last of them comes half a way later
    EXPECT_EQ(fast.counters().wall_impacts, impacts - 1);
    EXPECT_EQ(fast.counters().hops, 0u);
    fast.advance((ways + 0.75) * step / 1.02);
    EXPECT_EQ(fast.counters().wall_impacts, impacts);
    EXPECT_EQ(fast.counters().hops, 1u);
    World slow = puck_with_room(room, {0.0, 0.98 * speed});
    slow.advance(100.0 * step / 0.98);
    EXPECT_EQ(slow.counters().wall_impacts, 100u);
    EXPECT_EQ(slow.counters().hops, 0u);
  }
}

TEST(Hop, StopsWhatCreeps) {
  for (const double along : {0.5e-9, 1.1e-9}) {
    SCOPED_TRACE(along);
    World world = puck_with_room(0x1p-45, {along, 0.7e-9});
    const bool creeps = std::hypot(along, 0.7e-9) < 1e-9;
    world.advance(1.0);
    EXPECT_EQ(world.counters().hops, 1u);
    EXPECT_EQ(world.velocity({0}), Vector2(creeps ? 0.0 : along, 0.0));
  }
}

/// A bat whose corner is pressed to a post, not straight: it hops off along the normal by half of
/// what its thrust builds up in a contact time, at most by half the rest speed, and takes that as
/// energy.
TEST(Hop, PartsByHalfOfWhatThrustBuildsUpInAContactTime) {
  const Vector2 normal(0.6, 0.8);
  const double mass = 3.0, post_radius = 0.25;
  for (const double contact_time : {5e-4, 2e-3})
    for (const double thrust : {2.0, 8.0, 50.0}) {
      SCOPED_TRACE(testing::Message() << contact_time << " " << thrust);
      WorldSpec spec = rink_of(4, 4, 0.5);
      spec.contact_time = contact_time;
      spec.puck_friction = 1.0;  // where there is some, a cluster hops and does not glide
      World world(spec);
      world.add(PostSpec{.position = {1.0, 1.0}, .radius = post_radius});
      const Vector2 half_extent(0.125, 0.125);
      // A rounding above the post, for a place on it may not be free.
      const Vector2 corner = Vector2(1.0, 1.0) + (post_radius + 4e-16) * normal;
      const BodyId bat = world.add(
          BatSpec{.position = corner + half_extent, .half_extent = half_extent, .mass = mass});
      world.set_thrust(bat, {-thrust, 0.0});
      world.advance(1e-6);
      ASSERT_EQ(world.counters().hops, 1u);
      EXPECT_EQ(world.counters().post_impacts, 8u);
      const double parting = std::min(0.5 * thrust * contact_time, 10.0 * contact_time);
      EXPECT_NEAR(normal.dot(world.velocity(bat)), parting - 0.6 * thrust * 1e-6, 2e-6);
      EXPECT_NEAR(world.counters().hop_energy, 0.5 * mass * parting * parting,
                  1e-6 * mass * parting);
    }
}

/// A puck in or near a corner, under a bat of any shape that is driven into the corner: its normals
/// turn while it slides off, but a glide costs one event where hops would cost one in each
/// contact_time.
TEST(Hop, GlidesSoThatAPuckInACornerCostsFewEvents) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    World world(rink_of(2, 1, 0.5, seed % 2 == 0 ? 0.0 : uniform(random, 0.0, 0.5),
                        seed % 4 < 2 ? 0.0 : uniform(random, 0.0, 3.0)));
    const BatSpec bat{.position = {uniform(random, 0.4, 1.5), uniform(random, 0.4, 0.69)},
                      .half_extent = {uniform(random, 0.02, 0.3), uniform(random, 0.02, 0.3)},
                      .mass = uniform(random, 0.5, 5.0)};
    const bool is_in_corner = seed % 3 == 0;
    const PuckSpec puck{
        .position = is_in_corner ? Vector2(0.04, 0.04)
                                 : Vector2(uniform(random, 0.04, 0.3), uniform(random, 0.04, 0.3)),
        .mass = uniform(random, 0.02, 1.0)};
    const double thrust = uniform(random, 2.0, 20.0),
                 angle = seed % 2 == 0 ? 0.7853981633974483 : uniform(random, 0.1, 1.5);
    world.add(puck);
    if (!world.is_free(bat.position, bat.half_extent)) continue;
    world.set_thrust(world.add(bat), -thrust * Vector2(std::cos(angle), std::sin(angle)));
    world.advance(20.0);
    EXPECT_LT(world.counters().events(), 2000u);
    EXPECT_LT(world.max_overlap(), 1e-9);
  }
}

}  // namespace
}  // namespace rink::physics::test
