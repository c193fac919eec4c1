// Bodies pressed together along an axis: what they share, how hard they press, and when the last of
// it is gone.
#include "game/physics/engine/rest_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/physics/bodies/loose_bodies.h"

namespace rink::physics::test {
namespace {

constexpr double half_side = 0.125, disc_radius = 0.03125;  // of LooseBodies

struct PressedBodies : LooseBodies {
  RestContacts rests;

  explicit PressedBodies(const WorldSpec& of = rink_of(100, 10))
      : LooseBodies(of), rests(spec, bodies, jams, record, observers) {
    record.keep(true);
  }
  static WorldSpec with_drags(double puck_drag, double bat_drag) {
    return rink_of(100, 10, 1.0, puck_drag, bat_drag);
  }
  static WorldSpec with_friction(double friction) {
    WorldSpec spec = rink_of(100, 10);
    spec.puck_friction = friction;
    return spec;
  }
  /// Side by side along x, the first at x = 1, all at rest and joined.
  void add_row(const std::vector<double>& masses) {
    for (std::uint32_t body = 0; body < masses.size(); ++body)
      add_bat({1.0 + 2.0 * half_side * body, 5.0}, {0.0, 0.0}, masses[body]);
    for (std::uint32_t body = 0; body + 1 < masses.size(); ++body)
      rests.join(face_between(body, body + 1, 0), 0.0);
  }
  void press_on_wall(std::uint32_t body, double time) {
    rests.join({body, partner::wall_left, {0.0, {1.0, 0.0}, 0, {1.0, 0.0}}}, time);
  }
  double acceleration(std::uint32_t body) const { return bodies.law(body).acceleration.x(); }
  double next_end(std::uint32_t body) const {
    double earliest = std::numeric_limits<double>::infinity();
    rests.for_each_end(body, [&](double time) { earliest = std::min(earliest, time); });
    return earliest;
  }
};

/// Perfectly inelastic along the axis, and nothing across it: (m v + m' v')/(m + m'), to the bit
/// the same for both, from where they were brought to by then.
TEST(RestContacts, GiveBothTheirCommonVelocityAlongTheAxisAlone) {
  PressedBodies pressed;
  const std::uint32_t one = pressed.add_bat({1.0, 5.0}, {2.0, 0.5}, 1.0),
                      two = pressed.add_bat({2.75, 5.0}, {-1.0, -0.25}, 3.0);
  pressed.rests.join(PressedBodies::face_between(one, two, 0), 0.5);
  EXPECT_EQ(pressed.bodies.velocity(one), Vector2(-0.25, 0.5));
  EXPECT_EQ(pressed.bodies.velocity(two), Vector2(-0.25, -0.25));
  EXPECT_EQ(pressed.bodies[one].x, 2.0);
  EXPECT_EQ(pressed.bodies[two].x, 2.25);
  EXPECT_TRUE(pressed.rests.are_joined(two, one));
  for (const std::uint32_t body : {one, two}) {
    EXPECT_TRUE(pressed.bodies[body].is(Body::held_x));
    EXPECT_FALSE(pressed.bodies[body].is(Body::held_y));
  }
  ASSERT_EQ(pressed.record.events().size(), 1u);
  EXPECT_EQ(pressed.record.events()[0].kind, EventKind::rest);
}

TEST(RestContacts, HoldABodyStillAtAWallUntilItIsDrivenAway) {
  PressedBodies pressed;
  const std::uint32_t bat = pressed.add_bat({half_side, 5.0}, {-1e-3, 0.25}, 2.0);
  pressed.thrust(bat, {-6.0, 0.0});
  pressed.press_on_wall(bat, 0.0);
  EXPECT_EQ(pressed.bodies.velocity(bat), Vector2(0.0, 0.25));
  EXPECT_EQ(pressed.acceleration(bat), 0.0);
  EXPECT_EQ(pressed.rests.rest_contacts()[0].force, 12.0);
  pressed.thrust(bat, {6.0, 0.0});
  pressed.rests.share(bat, 0, 0.0);
  EXPECT_TRUE(pressed.rests.rest_contacts().empty());
  EXPECT_EQ(pressed.acceleration(bat), 6.0);
  EXPECT_FALSE(pressed.bodies[bat].is(Body::held));
  EXPECT_EQ(pressed.record.counters().releases, 1u);
}

/// Each contact bears what is needed to accelerate all that lies beyond it.
TEST(RestContacts, PressAsHardAsWhatLiesBeyondNeeds) {
  PressedBodies pressed;
  const std::vector<double> masses{1.0, 0.5, 4.0, 2.5};
  pressed.add_row(masses);
  pressed.thrust(0, {8.0, 0.0});
  pressed.rests.share(2, 0, 0.0);
  double beyond = 8.0;
  ASSERT_EQ(pressed.rests.rest_contacts().size(), 3u);
  for (std::uint32_t body = 0; body < 4; ++body) {
    EXPECT_NEAR(pressed.acceleration(body), 1.0, 1e-12);
    beyond -= masses[body];
    if (body < 3) {
      EXPECT_NEAR(pressed.rests.rest_contacts()[body].force, beyond, 1e-11);
    }
  }
}

/// Sequences nearest to `values` that do not fall, by pooling adjacent violators.
std::vector<double> nearest_rising(const std::vector<double>& values,
                                   const std::vector<double>& weights) {
  struct Pool {
    double sum, weight;
    int count;
    double mean() const { return sum / weight; }
  };
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < values.size(); ++i) {
    pools.push_back({values[i] * weights[i], weights[i], 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() >= pools.back().mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back() = {pools.back().sum + last.sum, pools.back().weight + last.weight,
                      pools.back().count + last.count};
    }
  }
  std::vector<double> rising;
  for (const Pool& pool : pools)
    rising.insert(rising.end(), static_cast<std::size_t>(pool.count), pool.mean());
  return rising;
}

/// Gauss's principle of least constraint: the accelerations are the nearest to the thrusts, weighed
/// by the masses, at which nobody runs into the next. Who is in no pool with the next lets go.
TEST(RestContacts, GiveARowTheNearestAccelerationsThatPressNobodyIntoAnother) {
  constexpr std::uint64_t seed = 17;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  std::size_t kept = 0, parted = 0;
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    PressedBodies pressed;
    std::vector<double> masses(2 + random() % 5), thrusts;
    for (double& mass : masses) mass = std::pow(10.0, uniform(random, -0.5, 0.5));
    pressed.add_row(masses);
    for (std::uint32_t body = 0; body < masses.size(); ++body) {
      thrusts.push_back(uniform(random, -6.0, 6.0));
      pressed.thrust(body, {thrusts.back(), 0.0});
    }
    pressed.rests.share(0, 0, 0.0);
    const std::vector<double> expected = nearest_rising(thrusts, masses);
    for (std::uint32_t body = 0; body < masses.size(); ++body) {
      EXPECT_NEAR(pressed.acceleration(body), expected[body], 1e-10);
      if (body + 1 == masses.size()) break;
      const bool is_pressed = expected[body] == expected[body + 1];
      EXPECT_EQ(pressed.rests.are_joined(body, body + 1), is_pressed) << body;
      if (is_pressed) {
        EXPECT_EQ(pressed.acceleration(body), pressed.acceleration(body + 1));
      }
      ++(is_pressed ? kept : parted);
    }
  }
  EXPECT_GT(kept, 100u);
  EXPECT_GT(parted, 100u);
}

/// A bat (mass M, drag g) brakes at a < 0 with a puck (m, larger drag h) before it. At the common
/// speed v it presses with m M (a + (h - g) v)/(M + m), so the contact ends at V = -a/(h - g); v
/// tends to W = M a/(M g + m h) as exp(-(M g + m h) t/(M + m)).
TEST(RestContacts, EndWhenTheContactForceVanishesByDrag) {
  constexpr double M = 3.0, m = 0.5, g = 0.25, h = 2.0, thrust = -1.25, v = 2.0;
  PressedBodies pressed(PressedBodies::with_drags(h, g));
  const std::uint32_t bat = pressed.add_bat({1.0, 5.0}, {v, 0.0}, M),
                      puck = pressed.add_puck({1.0 + half_side + disc_radius, 5.0}, {v, 0.0}, m);
  pressed.rests.join(PressedBodies::face_between(bat, puck, 0), 0.0);
  EXPECT_EQ(pressed.next_end(puck), std::numeric_limits<double>::infinity());
  pressed.thrust(bat, {thrust, 0.0});
  pressed.rests.share(bat, 0, 0.0);
  EXPECT_NEAR(pressed.acceleration(bat), M * thrust / (M + m), 1e-14);
  EXPECT_NEAR(pressed.bodies.law(puck).drag.x(), (M * g + m * h) / (M + m), 1e-14);
  const double last = -thrust / (h - g), tends_to = M * thrust / (M * g + m * h);
  const double end = std::log((v - tends_to) / (last - tends_to)) * (M + m) / (M * g + m * h);
  EXPECT_NEAR(pressed.next_end(puck), end, 1e-13);
  EXPECT_NEAR(motion_at(pressed.bodies, puck, end).velocity.x(), last, 1e-13);
  pressed.rests.release(puck, pressed.next_end(puck));
  EXPECT_TRUE(pressed.rests.rest_contacts().empty());
  EXPECT_EQ(pressed.bodies.law(bat).acceleration, Vector2(thrust, 0.0));
  EXPECT_EQ(pressed.bodies.law(puck).drag, Vector2(h, h));
  EXPECT_EQ(pressed.record.counters().releases, 1u);
}

TEST(RestContacts, EndWhereTheFaceDoes) {
  for (const double speed : {0.2, -0.05}) {
    PressedBodies pressed;
    const std::uint32_t bat = pressed.add_bat({1.0, 5.0}),
                        puck =
                            pressed.add_puck({1.0 + half_side + disc_radius, 5.05}, {0.0, speed});
    pressed.thrust(bat, {1.0, 0.0});
    pressed.rests.join(PressedBodies::face_between(bat, puck, 0), 0.25);
    const double offset = 0.05 + 0.25 * speed, way = half_side - std::copysign(offset, speed);
    EXPECT_NEAR(pressed.next_end(puck), 0.25 + way / std::abs(speed), 1e-12);
    EXPECT_EQ(pressed.next_end(bat), pressed.next_end(puck));
  }
}

/// Two discs in line stay so only while nothing moves them sideways.
TEST(RestContacts, BeginOnAFaceAndNotAtItsEnd) {
  const auto may_rest = [](double offset, double speed) {
    PressedBodies pressed;
    const std::uint32_t bat = pressed.add_bat({1.0, 5.0}),
                        puck = pressed.add_puck({1.0 + half_side + disc_radius, 5.0 + offset},
                                                {0.0, speed});
    return pressed.rests.can_join(PressedBodies::face_between(bat, puck, 0));
  };
  EXPECT_TRUE(may_rest(half_side - 2e-9, 1.0));
  EXPECT_FALSE(may_rest(half_side - 0.5e-9, 1.0));
  EXPECT_TRUE(may_rest(half_side - 0.5e-9, -1.0));
  EXPECT_TRUE(may_rest(0.5e-9 - half_side, 1.0));
  EXPECT_FALSE(may_rest(half_side + 0.5e-9, -1.0));

  const auto may_discs_rest = [](double speed) {
    PressedBodies pressed;
    const std::uint32_t one = pressed.add_puck({1.0, 5.0}),
                        two = pressed.add_puck({1.0 + 2.0 * disc_radius, 5.0}, {0.0, speed});
    return pressed.rests.can_join(PressedBodies::face_between(one, two, 0));
  };
  EXPECT_TRUE(may_discs_rest(0.0));
  EXPECT_FALSE(may_discs_rest(1e-12));

  PressedBodies pressed;
  const std::uint32_t bat = pressed.add_bat({half_side, 5.0});
  Contact contact{bat, partner::wall_left, {0.0, {1.0, 0.0}, 0, {1.0, 0.0}}};
  EXPECT_TRUE(pressed.rests.can_join(contact));
  contact.gap.face = -1;
  EXPECT_FALSE(pressed.rests.can_join(contact));
}

/// Two in a row along x, a third on top of the second, and a post below the first.
TEST(RestContacts, GatherWhoIsHeldTogetherAlongTheAxesThatAreAsked) {
  PressedBodies pressed;
  pressed.add_row({1.0, 1.0});
  const std::uint32_t top = pressed.add_bat({1.25, 5.25}), post = pressed.add_post({1.0, 4.875});
  pressed.rests.join(PressedBodies::face_between(1, top, 1), 0.0);
  pressed.rests.join({0, post, {0.0, {0.0, 1.0}, 1, {0.0, 1.0}}}, 0.0);
  using Members = std::vector<std::uint32_t>;
  EXPECT_EQ(pressed.rests.group(1, Body::held_x), (Members{1, 0}));
  EXPECT_EQ(pressed.rests.group(1, Body::held_y), (Members{1, top}));
  EXPECT_EQ(pressed.rests.group(top, Body::held_x), Members{top});
  EXPECT_EQ(pressed.rests.group(top, Body::held), (Members{top, 1, 0}));
  EXPECT_EQ(pressed.rests.group(0, Body::held_y), Members{0});  // what is fixed is no member
}

/// With the velocity that it had in the group, and its own thrust and drag.
TEST(RestContacts, LetEachGoItsOwnWayWhereTheyAreDissolved) {
  PressedBodies pressed(PressedBodies::with_drags(0.0, 0.5));
  pressed.add_row({1.0, 3.0, 2.0});
  pressed.thrust(0, {6.0, 0.0}), pressed.thrust(1, {1.0, 0.0});
  pressed.rests.share(0, 0, 0.0);
  const double speed = 1.5 * (1.0 - std::exp(-0.5)) / 0.5;
  pressed.rests.dissolve(2, 0, 1.0);
  EXPECT_TRUE(pressed.rests.rest_contacts().empty());
  for (std::uint32_t body = 0; body < 3; ++body) {
    EXPECT_EQ(pressed.bodies.velocity(body), pressed.bodies.velocity(0));
    EXPECT_NEAR(pressed.bodies.velocity(body).x(), speed, 1e-14);
    EXPECT_EQ(pressed.acceleration(body), (body == 0 ? 6.0 : body == 1 ? 1.0 : 0.0));
    EXPECT_EQ(pressed.bodies.law(body).drag.x(), 0.5);
    EXPECT_FALSE(pressed.bodies[body].is(Body::held));
  }
  EXPECT_EQ(pressed.record.counters().releases, 0u);  // nobody pulled, and no face has ended
}

/// One that is freed leaves its jam as well, and those who stood with it go on.
TEST(RestContacts, FreeABodyOfAllThatHeldIt) {
  PressedBodies pressed;
  pressed.add_row({1.0, 1.0, 1.0});
  pressed.thrust(2, {-1.0, 0.0}), pressed.thrust(1, {0.0, 2.0});
  pressed.jams.stop(std::vector<std::uint32_t>{0, 1, 2});
  pressed.rests.free(1, 2.0);
  EXPECT_TRUE(pressed.rests.rest_contacts().empty());
  for (std::uint32_t body = 0; body < 3; ++body) {
    EXPECT_FALSE(pressed.bodies[body].is(Body::held | Body::frozen));
    EXPECT_EQ(pressed.bodies.law(body).acceleration, pressed.bodies.build(body).thrust);
    EXPECT_EQ(pressed.bodies[body].time, 2.0);
  }
}

/// A bat of mass M pushes a puck of mass m that lies on a rough table: below m mu g both stand, and
/// above it they accelerate at (M a - m mu g)/(M + m).
TEST(RestContacts, StandWhileTheFrictionOfAPuckBearsTheThrust) {
  constexpr double M = 2.0, m = 0.5, mu_g = 4.0;
  for (const double push : {0.5, 0.99, 1.01, 3.0}) {
    PressedBodies pressed(PressedBodies::with_friction(mu_g));
    const std::uint32_t bat = pressed.add_bat({1.0, 5.0}, {0.0, 0.0}, M),
                        puck =
                            pressed.add_puck({1.0 + half_side + disc_radius, 5.0}, {0.0, 0.0}, m);
    pressed.rests.add(bat), pressed.rests.add(puck);
    pressed.thrust(bat, {push, 0.0});
    pressed.rests.join(PressedBodies::face_between(bat, puck, 0), 0.0);
    const double expected = std::max(0.0, (M * push - m * mu_g) / (M + m));
    EXPECT_NEAR(pressed.acceleration(bat), expected, 1e-12) << push;
    EXPECT_EQ(pressed.acceleration(puck), pressed.acceleration(bat));
  }
}

/// The friction of a puck that is pushed along both axes would bind two groups to each other. A
/// wall moves nobody.
TEST(RestContacts, PushNoPuckAlongBothAxesWhereFrictionTurns) {
  for (const bool is_rough : {false, true}) {
    PressedBodies pressed(is_rough ? PressedBodies::with_friction(1.0) : rink_of(100, 10));
    const double reach = half_side + disc_radius;
    const std::uint32_t left = pressed.add_bat({5.0 - reach, 5.0}),
                        below = pressed.add_bat({5.0, 5.0 - reach}),
                        puck = pressed.add_puck({5.0, 5.0});
    for (const std::uint32_t body : {left, below, puck}) pressed.rests.add(body);
    pressed.thrust(left, {9.0, 0.0}), pressed.thrust(below, {0.0, 9.0});
    pressed.rests.join(PressedBodies::face_between(left, puck, 0), 0.0);
    EXPECT_EQ(pressed.rests.can_join(PressedBodies::face_between(below, puck, 1)), !is_rough);
    EXPECT_TRUE(
        pressed.rests.can_join({puck, partner::wall_top, {0.0, {0.0, -1.0}, 1, {0, -1.0}}}));
  }
}

}  // namespace
}  // namespace rink::physics::test
