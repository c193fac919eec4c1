// Exponents against exact power laws, intervals against simulated noise, and what is said of curves
// that are none.
#include "loadgen/measure/growth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "loadgen/measure/statistics/distributions.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Distributions, TheBetaFunctionHasItsClosedForms) {
  for (const double x : {0.0, 1e-6, 0.1, 0.3, 0.5, 0.8, 0.999, 1.0}) {
    for (const double a : {0.5, 1.0, 3.0, 40.0}) {
      EXPECT_NEAR(regularized_beta(x, a, 1.0), std::pow(x, a), 1e-14);
      EXPECT_NEAR(regularized_beta(x, 1.0, a), 1.0 - std::pow(1.0 - x, a), 1e-14);
      EXPECT_NEAR(regularized_beta(x, a, 2.5) + regularized_beta(1.0 - x, 2.5, a), 1.0, 1e-13);
    }
    EXPECT_NEAR(regularized_beta(x, 0.5, 0.5), 2.0 / M_PI * std::asin(std::sqrt(x)), 1e-14);
  }
}

TEST(Distributions, StudentsQuantilesHaveTheirClosedFormsForOneTwoAndFourDegreesOfFreedom) {
  for (const double p : {0.001, 0.025, 0.2, 0.5, 0.6, 0.9, 0.975, 0.9995}) {
    EXPECT_NEAR(student_t_quantile(p, 1.0), std::tan(M_PI * (p - 0.5)),
                1e-11 * (1.0 + std::abs(std::tan(M_PI * (p - 0.5)))));
    EXPECT_NEAR(student_t_quantile(p, 2.0), (2 * p - 1) / std::sqrt(2 * p * (1 - p)), 1e-11 * 100);
    const double alpha = 4 * p * (1 - p),
                 q = std::cos(std::acos(std::sqrt(alpha)) / 3) / std::sqrt(alpha);
    EXPECT_NEAR(student_t_quantile(p, 4.0),
                (p < 0.5 ? -1 : 1) * 2 * std::sqrt(std::max(0.0, q - 1)), 1e-9)
        << p;
  }
  const double z = 1.959963984540054, freedom = 1e5;
  EXPECT_NEAR(student_t_quantile(0.975, freedom), z + (z * z * z + z) / (4 * freedom), 1e-9)
      << "near the normal quantile, by Cornish and Fisher's expansion";
}

TEST(Distributions, TheTailOfFIsTheTwoSidedTailOfTSquared) {
  for (const double freedom : {1.0, 3.0, 17.0}) {
    const double t = student_t_quantile(0.975, freedom);
    EXPECT_NEAR(f_tail(t * t, 1.0, freedom), 0.05, 1e-12);
  }
  EXPECT_NEAR(f_tail(3.0, 2.0, 8.0), std::pow(1.0 + 3.0 * 2.0 / 8.0, -4.0), 1e-14)
      << "with two degrees of freedom above it is a power";
}

