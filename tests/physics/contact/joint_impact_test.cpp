// The guards of joint impacts: which impacts are one, that none of them gains energy, and that
// those without an end come to rest.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

constexpr double ball_radius = 0.03125;

PuckSpec joint_ball(const Vector2& place, const Vector2& velocity = {0.0, 0.0}, double mass = 1.0) {
  return {.position = place, .velocity = velocity, .radius = ball_radius, .mass = mass};
}

/// A ball that hits two at once, which stand at 30 degrees to its way.
World ball_between_two(double speed, double mass, double restitution) {
  World world(rink_of(4, 2, restitution));
  world.add(joint_ball({0.9375, 1.0}, {speed, 0.0}, mass));
  for (const double side : {-1.0, 1.0})
    world.add(joint_ball({1.0, 1.0 + side * ball_radius}, {0.0, 0.0}, mass));
  return world;
}

/// What a push of 1 does to masses of 1e156 kg and more has squares below the smallest normal
/// number, so that directions of unit length are not: they missed by up to 2 % of the energy.
TEST(JointImpact, NeverGainsEnergyWhereMassesLeaveTooFewDigits) {
  for (double exponent = 150.0; exponent <= 161.0; exponent += 0.25) {
    SCOPED_TRACE(exponent);
    World world = ball_between_two(1.0, std::pow(10.0, exponent), 1.0);
    const double energy = world.kinetic_energy();
    world.advance(0.25);
    EXPECT_EQ(world.counters().disc_impacts, 2u);
    EXPECT_LE(world.kinetic_energy(), energy * (1.0 + 1e-12));
  }
}

/// A ball hits the middle of a column that fills the field from wall to wall. Both that it hits are
/// pushed along the column as well, to and fro between the walls: the rounds of that never end, and
/// what is left of them comes to rest. Across the column nothing is in the way: each of the two
/// takes p cos(30) with p = (1 + e) cos(30)/(2 + cos(60)).
TEST(JointImpact, WithoutAnEndComesToRestAndLeavesTheRest) {
  for (const double restitution : {0.5, 0.99, 0.999})
    for (const int count : {4, 8, 16}) {
      SCOPED_TRACE(testing::Message() << count << " balls, restitution " << restitution);
      const double width = 2.0 * ball_radius * count;
      World world(rink_of(4, width, restitution));
      for (int i = 0; i < count; ++i) world.add(joint_ball({1.0, (2 * i + 1) * ball_radius}));
      const BodyId ball = world.add(joint_ball({0.5, 0.5 * width}, {1.0, 0.0}));
      const double closing = std::sqrt(0.75), push = (1.0 + restitution) * closing / 2.5;
      world.advance(0.75);
      EXPECT_EQ(world.counters().joint_impacts, 1u);
      EXPECT_NEAR(world.velocity(ball).x(), 1.0 - 2.0 * push * closing, 1e-13);
      EXPECT_NEAR(world.velocity(ball).y(), 0.0, 1e-13);
      for (int i = 0; i < count; ++i) {
        const bool is_hit = i == count / 2 || i == count / 2 - 1;
        const Vector2 velocity = world.velocity(BodyId{static_cast<std::uint32_t>(i)});
        EXPECT_NEAR(velocity.x(), is_hit ? push * closing : 0.0, 1e-13) << i;
        EXPECT_NEAR(velocity.y(), 0.0, 1e-13) << i;
      }
      EXPECT_LE(world.counters().events_at_once_max, 20u);
    }
}

/// Contacts that close more slowly than 32 roundings of an offset in 1e-9 s are taken one by one:
/// the first takes c of the speed, the second c (1 - n . n'), half of that.
TEST(JointImpact, TakesContactsOneByOneThatCloseTooSlowlyToShareAnInstant) {
  const double closing = std::sqrt(0.75), slowest = 32.0 * 0x1p-52 * (4.0 + 2.0) / 1e-9;
  for (const double part : {0.9, 1.1}) {
    SCOPED_TRACE(part);
    const double speed = part * slowest / closing;
    World world = ball_between_two(speed, 1.0, 1.0);
    world.advance(0.01 / speed);
    EXPECT_EQ(world.counters().joint_impacts, part > 1.0 ? 1u : 0u);
    const double together = 2.0 * closing / 2.5;
    const double first = part > 1.0 ? together : closing;
    const double second = part > 1.0 ? together : 0.5 * closing;
    EXPECT_NEAR(world.velocity({1}).norm(), first * speed, 1e-10 * speed);
    EXPECT_NEAR(world.velocity({2}).norm(), second * speed, 1e-10 * speed);
  }
}

/// Two balls hit the ends of a row at one instant but for roundings of the clock, which the
/// calendar keeps in two buckets: buckets of a new world are a millisecond wide.
TEST(JointImpact, IsOneWhereAnInstantLiesOnTheEdgeOfABucket) {
  const std::vector<double> masses{1.0, 3.0, 0.25, 5.0, 0.25, 3.0, 1.0};
  for (const QueuePolicy queue : {QueuePolicy::calendar, QueuePolicy::heap, QueuePolicy::windows})
    for (const double instant : {0.125, 0.25, 0.375})
      for (const int nearer : {0, 6}) {
        SCOPED_TRACE(testing::Message() << "at " << instant << " s, ball " << nearer << " first");
        WorldSpec spec = rink_of(4, 1);
        spec.queue = queue;
        spec.cell_size = 8.0;  // no crossing of cells is an event beside the two
        World world(spec);
        for (int i = 0; i < 7; ++i) {
          const bool is_end = i == 0 || i == 6;
          double x = 2.0 + (i - 3) * 2.0 * ball_radius;
          if (is_end) x += i == 0 ? -instant : instant;
          if (i == nearer) x = std::nextafter(x, 2.0);
          const Vector2 velocity(is_end ? (i == 0 ? 1.0 : -1.0) : 0.0, 0.0);
          world.add(joint_ball({x, 0.5}, velocity, masses[static_cast<std::size_t>(i)]));
        }
        world.advance(instant + 0.01);
        EXPECT_EQ(world.counters().joint_impacts, 1u);
        for (std::uint32_t i = 0; i < 7; ++i)
          EXPECT_NEAR(world.velocity({i}).x(), -world.velocity({6 - i}).x(), 1e-12) << i;
      }
}

}  // namespace
}  // namespace rink::physics::test
