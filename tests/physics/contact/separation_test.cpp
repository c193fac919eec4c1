// What an impact leaves at least: the separation of 1e-14 (|v| + |v'|) that keeps a contact from
// being found again, whatever the partner and the way the impact is solved.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

/// Roundings of velocities of 1 m/s, as they enter a difference of four.
constexpr double roundings = 1e-15;

constexpr double parting_radius = 0.03125;

PuckSpec parting_ball(const Vector2& position, const Vector2& velocity = {0.0, 0.0},
                      double mass = 1.0) {
  return {.position = position, .velocity = velocity, .radius = parting_radius, .mass = mass};
}

/// Surfaces that rub without friction take another way through the engine.
WorldSpec lossy_field(bool is_rough) {
  WorldSpec spec = rink_of(4, 4, 0.0);
  const SurfaceFriction slippery{PairTable(1, 0.0), RestitutionTable(1, 0.0)};
  if (is_rough) spec.surface_friction = slippery;
  return spec;
}

void expect_least_separation(World& world, double until, double parting, double speeds) {
  EXPECT_EQ(world.counters().impacts(), 1u) << until;
  EXPECT_NEAR(parting, 1e-14 * speeds, roundings * speeds);
}

TEST(LeastSeparation, IsLeftByEveryPartnerWhereRestitutionIsNone) {
  for (const bool is_rough : {false, true})
    for (const double across : {0.0, 0.75}) {
      SCOPED_TRACE(testing::Message() << "rough " << is_rough << ", " << across << " m/s across");
      const double speed = std::hypot(1.0, across);
      for (const int axis : {0, 1})
        for (const double side : {-1.0, 1.0}) {
          World world(lossy_field(is_rough));
          Vector2 velocity(across, across);
          velocity[axis] = side;
          const BodyId ball = world.add(parting_ball({2.0, 2.0}, velocity));
          world.advance(2.0);
          expect_least_separation(world, 2.0, -side * world.velocity(ball)[axis], speed);
        }
      const double wait = 1.0 - 2.0 * parting_radius;
      const Vector2 start(1.0, 2.0 - across * wait);
      {
        World world(lossy_field(is_rough));
        const BodyId ball = world.add(parting_ball(start, {1.0, across}));
        world.add(PostSpec{.position = {2.0, 2.0}, .radius = parting_radius});
        world.advance(1.0);
        expect_least_separation(world, 1.0, -world.velocity(ball).x(), speed);
      }
      {
        World world(lossy_field(is_rough));
        const BodyId ball = world.add(parting_ball(start, {1.0, across}));
        const BatSpec before{.position = {2.0, 2.0}, .half_extent = {parting_radius, 0.25}};
        const BodyId bat = world.add(before);
        world.advance(1.0);
        const double parting = world.velocity(bat).x() - world.velocity(ball).x();
        expect_least_separation(world, 1.0, parting, speed);
      }
      {
        World world(lossy_field(is_rough));
        const BodyId ball = world.add(parting_ball(start, {1.0, across}, 0.5));
        const BodyId other = world.add(parting_ball({2.0, 2.0}));
        world.advance(1.0);
        const double parting = world.velocity(other).x() - world.velocity(ball).x();
        expect_least_separation(world, 1.0, parting, speed);
      }
    }
}

TEST(LeastSeparation, CountsTheSpeedsOfBoth) {
  World world(lossy_field(false));
  const BodyId left = world.add(parting_ball({1.0, 2.0}, {3.0, 0.0}));
  const BodyId right = world.add(parting_ball({2.0, 2.0}, {-5.0, 0.0}));
  world.advance(0.25);
  const double parting = world.velocity(right).x() - world.velocity(left).x();
  expect_least_separation(world, 0.25, parting, 8.0);
}

/// A ball that two others take between them: all three contacts of the joint impact are left so.
TEST(LeastSeparation, IsLeftByAJointImpact) {
  World world(lossy_field(false));
  const BodyId cue = world.add(parting_ball({0.5, 1.0}, {1.0, 0.0}));
  const BodyId above = world.add(parting_ball({1.0, 1.0 + parting_radius}));
  const BodyId below = world.add(parting_ball({1.0, 1.0 - parting_radius}));
  world.advance(0.75);
  ASSERT_EQ(world.counters().joint_impacts, 1u);
  const Vector2 up(std::sqrt(0.75), 0.5), down(std::sqrt(0.75), -0.5);
  EXPECT_NEAR(up.dot(world.velocity(above) - world.velocity(cue)), 1e-14, roundings);
  EXPECT_NEAR(down.dot(world.velocity(below) - world.velocity(cue)), 1e-14, roundings);
  EXPECT_EQ(world.counters().impacts(), 2u);
}

}  // namespace
}  // namespace rink::physics::test