TEST(PowerFit, AnExactPowerLawGivesItsExponentAndAnIntervalOfNoWidth) {
  for (const double exponent : {-1.0, 0.0, 0.5, 1.0, 2.0}) {
    std::vector<FitPoint> points;
    for (const double x : {10.0, 20.0, 50.0, 100.0, 1'000.0})
      points.push_back({x, 3.5 * std::pow(x, exponent)});
    const auto fit = fit_power(points);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->exponent, exponent, 1e-12);
    EXPECT_NEAR(fit->factor, 3.5, 1e-10);
    EXPECT_NEAR(*fit->exponent_low, exponent, 1e-6);
    EXPECT_NEAR(*fit->exponent_high, exponent, 1e-6);
    EXPECT_FALSE(fit->is_rejected());
    for (const auto& local : fit->locals) EXPECT_NEAR(local.exponent, exponent, 1e-10);
  }
}

TEST(PowerFit, NothingIsFittedToWhatHasNoLogarithmOrNoSpread) {
  EXPECT_FALSE(fit_power({}));
  EXPECT_FALSE(fit_power(std::vector<FitPoint>{{10.0, 1.0}, {10.0, 2.0}}));
  EXPECT_FALSE(fit_power(std::vector<FitPoint>{{10.0, 1.0}, {20.0, 0.0}}));
  const auto two = fit_power(std::vector<FitPoint>{{10.0, 1.0}, {20.0, 2.0}});
  ASSERT_TRUE(two);
  EXPECT_FALSE(two->exponent_low);
}

/// Three points on no line: one degree of freedom is left, for which Student's quantile is a
/// tangent.
TEST(PowerFit, AnIntervalHasAsManyDegreesOfFreedomAsThereArePointsLessTwo) {
  const double off = 0.2;
  const auto fit = fit_power(
      std::vector<FitPoint>{{1.0, 1.0}, {std::exp(1.0), std::exp(off)}, {std::exp(2.0), 1.0}});
  ASSERT_TRUE(fit && fit->exponent_low && fit->exponent_high);
  EXPECT_NEAR(fit->exponent, 0.0, 1e-12);
  // Residuals -off/3, 2 off/3, -off/3 about the mean: their squares sum to 2 off^2/3; the
  // logarithms of x vary by 2 about theirs.
  const double half = std::tan(M_PI * 0.475) * std::sqrt(2.0 * off * off / 3.0 / 1.0 / 2.0);
  EXPECT_NEAR(*fit->exponent_high, half, 1e-9);
  EXPECT_NEAR(*fit->exponent_low, -half, 1e-9);
  EXPECT_FALSE(fit->misfit_p) << "nothing is known of the scatter";
  EXPECT_EQ(fit->points, 3u);
}

/// Two replications at each of three places: one degree of freedom for the bend and three for the
/// scatter, whose distribution has a closed form.
TEST(PowerFit, TheTestOfABendHasPlacesLessTwoAndPointsLessPlacesDegreesOfFreedom) {
  const double bend = 0.2, scatter = 0.1;
  std::vector<FitPoint> points;
  for (int place = 0; place < 3; ++place)
    for (const double sign : {-1.0, 1.0})
      points.push_back({std::exp(place), std::exp((place == 1 ? bend : 0.0) + sign * scatter)});
  const auto fit = fit_power(points);
  ASSERT_TRUE(fit && fit->misfit_p);
  const double f = (2.0 * 2.0 * bend * bend / 3.0 / 1.0) / (6.0 * scatter * scatter / 3.0),
               u = std::sqrt(f / 3.0);  // t = sqrt(f), three degrees of freedom
  EXPECT_NEAR(*fit->misfit_p, 1.0 - 2.0 / M_PI * (u / (1.0 + u * u) + std::atan(u)), 1e-9);
  const double residual = 4.0 * bend * bend / 3.0 + 6.0 * scatter * scatter;
  // Student's quantile with four degrees of freedom, as in the test of the distributions.
  const double alpha = 4 * 0.975 * 0.025,
               q = std::cos(std::acos(std::sqrt(alpha)) / 3) / std::sqrt(alpha),
               t = 2 * std::sqrt(q - 1);
  EXPECT_NEAR(*fit->exponent_high - fit->exponent, t * std::sqrt(residual / 4.0 / 4.0), 1e-9);
}

std::vector<FitPoint> noisy(std::mt19937_64& random, double sigma, double (*law)(double)) {
  std::normal_distribution<double> noise(0.0, sigma);
  std::vector<FitPoint> points;
  for (const double x : {25.0, 50.0, 100.0, 200.0, 400.0})
    for (int replication = 0; replication < 3; ++replication)
      points.push_back({x, law(x) * std::exp(noise(random))});
  return points;
}

TEST(PowerFit,
     NinetyFiveOfAHundredIntervalsHoldTheExponentAndFiveOfAHundredTestsRejectATruePowerLaw) {
  std::mt19937_64 random(3);
  constexpr int trials = 4'000;
  int held = 0, doubted = 0;
  for (int i = 0; i < trials; ++i) {
    const auto fit = fit_power(noisy(random, 0.1, [](double x) { return 2.0 * std::pow(x, 1.3); }));
    held += *fit->exponent_low <= 1.3 && 1.3 <= *fit->exponent_high;
    doubted += *fit->misfit_p < 0.05;
  }
  const double four_deviations = 4.0 * std::sqrt(0.95 * 0.05 / trials);
  EXPECT_NEAR(held / double(trials), 0.95, four_deviations);
  EXPECT_NEAR(doubted / double(trials), 0.05, four_deviations);
}

TEST(PowerFit, ACurveThatBendsIsNoPowerLawAndItsLocalExponentsSayHow) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 50; ++i) {
    const auto fit = fit_power(noisy(random, 0.02, [](double x) {
      return 300.0 + 0.02 * x * x;
    }));  // a constant below, a square above
    EXPECT_TRUE(fit->is_rejected());
    EXPECT_LT(fit->locals.front().exponent, 0.5);
    EXPECT_GT(fit->locals.back().exponent, 1.5);
  }
  const auto slight = fit_power(noisy(random, 1e-4, [](double x) { return 1.0 + 5.0 * x; }));
  EXPECT_LT(*slight->misfit_p, 0.05);
  EXPECT_FALSE(slight->is_rejected())
      << "a bend of a percent is found, but is nothing to call it by another name for";
}

