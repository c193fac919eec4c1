// Ratios of paired runs against closed forms and simulated noise.
#include "loadgen/measure/server_cores.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rink::loadgen {
namespace {

using testing::HasSubstr;

RunRecord run(std::uint32_t cores, std::uint64_t seed, double send_us) {
  RunRecord record;
  record.cell = {.mode = "client-server",
                 .scheme = "region",
                 .policy = "periodic",
                 .clients = 50,
                 .seed = seed};
  record.cell.server_cores = cores;
  record.valid = true;
  record.physics_us_per_tick = record.filter_us_per_tick = 0.0;
  record.send_us_per_tick = send_us;
  return record;
}

TEST(ServerCores, TheRatioIsTheGeometricMeanOverPairsOfOneSeed) {
  // Log ratios +a and +3a: mean 2a, deviation a sqrt 2, so half the interval is t(0.975, 1) a
  // = 12.706 a.
  const double a = 0.01;
  const std::vector<RunRecord> runs{run(1, 1, 100.0), run(2, 2, 500.0 * std::exp(3 * a)),
                                    run(2, 1, 100.0 * std::exp(a)), run(1, 2, 500.0),
                                    run(1, 3, 7.0)};
  const auto ratios = cores_ratios_of(runs);
  ASSERT_EQ(ratios.size(), 1u);
  EXPECT_EQ(ratios[0].figure, "total_us_per_tick");
  EXPECT_EQ(ratios[0].ratio.pairs, 2u);
  EXPECT_NEAR(ratios[0].ratio.value, std::exp(2 * a), 1e-12);
  EXPECT_NEAR(std::log(ratios[0].ratio.interval->high) - 2 * a, std::tan(0.475 * M_PI) * a, 1e-9);
  EXPECT_EQ(ratios[0].ratio.difference(), Difference::insignificant);
  EXPECT_THAT(cores_table(ratios), HasSubstr("no significant difference"));
  EXPECT_THAT(to_csv(ratios),
              HasSubstr("client-server,region,periodic,50,0,0,total_us_per_tick,2,1.0202,"));
}

TEST(ServerCores, OnePairHasNoIntervalAndInvalidRunsHaveNoPartner) {
  std::vector<RunRecord> runs{run(1, 1, 100.0), run(2, 1, 90.0)};
  EXPECT_THAT(cores_table(cores_ratios_of(runs)),
              HasSubstr("0.900  cannot be told from one replication"));
  runs[1].valid = false;
  EXPECT_TRUE(cores_ratios_of(runs).empty());
  EXPECT_EQ(cores_table({}), "");
}

TEST(ServerCores, NinetyFiveOfAHundredIntervalsHoldTheRatio) {
  std::mt19937_64 random(9);
  std::normal_distribution<double> noise(0.0, 0.2);
  constexpr int trials = 4'000;
  int held = 0;
  for (int i = 0; i < trials; ++i) {
    std::vector<RunRecord> runs;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const double common =
          std::exp(10 * noise(random));  // the seed's own game, which pairing takes out
      runs.push_back(run(1, seed, common));
      runs.push_back(run(2, seed, 0.8 * common * std::exp(noise(random))));
    }
    held += cores_ratios_of(runs).front().ratio.interval->contains(0.8);
  }
  EXPECT_NEAR(held / double(trials), 0.95, 4.0 * std::sqrt(0.95 * 0.05 / trials));
}

}  // namespace
}  // namespace rink::loadgen
