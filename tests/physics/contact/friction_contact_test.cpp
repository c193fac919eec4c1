// Pucks under Coulomb friction that bats push, lean on and let go: rest contacts that cost no
// events, against closed forms and against integration in extended precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

using Real = long double;

constexpr double friction = 2.0, slippery_bat_drag = 1.5;

WorldSpec slippery(double restitution, double puck_drag = 0.0) {
  WorldSpec spec = rink_of(20, 10, restitution, puck_drag, slippery_bat_drag);
  spec.puck_friction = friction;
  spec.accounts_energy = true;
  return spec;
}

BodyId add_bat(World& world, double x, double y, double half_width = 1.0) {
  BatSpec bat;
  bat.position = {x, y};
  bat.half_extent = {0.0625, half_width};  // touching puck and bat without rounding
  return world.add(bat);
}

BodyId add_puck(World& world, double x, double y, double vx = 0.0, double vy = 0.0,
                double mass = 0.5) {
  PuckSpec puck;
  puck.position = {x, y};
  puck.velocity = {vx, vy};
  puck.mass = mass;
  puck.radius = 0.0625;
  return world.add(puck);
}

void expect_balanced(const World& world) {
  const double turned_over = world.work_of_thrust() + world.dissipated() + world.kinetic_energy();
  EXPECT_NEAR(world.energy_introduced() + world.work_of_thrust() - world.dissipated(),
              world.kinetic_energy(), 1e-12 * turned_over);
}

/// From rest, v = b/g (1 - exp(-g t)) with what drives and what brakes the whole group per mass.
double speed_after(double driving, double drag, double time) {
  return driving / drag * -std::expm1(-drag * time);
}
double way_after(double driving, double drag, double time) {
  return driving / drag * (time - -std::expm1(-drag * time) / drag);
}

TEST(PushedPuck, ObeysTheClosedFormOfTheWholeGroupWithoutEvents) {
  for (const double restitution : {0.0, 0.5, 1.0}) {
    for (int count = 1; count <= 3; ++count) {
      SCOPED_TRACE(testing::Message() << restitution << " " << count);
      World world(slippery(restitution));
      const BodyId bat = add_bat(world, 2, 5);
      std::vector<BodyId> pucks;
      for (int k = 0; k < count; ++k) pucks.push_back(add_puck(world, 2.125 + 0.125 * k, 5));
      world.set_thrust(bat, {8, 0});
      const double total = 1.0 + 0.5 * count, driving = (8.0 - 0.5 * count * friction) / total,
                   drag = slippery_bat_drag / total, time = 1.5;
      world.advance(time);
      const double rounding =
          1e-12 +
          1e-8 * restitution;  // elastic contacts come to rest in a few bounces of less than v_c
      EXPECT_NEAR(world.velocity(pucks.back()).x(), speed_after(driving, drag, time),
                  100 * rounding);
      EXPECT_NEAR(world.position(bat).x() - 2.0, way_after(driving, drag, time), 100 * rounding);
      for (int k = 0; k < count; ++k)
        EXPECT_EQ(world.velocity(pucks[static_cast<std::size_t>(k)]), world.velocity(bat));
      EXPECT_LE(world.counters().events(), 20u);
      EXPECT_LT(world.max_overlap(), 1e-12);
      expect_balanced(world);
    }
  }
}

TEST(PushedPuck, StandsStillUnderABatTooWeakToPushItAndCostsNothing) {
  for (const double thrust : {0.2, 0.9, 1.9}) {
    World world(slippery(0.5));
    const BodyId bat = add_bat(world, 2, 5);
    const BodyId near = add_puck(world, 2.125, 5), far = add_puck(world, 2.25, 5);
    world.set_thrust(bat, {thrust, 0});  // two pucks of 0.5 kg bear 2 N
    world.advance(0.1);
    const std::uint64_t events = world.counters().events(), hash = world.hash();
    world.advance(1000.0);
    EXPECT_EQ(world.counters().events(), events);
    EXPECT_EQ(world.hash(), hash);
    EXPECT_EQ(world.position(bat), Vector2(2, 5));
    EXPECT_EQ(world.position(near), Vector2(2.125, 5));
    EXPECT_EQ(world.position(far), Vector2(2.25, 5));
    world.set_thrust(bat, {2.5, 0});
    world.advance(1000.5);
    EXPECT_NEAR(world.position(far).x() - 2.25, way_after(0.25, slippery_bat_drag / 2, 0.5), 1e-9);
    world.set_thrust(bat, {-1, 0});
    world.advance(1001.5);
    EXPECT_GT(world.position(near).x() - world.position(bat).x(), 0.1);
    expect_balanced(world);
  }
}

