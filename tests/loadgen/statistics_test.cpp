// Intervals against printed tables, by hand, and by how often they cover what they should.
#include "loadgen/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "loadgen/distributions.h"

namespace rink::loadgen {
namespace {

TEST(Statistics, StudentsQuantilesAreThoseOfTheTables) {
  // Closed forms: one degree of freedom is tan(pi (p - 1/2)); two are (2p - 1) sqrt(2 / (4p (1 - p))).
  for (const double p : {0.6, 0.9, 0.975, 0.995}) {
    EXPECT_NEAR(student_t_quantile(p, 1.0), std::tan(std::acos(-1.0) * (p - 0.5)), 1e-6);
    EXPECT_NEAR(student_t_quantile(p, 2.0), (2.0 * p - 1.0) * std::sqrt(2.0 / (4.0 * p * (1.0 - p))), 1e-6);
  }
  // NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2, and more digits of the same from R's qt.
  const std::vector<std::pair<double, double>> table{{3, 3.182446305}, {4, 2.776445105}, {5, 2.570581836}, {9, 2.262157163}, {29, 2.045229642}, {100, 1.983971519}};
  for (const auto& [freedom, t] : table) EXPECT_NEAR(student_t_quantile(0.975, freedom), t, 1e-6) << freedom;
}

TEST(Statistics, AnIntervalIsMeanPlusMinusTTimesStandardError) {
  const std::vector<double> values{30.0, 36.0, 33.0};  // mean 33, deviation 3, error sqrt(3), t 4.302653
  const auto interval = interval_of_mean(values);
  ASSERT_TRUE(interval);
  EXPECT_NEAR(interval->low, 33.0 - 4.302652730 * std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(interval->high, 33.0 + 4.302652730 * std::sqrt(3.0), 1e-6);
  EXPECT_FALSE(interval_of_mean(std::span(values).first(1)));
}

TEST(Statistics, NineteenOfTwentyIntervalsOfNormalSamplesHoldTheMean) {
  constexpr int trials = 20'000;
  for (const std::size_t size : {2u, 3u, 5u, 20u}) {
    std::mt19937_64 random(size);
    std::normal_distribution<double> normal(7.0, 3.0);
    int covered = 0;
    for (int trial = 0; trial < trials; ++trial) {
      std::vector<double> values(size);
      for (double& value : values) value = normal(random);
      covered += interval_of_mean(values)->contains(7.0) ? 1 : 0;
    }
    const double sampling_error = std::sqrt(0.95 * 0.05 / trials);
    EXPECT_NEAR(static_cast<double>(covered) / trials, 0.95, 4.0 * sampling_error) << "samples of " << size << ", seed " << size;
  }
}

TEST(Statistics, PairedRatiosAreGeometricMeansAndCoverTheTrueRatio) {
  const std::vector<std::pair<double, double>> pairs{{1.0, 2.0}, {1.0, 8.0}};
  const auto ratio = ratio_of(pairs);
  ASSERT_TRUE(ratio);
  EXPECT_DOUBLE_EQ(ratio->value, 0.25);
  EXPECT_DOUBLE_EQ(ratio->inverse().value, 4.0);
  EXPECT_NEAR(ratio->inverse().interval->high, 1.0 / ratio->interval->low, 1e-12);

  constexpr int trials = 20'000;
  std::mt19937_64 random(1);
  std::normal_distribution<double> game(0.0, 1.0), noise(0.0, 0.1);  // games differ a lot, schemes within a game little
  int covered = 0, told_apart = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<std::pair<double, double>> drawn(4);
    for (auto& [own, baseline] : drawn) {
      const double size = std::exp(game(random));
      own = 0.5 * size * std::exp(noise(random)), baseline = size * std::exp(noise(random));
    }
    covered += ratio_of(drawn)->interval->contains(0.5) ? 1 : 0;
    told_apart += ratio_of(drawn)->difference() == Difference::lower ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(covered) / trials, 0.95, 4.0 * std::sqrt(0.95 * 0.05 / trials));
  EXPECT_GT(told_apart, trials * 99 / 100) << "unpaired, the games' own differences would hide a factor of two";
}

TEST(Statistics, ADifferenceIsSignificantOnlyIfItsIntervalExcludesOne) {
  using Pairs = std::vector<std::pair<double, double>>;
  EXPECT_EQ(ratio_of(Pairs{{1.0, 2.0}, {1.1, 2.0}, {0.9, 2.0}})->difference(), Difference::lower);
  EXPECT_EQ(ratio_of(Pairs{{4.0, 2.0}, {4.1, 2.0}, {3.9, 2.0}})->difference(), Difference::higher);
  EXPECT_EQ(ratio_of(Pairs{{1.0, 2.0}, {2.0, 1.0}, {1.0, 1.1}})->difference(), Difference::insignificant);
  EXPECT_EQ(ratio_of(Pairs{{3.0, 3.0}, {7.0, 7.0}})->difference(), Difference::insignificant) << "the baseline itself";
  EXPECT_EQ(ratio_of(Pairs{{1.0, 2.0}})->difference(), Difference::unknown);
  EXPECT_FALSE(ratio_of(Pairs{{0.0, 2.0}}));
  EXPECT_FALSE(ratio_of(Pairs{}));
}

}  // namespace
}  // namespace rink::loadgen
