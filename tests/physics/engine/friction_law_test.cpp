// Coulomb's law for single pucks and for those that are pushed together, without any contact: the
// deceleration, the stop, the static share, and friction that turns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "game/physics/engine/friction.h"
#include "tests/physics/bodies/loose_bodies.h"

namespace rink::physics::test {
namespace {

constexpr double rubbing = 1.5;  // m/s^2

struct RoughTable : LooseBodies {
  Friction friction;

  explicit RoughTable(double puck_drag = 0.0, double bat_drag = 0.0)
      : LooseBodies(spec_of(puck_drag, bat_drag)), friction(spec, bodies) {}

 private:
  static WorldSpec spec_of(double puck_drag, double bat_drag) {
    WorldSpec spec = rink_of(10, 10, 1.0, puck_drag, bat_drag);
    spec.puck_friction = rubbing;
    return spec;
  }
};

/// v/k without drag, log(1 + g v/k)/g with it.
TEST(FrictionLaw, BringsAPuckToRestOnAStraightLine) {
  for (const double drag : {0.0, 0.7}) {
    RoughTable table(drag);
    const std::uint32_t puck = table.add_puck({1.0, 1.0}, {3.0, -4.0});
    table.friction.slide(puck, std::nullopt);
    const Motion motion = table.bodies.motion(puck);
    EXPECT_LT((motion.acceleration - Vector2(-0.6, 0.8) * rubbing).norm(), 1e-15);
    EXPECT_NEAR(motion.rest_time,
                drag == 0.0 ? 5.0 / rubbing : std::log1p(drag * 5.0 / rubbing) / drag, 1e-14);
    EXPECT_EQ(motion.at(motion.rest_time + 1.0).velocity, Vector2(0.0, 0.0));
  }
}

TEST(FrictionLaw, DoesNothingToBats) {
  RoughTable table;
  const std::uint32_t bat = table.add_bat({1.0, 1.0}, {3.0, -4.0});
  table.thrust(bat, {5.0, 0.0});
  table.friction.slide(bat, std::nullopt);
  table.friction.face({bat});
  EXPECT_EQ(table.bodies.motion(bat).acceleration, Vector2(0.0, 0.0));
  EXPECT_EQ(table.friction.own_push(bat, 0), 5.0);
  EXPECT_EQ(table.friction.aim(0, {bat}, 1.0), std::numeric_limits<double>::infinity());
}

/// Along the axis of its group a pushed puck has the law of the group; across it slides by itself.
TEST(FrictionLaw, LeavesAPushedPuckTheLawOfItsGroupAlongTheAxis) {
  RoughTable table;
  const std::uint32_t puck = table.add_puck({1.0, 1.0}, {3.0, -4.0});
  table.friction.face({puck});
  table.bodies.set_law(puck, 0, 2.5, 0.0);
  table.friction.slide(puck, 0);
  EXPECT_EQ(table.bodies.law(puck).acceleration.x(), 2.5);
  EXPECT_NEAR(table.bodies.law(puck).acceleration.y(), 0.8 * rubbing, 1e-15);
  EXPECT_EQ(table.bodies.rest_time(puck), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(table.friction.own_push(puck, 0), -0.6 * rubbing, 1e-15);
}

TEST(FrictionLaw, CalmsWhatHasComeToNothingAndNoMore) {
  RoughTable table;
  const std::uint32_t slow = table.add_puck({1.0, 1.0}, {0.9e-9, -0.9e-9}),
                      quick = table.add_puck({2.0, 1.0}, {1.1e-9, 1.1e-9}),
                      bat = table.add_bat({3.0, 1.0}, {0.9e-9, 0.9e-9});
  table.friction.reset_friction(0, {slow});
  EXPECT_EQ(table.bodies.velocity(slow), Vector2(0.0, 0.0));
  table.friction.reset_friction(0, {quick});
  EXPECT_EQ(table.bodies.velocity(quick), Vector2(1.1e-9, 1.1e-9));
  table.friction.reset_friction(
      0, {bat});  // along the axis all share one velocity; across, none slows a bat
  EXPECT_EQ(table.bodies.velocity(bat), Vector2(0.0, 0.9e-9));
}

/// A puck at rest resists up to mu g, whatever side the push comes from; what slides does not.
TEST(FrictionLaw, ResistsAPushAsFarAsCoulombsLawLetsIt) {
  for (const double push : {0.4 * rubbing, -0.9 * rubbing, 1.1 * rubbing, -3.0 * rubbing}) {
    RoughTable table;
    const std::uint32_t resting = table.add_puck({1.0, 1.0}),
                        sliding = table.add_puck({2.0, 1.0}, {0.0, 1.0});
    std::vector<double> accelerations{push, push};
    const double change = table.friction.resist(0, {resting, sliding}, accelerations);
    const double left = std::max(0.0, std::abs(push) - rubbing);
    EXPECT_NEAR(std::abs(accelerations[resting]), left, 1e-15);
    EXPECT_NEAR(change, std::min(std::abs(push), rubbing), 1e-15);
    EXPECT_EQ(accelerations[sliding], push);
    EXPECT_EQ(table.friction.bears_more(resting, 0), std::abs(push) < rubbing);
    EXPECT_FALSE(table.friction.bears_more(sliding, 0));
    EXPECT_NEAR(table.friction.resist(0, {resting, sliding}, accelerations), 0.0, 1e-15);
  }
}

/// A bat of mass M and a puck of mass m go on together and straight: their deceleration is
/// m mu g/(M + m), and friction is next looked at when they have stopped.
TEST(FrictionLaw, IsAimedAnewWhenAStraightGroupStops) {
  RoughTable table;
  const std::uint32_t bat = table.add_bat({1.0, 1.0}, {2.0, 0.0}, 3.0),
                      puck = table.add_puck({1.2, 1.0}, {2.0, 0.0}, 0.5);
  table.friction.face({bat, puck});
  EXPECT_FALSE(table.friction.has_sliders(0, {bat, puck}));
  EXPECT_NEAR(table.friction.aim(0, {bat, puck}, 10.0), 10.0 + 2.0 * 3.5 / (0.5 * rubbing), 1e-13);
}

/// A puck that is pushed along x and slides along y: arc by arc, its velocity follows that of the
/// differential equation, integrated in steps of 1e-5 s by the classical Runge-Kutta method.
TEST(FrictionLaw, FollowsAFrictionThatTurns) {
  constexpr double drag = 0.4, thrust = 4.0, until = 0.6;
  RoughTable table(drag, drag);
  const std::uint32_t bat = table.add_bat({1.0, 1.0}, {1.0, 0.0}, 3.0),
                      puck = table.add_puck({1.2, 1.0}, {1.0, 1.2}, 0.5);
  table.thrust(bat, {thrust, 0.0});
  const std::vector<std::uint32_t> members{bat, puck};
  const auto rate = [&](const Vector2& v) {  // of the puck; the bat shares its first component
    const Vector2 rubbed = -rubbing * v / v.norm();
    return Vector2((3.0 * thrust + 0.5 * rubbed.x()) / 3.5 - drag * v.x(),
                   rubbed.y() - drag * v.y());
  };
  Vector2 expected(1.0, 1.2);
  constexpr int steps = 60'000;
  for (int step = 0; step < steps; ++step) {
    const double h = until / steps;
    const Vector2 a = rate(expected), b = rate(expected + 0.5 * h * a),
                  c = rate(expected + 0.5 * h * b), d = rate(expected + h * c);
    expected += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  double time = 0.0;
  int arcs = 0;
  while (time < until) {
    ASSERT_LT(++arcs, 1000);
    table.friction.face(members);
    ASSERT_TRUE(table.friction.has_sliders(0, members));
    const double next = std::min(until, table.friction.aim(0, members, time));
    ASSERT_GT(next, time);
    EXPECT_NEAR(table.bodies.slowing(puck).norm(), rubbing, 1e-14);
    const double push =
        (3.0 * table.friction.own_push(bat, 0) + 0.5 * table.friction.own_push(puck, 0)) / 3.5;
    const double e = std::exp(-drag * (next - time)), s = (1.0 - e) / drag;
    const Vector2 now = table.bodies.velocity(puck);
    const Vector2 then(now.x() * e + push * s, now.y() * e + table.bodies.slowing(puck).y() * s);
    const double turned = std::abs(std::atan2(then.y(), then.x()) - std::atan2(now.y(), now.x()));
    EXPECT_LT(turned, 1.1 / 128.0);
    table.bodies.set_velocity(puck, then), table.bodies.set_velocity(bat, {then.x(), 0.0});
    time = next;
  }
  EXPECT_LT((table.bodies.velocity(puck) - expected).norm(), 1e-4);
  EXPECT_GT(arcs, 20);
}

}  // namespace
}  // namespace rink::physics::test
