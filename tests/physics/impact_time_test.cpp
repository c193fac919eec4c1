// Times of first contact against closed forms, fine stepping in extended precision, and the hard
// cases.
#include "game/physics/flight/impact_time.h"

#include <gtest/gtest.h>

#include <cmath>

#include "game/physics/flight/time_to_touch.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

using Real = long double;

struct RealPoint {
  Real x, y;
};

RealPoint real_position(const Motion& m, Real time) {
  Real out[2];
  for (int axis = 0; axis < 2; ++axis) {
    const Real t = time - static_cast<Real>(m.time), g = m.drag[axis];
    const Real s = g == 0 ? t : -expm1l(-g * t) / g, q = g == 0 ? t * t / 2 : (t - s) / g;
    out[axis] = m.position[axis] + m.velocity[axis] * s + m.acceleration[axis] * q;
  }
  return {out[0], out[1]};
}

Real real_gap(const Motion& a, const Motion& b, const RoundedBox& shape, Real time) {
  const RealPoint p = real_position(a, time), q = real_position(b, time);
  const Real x = std::abs(q.x - p.x) - static_cast<Real>(shape.half_extent.x()),
             y = std::abs(q.y - p.y) - static_cast<Real>(shape.half_extent.y());
  if (x > 0 && y > 0) return std::sqrt(x * x + y * y) - static_cast<Real>(shape.radius);
  return std::max(x, y) - static_cast<Real>(shape.radius);
}

/// First sign change of the gap by fine stepping and bisection; negative if there is none before
/// `until`.
Real first_contact_by_stepping(const Motion& a, const Motion& b, const RoundedBox& shape,
                               Real start, Real until, int steps) {
  Real before = start;
  for (int i = 1; i <= steps; ++i) {
    Real after = start + (until - start) * i / steps;
    if (real_gap(a, b, shape, after) > 0) {
      before = after;
      continue;
    }
    for (int j = 0; j < 80; ++j) {
      const Real middle = (before + after) / 2;
      (real_gap(a, b, shape, middle) > 0 ? before : after) = middle;
    }
    return after;
  }
  return -1;
}

TEST(DiscImpact, GrazingPuckTouchesAndOnePassingWiderDoesNot) {
  const double reach = 0.08;
  EXPECT_TRUE(time_to_touch({3.0, reach * (1.0 - 1e-12)}, {-1.0, 0.0}, reach));
  EXPECT_FALSE(time_to_touch({3.0, reach * (1.0 + 1e-12)}, {-1.0, 0.0}, reach));
}

TEST(DiscImpact, TouchingDiscsThatCloseCollideNowAndPartingOnesNever) {
  EXPECT_EQ(time_to_touch({0.08, 0.0}, {-1.0, 0.0}, 0.08), 0.0);
  EXPECT_EQ(time_to_touch({0.07, 0.0}, {-1.0, 0.0}, 0.08), 0.0);
  EXPECT_FALSE(time_to_touch({0.07, 0.0}, {1.0, 0.0}, 0.08));
}

TEST(DrivenImpact, FindsEachOfThreeRootsWhenDragsDiffer) {
  // Puck before a bat: drag 0.2 and 3 per second, thrust 6 m/s^2, gap 17.7 mm; the gap has roots at
  // 0.064, 0.395 and 2.09 s.
  Motion bat, puck;
  bat.velocity = {2.9726, 0.0};
  bat.acceleration = {6.0, 0.0};
  bat.drag = {3.0, 3.0};
  puck.position = {0.5177, 0.0};
  puck.velocity = {2.6263, 0.0};
  puck.drag = {0.2, 0.2};
  const RoundedBox shape{{0.5, 1.0}, 0.0};
  const auto first = first_contact(RelativeMotion{bat, puck}, shape, 0.0, 10.0, 1e-16);
  ASSERT_TRUE(first);
  EXPECT_NEAR(*first,
              static_cast<double>(first_contact_by_stepping(bat, puck, shape, 0, 0.2L, 2000)),
              1e-13);
  EXPECT_NEAR(*first, 0.064, 5e-4);
  // From behind the second root the third is the first to come.
  const auto third =
      first_contact(RelativeMotion{bat, puck}, HalfPlane{{1.0, 0.0}, 0.5}, 0.5, 10.0, 1e-16);
  ASSERT_TRUE(third);
  EXPECT_NEAR(*third,
              static_cast<double>(first_contact_by_stepping(bat, puck, shape, 0.5L, 3, 5000)),
              1e-13);
  EXPECT_NEAR(*third, 2.09, 5e-3);
}

