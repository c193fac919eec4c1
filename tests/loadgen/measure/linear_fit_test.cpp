// Costs of a constant and a proportional part, told from power laws, and the number of clients that
// they leave room for.
#include "loadgen/measure/statistics/linear_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "loadgen/measure/growth.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;

std::vector<FitPoint> line(double constant, double slope) {
  std::vector<FitPoint> points;
  for (const double x : {10.0, 30.0, 100.0, 300.0, 1000.0})
    points.push_back({x, constant + slope * x});
  return points;
}

TEST(LinearFit, IsExactOnALine) {
  const auto fit = fit_line(line(250.0, 3.5));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->constant, 250.0, 1e-9);
  EXPECT_NEAR(fit->slope, 3.5, 1e-12);
  EXPECT_NEAR(fit->reaches(33'333.0).value(), (33'333.0 - 250.0) / 3.5, 1e-6);
  EXPECT_FALSE(fit->reaches(100.0)) << "less than the constant part alone";
  EXPECT_LT(fit->log_residual, log_residual(*fit_power(line(250.0, 3.5)), line(250.0, 3.5)));
}

TEST(LinearFit, LeavesAPowerLawToThePowerLaw) {
  std::vector<FitPoint> points;
  for (const double x : {10.0, 30.0, 100.0, 300.0, 1000.0})
    points.push_back({x, 2.0 * std::pow(x, 1.6)});
  EXPECT_GT(fit_line(points)->log_residual, 0.1);
  EXPECT_NEAR(log_residual(*fit_power(points), points), 0.0, 1e-20);
}

TEST(LinearFit, HasNoPartBelowZeroAndNoneOfASinglePlace) {
  EXPECT_EQ(fit_line(std::vector<FitPoint>{{1.0, 5.0}, {2.0, 4.0}, {4.0, 3.0}})->slope, 0.0);
  EXPECT_EQ(fit_line(std::vector<FitPoint>{{1.0, 1.0}, {2.0, 4.0}, {4.0, 16.0}})->constant, 0.0);
  EXPECT_FALSE(fit_line(std::vector<FitPoint>{{2.0, 1.0}, {2.0, 4.0}}));
  EXPECT_FALSE(fit_line(std::vector<FitPoint>{{1.0, 0.0}, {2.0, 4.0}}));
  EXPECT_FALSE(fit_line({}));
}

/// Costs that scatter by a tenth of their size: the mean of 1,000 fits is the law, however
/// different its ends are in size.
TEST(LinearFit, IsUnbiasedWhereTheScatterGrowsWithTheCost) {
  std::mt19937 random(3);
  std::normal_distribution<double> scatter(0.0, 0.1);
  double constant = 0.0, slope = 0.0;
  for (int i = 0; i < 1'000; ++i) {
    std::vector<FitPoint> points;
    for (int replication = 0; replication < 3; ++replication)
      for (const FitPoint& exact : line(200.0, 5.0))
        points.push_back({exact.x, exact.y * std::exp(scatter(random))});
    const auto fit = fit_line(points);
    constant += fit->constant / 1e3, slope += fit->slope / 1e3;
  }
  EXPECT_NEAR(constant, 200.0, 4.0);
  EXPECT_NEAR(slope, 5.0, 0.06);
}

TEST(Capacity, IsWhereTheNinetyNinthPercentileOfATickFillsItsPeriod) {
  std::vector<RunRecord> runs;
  for (const std::uint32_t clients : {10u, 30u, 100u, 300u}) {
    RunRecord& run = runs.emplace_back();
    run.cell = {"client-server", "region", "on-event", clients, 1};
    run.valid = true;
    run.population = "per_client";
    run.tick_us.p99 = 1'000.0 + 40.0 * clients;
  }
  EXPECT_THAT(capacity_text(growths_of(runs)),
              HasSubstr("region, on-event: 99 % of the ticks end within 1000 + 40 n us of n "
                        "clients: this server holds 808 clients, by extrapolation from 300"));
  EXPECT_THAT(growth_table(growths_of(runs)), HasSubstr("this server holds 808 clients"));
  for (RunRecord& run : runs) run.tick_us.p99 = 5.0 * std::pow(run.cell.clients, 2.0);
  EXPECT_THAT(capacity_text(growths_of(runs)),
              HasSubstr("5 n^2 us of n clients: this server holds 81 clients\n"));
  for (RunRecord& run : runs) run.tick_us.p90 = run.tick_us.p99, run.tick_us.p99.reset();
  EXPECT_THAT(capacity_text(growths_of(runs)), HasSubstr("90 % of the ticks end within 5 n^2 us"));
  runs.resize(2);
  EXPECT_EQ(capacity_text(growths_of(runs)), "");
}

}  // namespace
}  // namespace rink::loadgen
