// Latency histograms against sorted samples, their null rule, and their way through JSON.
#include "loadgen/measure/statistics/histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

namespace rink::loadgen {
namespace {

double exact_percentile(std::vector<double> sample, double fraction) {
  std::sort(sample.begin(), sample.end());
  const auto rank =
      static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(sample.size()) - 1e-6));
  return sample[std::max<std::size_t>(rank, 1) - 1];
}

std::vector<double> log_uniform_latencies(std::uint64_t seed, std::size_t count) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> exponent(std::log(2e-6), std::log(99.0));
  std::vector<double> sample(count);
  for (double& latency : sample) latency = std::exp(exponent(random));
  return sample;
}

Histogram histogram_of(const std::vector<double>& sample) {
  Histogram histogram;
  for (const double latency : sample) histogram.record(latency);
  histogram.check();
  return histogram;
}

TEST(Histogram, PercentilesAreWithinAThousandthOfTheSortedSample) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const std::vector<double> sample = log_uniform_latencies(seed, 20'000);
    const Histogram histogram = histogram_of(sample);
    for (const double fraction : {0.01, 0.25, 0.5, 0.9, 0.99, 0.999}) {
      const double exact = exact_percentile(sample, fraction);
      EXPECT_NEAR(histogram.percentile_s(fraction).value(), exact, 1e-3 * exact) << fraction;
    }
    EXPECT_EQ(histogram.max_s(), *std::max_element(sample.begin(), sample.end()));
    EXPECT_EQ(histogram.min_s(), *std::min_element(sample.begin(), sample.end()));
  }
}

/// Values step by a hundredth at the rank of each percentile and at the next, ten times the width
/// of a bucket: neither neighbour of the right one is near it.
TEST(Histogram, APercentileIsTheValueWhoseRankItIsAndNotItsNeighbours) {
  for (const std::uint64_t count : {20u, 100u, 200u, 1'000u, 10'000u, 12'345u}) {
    SCOPED_TRACE(count);
    const auto rank_of = [count](std::uint64_t per_thousand) {
      return (per_thousand * count + 999) / 1'000;
    };  // rounded up
    const auto value_s = [&](std::uint64_t rank) {
      int steps = 0;
      for (const std::uint64_t per_thousand : {500u, 900u, 950u, 990u, 999u})
        steps += (rank >= rank_of(per_thousand)) + (rank > rank_of(per_thousand));
      return 0.010 * std::pow(1.01, steps);
    };
    Histogram histogram;
    for (std::uint64_t rank = count; rank >= 1; --rank) histogram.record(value_s(rank));
    const Percentiles found = histogram.percentiles_ms();
    const auto expect = [&](const std::optional<double>& percentile_ms,
                            std::uint64_t per_thousand) {
      EXPECT_EQ(percentile_ms.has_value(), count * (1'000 - per_thousand) >= 10'000u)
          << "ten lie beyond it";
      if (!percentile_ms) return;
      EXPECT_NEAR(*percentile_ms / (1e3 * value_s(rank_of(per_thousand))), 1.0, 1e-3)
          << per_thousand;
    };
    expect(found.p50, 500), expect(found.p90, 900), expect(found.p95, 950), expect(found.p99, 990),
        expect(found.p999, 999);
  }
}

TEST(Histogram, PercentileIsNullUnlessTenSamplesLieBeyondIt) {
  const auto of_size = [](std::uint64_t count) {
    Histogram histogram;
    histogram.record(0.01, count);
    return histogram.percentiles_ms();
  };
  EXPECT_FALSE(of_size(19).p50);
  EXPECT_TRUE(of_size(20).p50);
  EXPECT_FALSE(of_size(99).p90);
  EXPECT_TRUE(of_size(100).p90);
  EXPECT_FALSE(of_size(999).p99);
  EXPECT_TRUE(of_size(1'000).p99);
  EXPECT_FALSE(of_size(9'999).p999);
  EXPECT_TRUE(of_size(10'000).p999);
  EXPECT_DOUBLE_EQ(of_size(1).max.value(), 10.0);
  EXPECT_EQ(of_size(0), Percentiles{});
}

TEST(Histogram, MergingEqualsRecordingEverythingInOne) {
  const std::vector<double> first = log_uniform_latencies(11, 3'000),
                            second = log_uniform_latencies(12, 4'000);
  std::vector<double> both = first;
  both.insert(both.end(), second.begin(), second.end());
  Histogram merged = histogram_of(first);
  merged.merge(histogram_of(second));
  merged.merge(Histogram());
  EXPECT_EQ(merged.percentiles_ms(), histogram_of(both).percentiles_ms());
  EXPECT_EQ(merged.count(), both.size());
  EXPECT_NEAR(merged.mean_s().value(), histogram_of(both).mean_s().value(), 1e-9);
}

TEST(Histogram, MergedIntoAnEmptyOneIsTheOther) {
  const Histogram other = histogram_of(log_uniform_latencies(13, 500));
  Histogram merged;
  merged.merge(other);
  EXPECT_EQ(merged.to_json(), other.to_json());
  EXPECT_GT(other.to_json().at("min_s").get<double>(), 0.0);
}

TEST(Histogram, OutOfRangeDurationsCountAtTheEndsAndTheMaximumStaysExact) {
  Histogram histogram;
  histogram.record(-1.0, 10);
  histogram.record(0.0, 10);
  histogram.record(500.0, 10);
  histogram.record(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(histogram.count(), 31u);
  EXPECT_EQ(histogram.min_s(), 0.0);
  EXPECT_EQ(histogram.max_s(), 500.0);
  EXPECT_LT(histogram.percentile_s(0.5).value(), 1.1e-6);
  EXPECT_GT(histogram.percentile_s(0.67).value(), 136.0);
}

TEST(Histogram, SurvivesItsWayThroughJson) {
  const Histogram histogram = histogram_of(log_uniform_latencies(21, 5'000));
  const auto back = Histogram::from_json(nlohmann::json::parse(histogram.to_json().dump()));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->percentiles_ms(), histogram.percentiles_ms());
  EXPECT_EQ(back->to_json(), histogram.to_json());
  EXPECT_TRUE(Histogram::from_json(Histogram().to_json()));
}

TEST(Histogram, RefusesJsonThatNoHistogramWrote) {
  const nlohmann::json good = histogram_of({0.001, 0.002, 0.1}).to_json();
  const auto refuses = [&good](auto&& spoil) {
    nlohmann::json bad = good;
    spoil(bad);
    return !Histogram::from_json(nlohmann::json::parse(bad.dump()));
  };
  EXPECT_TRUE(refuses([](auto& h) { h = 3; }));
  EXPECT_TRUE(refuses([](auto& h) { h.erase("count"); }));
  EXPECT_TRUE(refuses([](auto& h) { h["count"] = 4; }));
  EXPECT_TRUE(refuses([](auto& h) { h["count"] = "3"; }));
  EXPECT_TRUE(refuses([](auto& h) { h["max_s"] = -1.0; }));
  EXPECT_TRUE(refuses([](auto& h) { h["buckets"][0] = 7; }));
  EXPECT_TRUE(refuses([](auto& h) { h["buckets"][0][0] = Histogram::bucket_count; }));
  EXPECT_TRUE(refuses([](auto& h) { h["buckets"][0][1] = -1; }));
  EXPECT_TRUE(refuses([](auto& h) { std::swap(h["buckets"][0], h["buckets"][1]); }));
}

}  // namespace
}  // namespace rink::loadgen