TEST(DrivenImpact, BatEdgesAndRoundedCornersAgreeWithFineStepping) {
  std::mt19937_64 random(3);
  int hits = 0, misses = 0;
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE(i);
    Motion bat, puck;
    bat.velocity = {uniform(random, -3, 3), uniform(random, -3, 3)};
    bat.acceleration = {6.0 * static_cast<double>(random() % 3) - 6.0,
                        6.0 * static_cast<double>(random() % 3) - 6.0};
    bat.drag = Vector2::Constant(random() % 4 == 0 ? 0.0 : uniform(random, 0.1, 3.0));
    puck.position = {uniform(random, -1, 1), uniform(random, -1, 1)};
    puck.velocity = {uniform(random, -3, 3), uniform(random, -3, 3)};
    puck.drag = random() % 2 == 0 ? bat.drag : Vector2(Vector2::Constant(0.2));
    const RoundedBox shape{{uniform(random, 0.02, 0.2), uniform(random, 0.02, 0.2)}, 0.04};
    if (shape.gap(puck.position).distance <= 0.0) continue;
    const Real truth = first_contact_by_stepping(bat, puck, shape, 0, 2, 3000);
    const auto time = first_contact(RelativeMotion{bat, puck}, shape, 0.0, 2.0, 4e-16);
    if (truth < 0) {
      ++misses;
      // Stepping may overlook a graze that the safe steps find; it must then be one.
      EXPECT_TRUE(!time || std::abs(real_gap(bat, puck, shape, *time)) < 1e-14L);
    } else {
      ++hits;
      ASSERT_TRUE(time);
      EXPECT_LE(*time, static_cast<double>(truth) + 1e-12);
      EXPECT_NEAR(static_cast<double>(real_gap(bat, puck, shape, *time)), 0.0, 2e-15);
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(misses, 300);
}

TEST(DrivenImpact, SafeStepsEqualTheQuadraticWhereBothApply) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 20000; ++i) {
    SCOPED_TRACE(i);
    Motion a, b;
    b.position = {uniform(random, -3, 3), uniform(random, -3, 3)};
    a.velocity = {uniform(random, -2, 2), uniform(random, -2, 2)};
    b.velocity = {uniform(random, -2, 2), uniform(random, -2, 2)};
    if (b.position.norm() < 0.08) continue;
    const auto straight = time_to_touch(b.position, b.velocity - a.velocity, 0.08);
    const auto stepped =
        first_contact(RelativeMotion{a, b}, RoundedBox{{0.0, 0.0}, 0.08}, 0.0, 1e3, 4e-16);
    ASSERT_EQ(straight.has_value(), stepped.has_value());
    if (!straight) continue;
    const Vector2 velocity = b.velocity - a.velocity;
    const double miss = std::abs(cross(b.position, velocity)) / velocity.norm() / 0.08;
    EXPECT_NEAR(*straight, *stepped,
                4e-14 * (1.0 + *straight) / std::sqrt(1.0 - std::min(miss * miss, 1.0 - 1e-12)));
  }
}

/// Against the instant at which the plane itself is met: never later, and nearer than the slack.
TEST(DrivenImpact, ABodyIsNearAPlaneBeforeItMeetsIt) {
  std::mt19937_64 random(5);
  const double slack = 1e-3;
  int met = 0;
  for (int i = 0; i < 20000; ++i) {
    SCOPED_TRACE(i);
    Motion still, moving;
    moving.position = {uniform(random, -1, 1), uniform(random, -1, 1)};
    moving.velocity = {uniform(random, -2, 2), uniform(random, -2, 2)};
    moving.acceleration = {uniform(random, -3, 3), uniform(random, -3, 3)};
    if (i % 3 > 0) moving.drag = Vector2::Constant(uniform(random, 0, 2));
    const HalfPlane plane{i % 2 == 0 ? Vector2(1.0, 0.0) : Vector2(0.0, -1.0),
                          uniform(random, -3, -1)};
    const auto meets = first_contact(RelativeMotion{still, moving}, plane, 0.0, 10.0, 4e-16);
    const auto near = time_near(moving, plane, 0.0, 10.0, slack);
    if (meets) {
      ASSERT_TRUE(near && *near <= *meets);
      ++met;
    }
    if (!near) continue;
    const Motion there = moving.at(*near);
    EXPECT_LE(plane.gap(there.position).distance, slack);
    EXPECT_LT(plane.normal.dot(there.velocity), 0.0);
  }
  EXPECT_GT(met, 5000);
}

}  // namespace
}  // namespace rink::physics::test