TEST(PushedPuck, LeavesABatThatDragSlowsMoreThanFrictionSlowsItAndStaysWithOneThatItDoesNot) {
  World world(slippery(0.0));
  const BodyId bat = add_bat(world, 2, 5), puck = add_puck(world, 2.125, 5);
  world.set_thrust(bat, {9, 0});
  world.advance(1.0);
  const double driving = (9.0 - 0.5 * friction) / 1.5, drag = slippery_bat_drag / 1.5,
               speed = speed_after(driving, drag, 1.0);
  ASSERT_GT(slippery_bat_drag * speed, friction);
  world.set_thrust(bat, {0, 0});  // the bat brakes by g v > k: the puck is off at once
  world.advance(1.2);
  EXPECT_NEAR(world.velocity(puck).x(), speed - friction * 0.2, 1e-12);
  EXPECT_NEAR(world.velocity(bat).x(), speed * std::exp(-slippery_bat_drag * 0.2), 1e-12);
  expect_balanced(world);

  World slow(slippery(0.0));
  const BodyId slow_bat = add_bat(slow, 2, 5), slow_puck = add_puck(slow, 2.125, 5);
  slow.set_thrust(slow_bat, {3, 0});
  slow.advance(1.0);
  const double left = speed_after((3.0 - 1.0) / 1.5, drag, 1.0);
  ASSERT_LT(slippery_bat_drag * left, friction);
  slow.set_thrust(slow_bat, {0, 0});  // dv/dt = -(M g v + m k)/(M + m): together to a stop
  const double brake = 0.5 * friction / 1.5, stop = std::log1p(drag * left / brake) / drag;
  slow.advance(1.0 + 0.5 * stop);
  EXPECT_EQ(slow.velocity(slow_puck), slow.velocity(slow_bat));
  EXPECT_NEAR(slow.velocity(slow_bat).x(),
              (left + brake / drag) * std::exp(-drag * 0.5 * stop) - brake / drag, 1e-12);
  slow.advance(1.0 + 1.01 * stop);
  EXPECT_EQ(slow.velocity(slow_bat), Vector2(0, 0));
  EXPECT_EQ(slow.velocity(slow_puck), Vector2(0, 0));
  const std::uint64_t events = slow.counters().events();
  slow.advance(100.0);
  EXPECT_EQ(slow.counters().events(), events);
  expect_balanced(slow);
}

