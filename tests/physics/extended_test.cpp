// The engine in extended precision: the same rink as in double, with eleven more bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "game/physics/extended/extended_world.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

/// Six pucks, two posts and a bat under changing keys, with drag.
template <class AnyWorld>
AnyWorld play_short_scene() {
  WorldSpec spec = rink_of(2.0, 1.0, 0.9, 0.1, 1.0);
  spec.field.goal_width = 0.3;
  AnyWorld world(spec);
  for (int i = 0; i < 6; ++i) {
    PuckSpec puck;
    puck.position = {0.3 + 0.25 * i, 0.2 + 0.11 * i};
    puck.velocity = {1.3 - 0.41 * i, 0.7 - 0.3 * i * i};
    puck.mass = 1.0 + 0.3 * i;
    world.add(puck);
  }
  world.add(PostSpec{.position = {0.4, 0.7}, .radius = 0.05});
  world.add(PostSpec{.position = {1.4, 0.15}, .radius = 0.03});
  const BodyId bat = world.add(BatSpec{.position = {1.0, 0.8}, .mass = 3.0});
  double x = 6.0;
  for (double time : {0.1, 0.2, 0.5, 0.9}) {
    while (world.advance(time)) {
    }
    world.set_thrust(bat, {x, -0.5 * x});
    x = -0.7 * x;
  }
  while (world.advance(1.2)) {
  }
  return world;
}

TEST(TheExtendedEngine, AgreesWithTheDoubleOneToRounding) {
  const World world = play_short_scene<World>();
  const ExtendedWorld truth = play_short_scene<ExtendedWorld>();
  ASSERT_GE(world.counters().impacts(), 12u);
  EXPECT_EQ(world.counters().impacts(), truth.counters().impacts());
  long double worst = 0.0;
  for (std::uint32_t body = 0; body < world.body_count(); ++body)
    worst = std::max(worst,
                     (world.position({body}).cast<long double>() - truth.position({body})).norm());
  EXPECT_LT(worst, 1e-11L);  // 2^-53 m, grown by a dozen impacts
  EXPECT_GT(worst, 0.0L);
}

/// An oblique impact of unequal, perfectly elastic pucks at 3/5, 4/5: every number of the answer is
/// rational.
template <class AnyWorld>
long double error_of_an_oblique_impact() {
  AnyWorld world(rink_of(16.0, 16.0));
  const BodyId a =
      world.add(PuckSpec{.position = {4.0, 8.0}, .velocity = {1.0, 0.0}, .radius = 0.25});
  // Contact when the centres are 0.5 apart along (3/5, 4/5) in units of the reach: offset (0.3,
  // 0.4) is not a binary fraction, so take reach 0.625: (0.375, 0.5).
  const BodyId b = world.add(
      PuckSpec{.position = {6.375, 8.5}, .velocity = {0.0, 0.0}, .radius = 0.375, .mass = 2.0});
  world.advance(3.0);
  // At time 2: normal (3/5, 4/5), closing 3/5, impulse 2 (3/5)/(1 + 1/2) = 4/5; a loses it along
  // the normal, b gains half of it.
  const ExtendedVector a_velocity(1.0L - 12.0L / 25.0L, -16.0L / 25.0L),
      b_velocity(6.0L / 25.0L, 8.0L / 25.0L);
  const ExtendedVector at_a = ExtendedVector(6.0L, 8.0L) + a_velocity,
                       at_b = ExtendedVector(6.375L, 8.5L) + b_velocity;
  return std::max((world.position(a).template cast<long double>() - at_a).norm(),
                  (world.position(b).template cast<long double>() - at_b).norm());
}

TEST(TheExtendedEngine, IsNearerToAClosedFormThanTheDoubleOne) {
  const long double in_double = error_of_an_oblique_impact<World>(),
                    extended = error_of_an_oblique_impact<ExtendedWorld>();
  EXPECT_LT(in_double, 4e-15L);
  EXPECT_GT(in_double, 0.0L);
  EXPECT_LT(extended, in_double / 100.0L);
}

}  // namespace
}  // namespace rink::physics::test