RunRecord record_of(const std::string& scheme, std::uint32_t clients, std::uint32_t pucks,
                    std::uint64_t seed) {
  RunRecord record;
  record.cell = {.mode = "client-server",
                 .scheme = scheme,
                 .policy = "periodic",
                 .clients = clients,
                 .seed = seed};
  record.cell.pucks = pucks;
  record.valid = true;
  record.population = "fixed";
  record.physics_us_per_tick = 2.0 * pucks;
  record.filter_us_per_tick = scheme == "none" ? 0.0 : 0.1 * clients * std::sqrt(pucks);
  record.send_us_per_tick = 3.0 * clients * pucks;
  record.down_bytes_per_client_per_s = 12.0 * pucks;
  return record;
}

std::vector<RunRecord> cross() {
  std::vector<RunRecord> runs;
  for (const std::uint64_t seed : {1, 2})
    for (const char* scheme : {"none", "region"}) {
      for (const std::uint32_t clients : {10u, 20u, 40u})
        runs.push_back(record_of(scheme, clients, 1'000, seed));
      for (const std::uint32_t pucks : {500u, 2'000u})
        runs.push_back(record_of(scheme, 20, pucks, seed));
    }
  return runs;
}

double exponent_of(const std::vector<Growth>& growths, const std::string& factor,
                   const std::string& scheme, const std::string& figure) {
  for (const Growth& growth : growths)
    if (growth.factor == factor && growth.scheme == scheme && growth.figure == figure)
      return growth.fit.exponent;
  ADD_FAILURE() << "no growth of " << figure << " over " << factor;
  return 0.0;
}

TEST(Growth, OverEachNumberAloneIsReadOffACrossOfRuns) {
  const auto runs = cross();
  const auto growths = growths_of(runs);
  EXPECT_NEAR(exponent_of(growths, "clients", "region", "filter_us_per_tick"), 1.0, 1e-9);
  EXPECT_NEAR(exponent_of(growths, "clients", "region", "physics_us_per_tick"), 0.0, 1e-9);
  EXPECT_NEAR(exponent_of(growths, "pucks", "region", "filter_us_per_tick"), 0.5, 1e-9);
  EXPECT_NEAR(exponent_of(growths, "pucks", "none", "down_bytes_per_client_per_s"), 1.0, 1e-9);
  for (const Growth& growth : growths) {
    EXPECT_NE(growth.factor, "bats") << "which nobody varied";
    EXPECT_FALSE(growth.scheme == "none" && growth.figure == "filter_us_per_tick")
        << "0 has no logarithm";
    EXPECT_EQ(growth.fit.points, 6u);
  }
  EXPECT_THAT(to_csv(growths), HasSubstr("clients,client-server,region,periodic,\"1000 pucks, the "
                                         "scene's bats\",send_us_per_tick,1,"));
  EXPECT_THAT(growth_table(growths), HasSubstr("pucks    region"));
  EXPECT_EQ(growth_table({}), "");
}

TEST(Growth, InvalidRunsAndTooFewPlacesShowNothing) {
  auto runs = cross();
  for (RunRecord& run : runs) run.valid = run.cell.clients != 40 && run.cell.pucks != 2'000;
  EXPECT_TRUE(growths_of(runs).empty());
}

}  // namespace
}  // namespace rink::loadgen