/// (M + m) dw/dt = M (a - g w) - m k w/|v|, du/dt = -k u/|v|: w along the push, u across it.
/// Classical Runge-Kutta in extended precision.
struct Pushed {
  Real way = 0, speed = 0, aside = 0, across;
  Real thrust, mass;
  void rates(const Real (&s)[4], Real (&r)[4]) const {
    const Real v = std::hypot(s[1], s[3]);
    r[0] = s[1], r[2] = s[3];
    r[1] = (thrust - slippery_bat_drag * s[1] - mass * friction * s[1] / v) / (1 + mass);
    r[3] = -friction * s[3] / v;
  }
  void advance(Real time, int steps) {
    const Real h = time / steps;
    Real s[4] = {way, speed, aside, across};
    for (int step = 0; step < steps; ++step) {
      Real k[4][4], t[4];
      for (int stage = 0; stage < 4; ++stage) {
        for (int i = 0; i < 4; ++i)
          t[i] = stage == 0 ? s[i] : s[i] + (stage == 3 ? h : h / 2) * k[stage - 1][i];
        rates(t, k[stage]);
      }
      for (int i = 0; i < 4; ++i) s[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
    }
    way = s[0], speed = s[1], aside = s[2], across = s[3];
  }
};

TEST(PushedPuck, SlidesAlongItsBatAsIntegrationInExtendedPrecisionSays) {
  double worst = 0.0;
  std::uint64_t most = 0;
  for (const double across : {0.02, 0.3, 1.0, 2.5})
    for (const double thrust : {1.5, 4.0, 12.0}) {
      SCOPED_TRACE(testing::Message() << across << " " << thrust);
      World world(slippery(0.0));
      const BodyId bat = add_bat(world, 2, 5, 2.0), puck = add_puck(world, 2.125, 4, 0.0, across);
      world.set_thrust(bat, {thrust, 0});
      Pushed truth{.across = across, .thrust = thrust, .mass = 0.5};
      for (int tenth = 1; tenth <= 6; ++tenth) {
        world.advance(0.1 * tenth);
        truth.advance(0.1L, 20000);
        worst = std::max(
            {worst, std::abs(world.position(puck).x() - 2.125 - static_cast<double>(truth.way)),
             std::abs(world.position(puck).y() - 4 - static_cast<double>(truth.aside))});
      }
      most = std::max(most, world.counters().events());
      EXPECT_LT(world.max_overlap(), 1e-12);
      expect_balanced(world);
    }
  RecordProperty("largest_error_m", std::to_string(worst));
  EXPECT_LT(worst, 1e-4);
  EXPECT_LE(most, 250u);
}

TEST(PushedPuck, HasNoEventsOncePressedIntoAWallACornerOrAPost) {
  for (const double restitution : {0.0, 0.5, 0.9, 1.0}) {
    for (int place = 0; place < (restitution < 1.0 ? 3 : 2);
         ++place) {  // an elastic puck between bat and post has no reason to settle
      SCOPED_TRACE(testing::Message() << restitution << " " << place);
      World world(slippery(restitution));
      const BodyId bat = add_bat(world, 18, place == 1 ? 0.3 : 5, 0.2);
      if (place == 2) world.add(PostSpec{.position = {19.0, 5.001}, .radius = 0.1});
      const BodyId puck =
          add_puck(world, 18.5, place == 1 ? 0.08 : 5, 0.0, place == 1 ? -0.1 : 0.0);
      world.set_thrust(bat, {6, 0});
      world.advance(10.0);
      const std::uint64_t events = world.counters().events();
      if (place < 2) {
        EXPECT_LT(events, 2000u);
      }
      world.advance(20.0);
      EXPECT_EQ(world.counters().events(), events);
      EXPECT_LT(world.max_overlap(), 1e-9);
      expect_balanced(world);
      world.set_thrust(bat, {-6, 0});
      world.advance(21.0);
      EXPECT_LT(world.position(bat).x(), world.position(puck).x() - 0.2);
    }
  }
}

TEST(PushedPuck, BetweenBatsThatPushAlongBothAxesLetsTimeAdvance) {
  for (const double restitution : {0.0, 0.7}) {
    World world(slippery(restitution));
    const BodyId puck = add_puck(world, 5, 5);
    const BodyId left = add_bat(world, 4.8, 5, 0.04);
    const BodyId below = world.add(BatSpec{.position = {5.02, 4.8}, .half_extent = {0.04, 0.05}});
    world.set_thrust(left, {6, 0});
    world.set_thrust(below, {0, 6});
    for (int step = 1; step <= 30; ++step) {
      const std::uint64_t before = world.counters().events();
      world.advance(0.1 * step);
      EXPECT_LT(world.counters().events() - before, 3000u);
      EXPECT_LT(world.max_overlap(), 1e-9);
    }
    EXPECT_GT(world.position(puck).x() + world.position(puck).y(), 10.5);
    expect_balanced(world);
  }
}

}  // namespace
}  // namespace rink::physics::test
