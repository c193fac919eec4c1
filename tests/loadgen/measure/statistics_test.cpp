// Intervals against printed tables, by hand, and by how often they cover what they should.
#include "loadgen/measure/statistics/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "loadgen/measure/statistics/distributions.h"

namespace rink::loadgen {
namespace {

TEST(Statistics, StudentsQuantilesAreThoseOfTheTables) {
  // Closed forms: one degree of freedom is tan(pi (p - 1/2)); two are (2p - 1) sqrt(2 / (4p (1 -
  // p))).
  for (const double p : {0.6, 0.9, 0.975, 0.995}) {
    EXPECT_NEAR(student_t_quantile(p, 1.0), std::tan(std::acos(-1.0) * (p - 0.5)), 1e-6);
    EXPECT_NEAR(student_t_quantile(p, 2.0),
                (2.0 * p - 1.0) * std::sqrt(2.0 / (4.0 * p * (1.0 - p))), 1e-6);
  }
  // NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2, and more digits of the same from
  // R's qt.
  const std::vector<std::pair<double, double>> table{{3, 3.182446305},  {4, 2.776445105},
                                                     {5, 2.570581836},  {9, 2.262157163},
                                                     {29, 2.045229642}, {100, 1.983971519}};
  for (const auto& [freedom, t] : table)
    EXPECT_NEAR(student_t_quantile(0.975, freedom), t, 1e-6) << freedom;
}

TEST(Statistics, BinomialTailsAreSumsOfTheirTerms) {
  for (const std::uint64_t trials : {1u, 50u, 120u}) {
    double tail = 0.0,
           term = std::pow(0.01,
                           static_cast<double>(trials));  // that all succeed; then one fewer each
    for (std::uint64_t count = trials; count > 0; --count) {
      tail += term;
      EXPECT_NEAR(binomial_tail(count, trials, 0.01), tail, 1e-12 + 1e-9 * tail)
          << count << " of " << trials;
      term *= 99.0 * static_cast<double>(count) / static_cast<double>(trials - count + 1);
    }
  }
  EXPECT_EQ(binomial_tail(0, 50, 0.01), 1.0);
  EXPECT_EQ(binomial_tail(51, 50, 0.01), 0.0);
  EXPECT_NEAR(binomial_tail(10'500, 1'000'000, 0.01), 3e-7, 2e-7) << "five standard deviations";
}

TEST(Statistics, AnIntervalIsMeanPlusMinusTTimesStandardError) {
  const std::vector<double> values{30.0, 36.0,
                                   33.0};  // mean 33, deviation 3, error sqrt(3), t 4.302653
  const auto interval = interval_of_mean(values, Scale::unbounded);
  ASSERT_TRUE(interval);
  EXPECT_NEAR(interval->low, 33.0 - 4.302652730 * std::sqrt(3.0), 1e-6);
  EXPECT_NEAR(interval->high, 33.0 + 4.302652730 * std::sqrt(3.0), 1e-6);
  EXPECT_FALSE(interval_of_mean(std::span(values).first(1), Scale::unbounded));
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
      covered += interval_of_mean(values, Scale::unbounded)->contains(7.0) ? 1 : 0;
    }
    const double sampling_error = std::sqrt(0.95 * 0.05 / trials);
    EXPECT_NEAR(static_cast<double>(covered) / trials, 0.95, 4.0 * sampling_error)
        << "samples of " << size << ", seed " << size;
  }
}

TEST(Statistics, NoIntervalPassesWhatItsFigureCanBe) {
  const std::vector<double> recalls{1.0, 0.98, 1.0}, bytes{10.0, 30.0}, late{0.0, 0.0, 0.02},
      over{0.9, 1.1};
  EXPECT_GT(interval_of_mean(recalls, Scale::unbounded)->high, 1.0)
      << "this is what would be drawn beyond recall 1";
  EXPECT_LT(interval_of_mean(bytes, Scale::unbounded)->low, 0.0);
  const double mean = 2.98 / 3.0, half = 4.302652730 * 0.02 / 3.0,
               odds = std::exp(half /
                               (mean * (1.0 - mean)));  // deviation 0.02 / sqrt(3), error 0.02 / 3
  EXPECT_NEAR(interval_of_mean(recalls, Scale::fraction)->high,
              1.0 / (1.0 + (1.0 - mean) / mean / odds), 1e-9);
  EXPECT_NEAR(interval_of_mean(recalls, Scale::fraction)->low,
              1.0 / (1.0 + (1.0 - mean) / mean * odds), 1e-9);
  EXPECT_NEAR(interval_of_mean(bytes, Scale::positive)->low,
              20.0 * std::exp(-12.706204736 * 10.0 / 20.0), 1e-9);
  EXPECT_NEAR(interval_of_mean(bytes, Scale::positive)->high,
              20.0 * std::exp(12.706204736 * 10.0 / 20.0), 1e-3);
  EXPECT_GT(interval_of_mean(late, Scale::fraction)->low, 0.0);
  EXPECT_GT(interval_of_mean(over, Scale::fraction)->high, 1.0)
      << "a share of processor time measured above 1";
  for (const double edge : {0.0, 1.0})
    EXPECT_EQ(interval_of_mean(std::vector<double>(3, edge), Scale::fraction),
              (Interval{edge, edge}));
  EXPECT_EQ(interval_of_mean(std::vector<double>(3, 0.1), Scale::fraction), (Interval{0.1, 0.1}));
}

/// The part of 4,000 samples of `size`, drawn by `draw`, whose interval contains `mean`; each must
/// lie within [0, most] and contain its sample's mean.
template <class Draw>
double coverage(Scale scale, std::size_t size, double mean, double most, Draw draw) {
  constexpr int trials = 4'000;
  std::mt19937_64 random(size);
  int covered = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> values(size);
    for (double& value : values) value = draw(random);
    const Interval interval = interval_of_mean(values, scale).value();
    covered += interval.contains(mean) ? 1 : 0;
    EXPECT_GE(interval.low, 0.0);
    EXPECT_LE(interval.high, most);
    EXPECT_TRUE(interval.contains(std::accumulate(values.begin(), values.end(), 0.0) /
                                  static_cast<double>(size)))
        << "size and seed " << size;
  }
  return static_cast<double>(covered) / trials;
}

TEST(Statistics, IntervalsOfFractionsAndOfPositiveFiguresCoverTheArithmeticMean) {
  const auto recall = [](std::mt19937_64& random) {  // beta(95, 5), mean 0.95, deviation 0.022
    const double there = std::gamma_distribution<double>(95.0)(random),
                 missing = std::gamma_distribution<double>(5.0)(random);
    return there / (there + missing);
  };
  const auto age = [](std::mt19937_64& random) {
    return std::lognormal_distribution<double>(0.0, 0.3)(random);
  };
  const auto bytes = [](std::mt19937_64& random) {
    return std::normal_distribution<double>(1.0, 0.1)(random);
  };
  const double infinity = std::numeric_limits<double>::infinity();
  for (const std::size_t size : {3u, 5u, 10u, 20u}) {
    EXPECT_NEAR(coverage(Scale::fraction, size, 0.95, 1.0, recall), 0.95, 0.02) << size;
    EXPECT_NEAR(coverage(Scale::positive, size, std::exp(0.045), infinity, age), 0.95, 0.02)
        << size;
    EXPECT_NEAR(coverage(Scale::positive, size, 1.0, infinity, bytes), 0.95, 0.02) << size;
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
  std::normal_distribution<double> game(0.0, 1.0),
      noise(0.0, 0.1);  // games differ a lot, schemes within a game little
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
  EXPECT_GT(told_apart, trials * 99 / 100)
      << "unpaired, the games' own differences would hide a factor of two";
}

TEST(Statistics, ADifferenceIsSignificantOnlyIfItsIntervalExcludesOne) {
  using Pairs = std::vector<std::pair<double, double>>;
  EXPECT_EQ(ratio_of(Pairs{{1.0, 2.0}, {1.1, 2.0}, {0.9, 2.0}})->difference(), Difference::lower);
  EXPECT_EQ(ratio_of(Pairs{{4.0, 2.0}, {4.1, 2.0}, {3.9, 2.0}})->difference(), Difference::higher);
  EXPECT_EQ(ratio_of(Pairs{{1.0, 2.0}, {2.0, 1.0}, {1.0, 1.1}})->difference(),
            Difference::insignificant);
  EXPECT_EQ(ratio_of(Pairs{{3.0, 3.0}, {7.0, 7.0}})->difference(), Difference::insignificant)
      << "the baseline itself";
  EXPECT_EQ(ratio_of(Pairs{{1.0, 2.0}})->difference(), Difference::unknown);
  EXPECT_FALSE(ratio_of(Pairs{{0.0, 2.0}}));
  EXPECT_FALSE(ratio_of(Pairs{}));
}

}  // namespace
}  // namespace rink::loadgen
