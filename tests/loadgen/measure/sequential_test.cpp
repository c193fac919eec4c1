// Replications until intervals are narrow enough: the looks together keep their 95 %, and what is
// too wide is named.
#include "loadgen/measure/sequential.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rink::loadgen {
namespace {

using testing::HasSubstr;

std::vector<RunRecord> runs_with(const std::vector<double>& payloads) {
  std::vector<RunRecord> runs;
  for (std::size_t i = 0; i < payloads.size(); ++i) {
    RunRecord& run = runs.emplace_back();
    run.cell = {"client-server", "region", "on-event", 10, i + 1};
    run.valid = true;
    run.down_bytes_per_client_per_s = payloads[i];
  }
  return runs;
}

TEST(SequentialStopping, SpendsNoMoreThanFivePercentOnAllLooks) {
  double spent = 0.0;
  for (std::uint32_t look = 1; look <= 100'000; ++look) spent += 1.0 - confidence_of_look(look);
  EXPECT_LE(spent, 0.05);
  EXPECT_GT(spent, 0.0499);
}

/// 2,000 sequences of normal replications, each stopped at the first interval that is narrow
/// enough: the last interval holds the truth in 95 % of them or more. At the plain 95 % it would
/// not: stopping early prefers samples that happen to scatter little.
TEST(SequentialStopping, KeepsItsConfidenceThoughItLooksAgainAndAgain) {
  std::mt19937 random(7);
  int held = 0, sequences = 2'000;
  for (int sequence = 0; sequence < sequences; ++sequence) {
    std::normal_distribution<double> payload(1'000.0, 60.0);
    std::vector<double> sample{payload(random), payload(random), payload(random)};
    std::uint32_t look = 1;
    while (!wider_rows(summarise(runs_with(sample)), 0.05, look).empty() && look < 60)
      sample.push_back(payload(random)), ++look;
    double mean = 0.0;
    for (const double value : sample) mean += value / static_cast<double>(sample.size());
    held += std::abs(mean - 1'000.0) <= 0.05 * mean;
  }
  EXPECT_GE(held, static_cast<int>(0.95 * sequences));
}

TEST(SequentialStopping, NamesRowsThatAreTooWideAndThoseWithoutAnInterval) {
  EXPECT_TRUE(wider_rows(summarise(runs_with({100.0, 100.0, 100.0})), 0.001, 1).empty());
  const auto wide = wider_rows(summarise(runs_with({90.0, 100.0, 110.0})), 0.05, 1);
  ASSERT_EQ(wide.size(), 1u);
  EXPECT_EQ(wide.front().runs, 3u);
  EXPECT_THAT(wide.front().words, HasSubstr("client-server-region-on-event-10 is known to within"));
  EXPECT_THAT(wider_rows(summarise(runs_with({100.0})), 0.05, 1).front().words,
              HasSubstr("has no interval"));
}

TEST(SequentialStopping, TakesWidthsAsPercentOrFractions) {
  EXPECT_DOUBLE_EQ(width_in("5%"), 0.05);
  EXPECT_DOUBLE_EQ(width_in("0.05"), 0.05);
  for (const char* bad : {"", "%", "5", "0", "0%", "100%", "-1%", "narrow", "5 %", "nan"})
    EXPECT_THROW(width_in(bad), ExperimentError) << bad;
}

}  // namespace
}  // namespace rink::loadgen
