// Own exponential, logarithm and warped time against 80-bit arithmetic.
#include "game/physics/flight/exponential.h"

#include <gtest/gtest.h>

#include <cmath>

#include "game/physics/flight/motion.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

double ulps(double value, long double truth) {
  const double rounded = static_cast<double>(truth);
  const double ulp = std::abs(std::nextafter(rounded, 2.0 * rounded) - rounded);
  return static_cast<double>(std::abs(static_cast<long double>(value) - truth) /
                             static_cast<long double>(ulp));
}

TEST(Exponential, StaysBelowOneUlpOfTheTruth) {
  std::mt19937_64 random(1);
  double worst_exponential = 0.0, worst_logarithm = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double x = -std::pow(10.0, uniform(random, -12.0, 1.55)),
                 y = -1.0 + std::pow(10.0, uniform(random, -10.0, 0.0)) * uniform(random, 0.0, 1.0);
    worst_exponential = std::max(worst_exponential, ulps(expm1_of(x), expm1l(x)));
    if (y != 0.0) worst_logarithm = std::max(worst_logarithm, ulps(log1p_of(y), log1pl(y)));
    worst_logarithm = std::max(worst_logarithm, ulps(log1p_of(x / 40.0), log1pl(x / 40.0)));
  }
  EXPECT_LT(worst_exponential, 1.0);
  EXPECT_LT(worst_logarithm, 1.0);
}

TEST(Exponential, KeepsItsLimits) {
  EXPECT_EQ(expm1_of(0.0), 0.0);
  EXPECT_EQ(expm1_of(-1e300), -1.0);
  EXPECT_EQ(log1p_of(0.0), 0.0);
  EXPECT_EQ(log1p_of(-1.0), -std::numeric_limits<double>::infinity());
}

TEST(WarpedTime, IsExactToAFewUlpForAnyDragAndDuration) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 100000; ++i) {
    const double elapsed = std::pow(10.0, uniform(random, -6.0, 2.0)),
                 drag = std::pow(10.0, uniform(random, -4.0, 1.0));
    const WarpedTime w = warp(elapsed, drag);
    const long double g = drag, t = elapsed, y = g * t, s = -expm1l(-y) / g;
    long double q = (t - s) / g;
    if (y < 0.5L) {
      long double term = 0.5L;
      q = 0.0L;
      for (int n = 3; n < 40; ++n, term *= -y / static_cast<long double>(n - 1)) q += term;
      q *= t * t;
    }
    ASSERT_LT(ulps(w.s, s), 4.0) << elapsed << ' ' << drag;
    ASSERT_LT(ulps(w.q, q), 8.0) << elapsed << ' ' << drag;
    ASSERT_NEAR(w.e, static_cast<double>(expl(-y)), 2e-16);
  }
}

}  // namespace
}  // namespace rink::physics::test
