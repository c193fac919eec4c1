// Crossings of the halfway line against the course itself, in extended precision and sampled.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "game/physics/halves/half_crossings.h"

namespace rink::physics {
namespace {

/// x of the motion at `time`, from dv/dt = a - g v, up to where friction has stopped it.
long double place_at(const Motion& motion, long double time) {
  const long double x = motion.position.x(), v = motion.velocity.x(), a = motion.acceleration.x(),
                    g = motion.drag.x();
  const long double t = std::min<long double>(time, motion.rest_time) - motion.time;
  if (g == 0.0L) return x + v * t + a * t * t / 2;
  const long double s = -std::expm1(-g * t) / g;
  return x + v * s + a * (t - s) / g;
}

Motion random_motion(std::mt19937_64& random) {
  std::uniform_real_distribution<double> from_minus_one(-1.0, 1.0);
  const auto or_none = [&](double value) { return random() % 4 == 0 ? 0.0 : value; };
  Motion motion;
  motion.time = 10.0 * (1.0 + from_minus_one(random));
  motion.position = {1.2 + from_minus_one(random), 0.5};
  motion.velocity = {3.0 * or_none(from_minus_one(random)), from_minus_one(random)};
  const double drag = std::abs(or_none(2.0 * from_minus_one(random)));
  motion.drag = {drag, drag};
  if (random() % 3 == 0) motion.acceleration.x() = 5.0 * from_minus_one(random);
  else if (random() % 2 == 0) motion.slide(0.5 * (1.01 + from_minus_one(random)));
  return motion;
}

/// The changes of sides in the first 8 s, by samples 2 ms apart and bisection.
std::vector<HalfCrossing> sampled(const Motion& motion, double line) {
  std::vector<HalfCrossing> found;
  const auto is_right = [&](long double time) { return place_at(motion, time) > line; };
  bool was_right = half_after(motion, line) == Half::right;
  for (int k = 1; k <= 4000; ++k) {
    long double low = motion.time + 0.002L * (k - 1), high = motion.time + 0.002L * k;
    if (is_right(high) == was_right || place_at(motion, high) == line) continue;
    for (int halving = 0; halving < 70; ++halving) {
      const long double middle = (low + high) / 2;
      (is_right(middle) == was_right ? low : high) = middle;
    }
    was_right = !was_right;
    found.push_back({static_cast<double>(high), was_right ? Half::right : Half::left});
  }
  return found;
}

TEST(HalfCrossings, AreThoseOfTheCourse) {
  const double line = 1.2;
  std::mt19937_64 random(20261127);
  int crossed_once = 0, crossed_twice = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Motion motion = random_motion(random);
    std::vector<HalfCrossing> found = sampled(motion, line);
    const HalfCrossings crossings = half_crossings(motion, line);
    std::vector<HalfCrossing> within(crossings.all.begin(),
                                     crossings.all.begin() + crossings.count);
    std::erase_if(within, [&](const HalfCrossing& each) { return each.time > motion.time + 8.0; });
    // A course that turns within a hair of the line crosses it twice between two samples.
    if (within.size() == 2 && within[1].time - within[0].time < 0.004) continue;
    ASSERT_EQ(within.size(), found.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_EQ(within[k].into, found[k].into);
      const double speed = std::abs(motion.at(found[k].time).velocity.x());
      // A rounding of the place, and of the clock.
      EXPECT_NEAR(within[k].time, found[k].time, 1e-14 + 2e-15 / std::max(speed, 1e-6));
    }
    crossed_once += found.size() == 1;
    crossed_twice += found.size() == 2;
  }
  EXPECT_GT(crossed_once, 300);
  EXPECT_GT(crossed_twice, 10);
}

TEST(HalfCrossings, BodyThatTouchesTheLineAndTurnsStaysInItsHalf) {
  Motion motion;
  motion.position = {0.5, 0.0};
  motion.velocity = {1.0, 0.0};
  motion.acceleration = {-1.0, 0.0};  // turns after 1 s, at 1.0 m
  EXPECT_EQ(half_crossings(motion, 1.0).count, 0u);
  const HalfCrossings crossings = half_crossings(motion, 1.0 - 1e-6);
  ASSERT_EQ(crossings.count, 2u);
  EXPECT_NEAR(crossings.all[0].time, 1.0 - std::sqrt(2e-6), 1e-12);
  EXPECT_NEAR(crossings.all[1].time, 1.0 + std::sqrt(2e-6), 1e-12);
}

TEST(HalfCrossings, BodyOnTheLineIsWhereItGoes) {
  Motion motion;
  motion.position = {1.0, 0.0};
  EXPECT_EQ(half_after(motion, 1.0), Half::both) << "it rests there";
  motion.velocity = {-1e-9, 0.0};
  EXPECT_EQ(half_after(motion, 1.0), Half::left);
  motion.velocity = {0.0, 3.0};
  motion.acceleration = {1e-9, 0.0};
  EXPECT_EQ(half_after(motion, 1.0), Half::right);
  EXPECT_EQ(half_crossings(motion, 1.0).count, 0u) << "it never comes back";
}

TEST(HalfCrossings, SlidingPuckStopsOnEitherSideOfTheLine) {
  for (const double speed : {0.999, 1.001}) {  // v^2/(2k) = 0.5 m at 1 m/s
    Motion motion;
    motion.position = {0.5, 0.0};
    motion.velocity = {speed, 0.0};
    motion.slide(1.0);
    EXPECT_EQ(half_crossings(motion, 1.0).count, speed > 1.0 ? 1u : 0u) << speed;
  }
}

}  // namespace
}  // namespace rink::physics
