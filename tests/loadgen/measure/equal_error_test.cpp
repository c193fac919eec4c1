// Rivals at equal displayed error and recall: curves with closed forms, of which the bytes at any
// error and recall are known.
#include "loadgen/measure/equal_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::Pair;
using End = AtEqualError::End;

/// A policy that sends `scale` error^-power at the recall that no margin gives, and e^(2 margin)
/// times that with a margin, by which the missed part of .02 falls linearly to .001.
struct Law {
  double scale, power;
  RivalPoint at(double rate_hz, double error_mm, double margin) const {
    const double bytes = scale * std::pow(error_mm, -power) * std::exp(2.0 * margin);
    return {.setting_rate_hz = rate_hz,
            .setting_threshold = 0.0,
            .margin = margin,
            .recall = 0.98 + 0.019 * margin,
            .error_mm = error_mm,
            .payload = bytes,
            .wire = 3.0 * bytes};
  }
  std::vector<RivalPoint> curve() const {
    std::vector<RivalPoint> points;
    for (const double rate : {10.0, 20.0, 30.0, 60.0, 90.0})
      for (const double margin : {1.0, 0.0, 0.5}) points.push_back(at(rate, 120.0 / rate, margin));
    return points;
  }
};

TEST(EqualError, IsExactOnAPowerLawWhereverItIsAskedFor) {
  const Law law{5'000.0, 0.7};
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const double error_mm = std::uniform_real_distribution(1.4, 12.0)(random),
                 margin = std::uniform_real_distribution(0.0, 1.0)(random);
    const AtEqualError there = at_equal_error(law.curve(), 0.98 + 0.019 * margin, error_mm);
    ASSERT_EQ(there.payload_end, End::bracketed);
    const RivalPoint exact = law.at(0.0, error_mm, margin);
    EXPECT_NEAR(there.payload / exact.payload, 1.0, 1e-12);
    EXPECT_NEAR(there.wire / exact.wire, 1.0, 1e-12);
  }
}

TEST(EqualError, TakesTheSmallestMarginIfThatHasTheRecallAlready) {
  const Law law{5'000.0, 0.7};
  EXPECT_NEAR(at_equal_error(law.curve(), 0.5, 4.0).payload, law.at(0.0, 4.0, 0.0).payload, 1e-9);
}

TEST(EqualError, IgnoresSettingsThatAnotherBeatsInErrorAndBytes) {
  const Law law{5'000.0, 0.7};
  std::vector<RivalPoint> points = law.curve();
  const double best = at_equal_error(points, 0.98, 5.0).payload;
  RivalPoint wasteful = law.at(45.0, 4.5, 0.0);
  wasteful.payload *= 3.0, wasteful.wire *= 3.0;
  points.push_back(wasteful);
  EXPECT_EQ(at_equal_error(points, 0.98, 5.0).payload, best);
  RivalPoint thrifty = law.at(50.0, 5.0, 0.0);
  thrifty.payload /= 2.0;
  points.push_back(thrifty);
  EXPECT_NEAR(at_equal_error(points, 0.98, 5.0).payload, 0.5 * best, 1e-9 * best);
}

TEST(EqualError, SaysOnWhichSideOfTheErrorNothingWasRun) {
  const Law law{5'000.0, 0.7};
  EXPECT_EQ(at_equal_error(law.curve(), 0.98, 1.0).payload_end, End::not_reached);
  EXPECT_EQ(at_equal_error(law.curve(), 0.9995, 5.0).payload_end, End::not_reached)
      << "no margin that was run has that recall";
  EXPECT_EQ(at_equal_error({}, 0.9, 5.0).payload_end, End::not_reached);
  const AtEqualError coarser = at_equal_error(law.curve(), 0.98, 20.0);
  EXPECT_EQ(coarser.payload_end, End::not_left);
  EXPECT_NEAR(coarser.payload, law.at(0.0, 12.0, 0.0).payload, 1e-9)
      << "its cheapest: no more than an upper bound";
}

TEST(EqualError, HasAnEndForPayloadAndOneForTheWire) {
  const Law law{5'000.0, 0.7};
  std::vector<RivalPoint> points = law.curve();
  for (RivalPoint& point : points)
    if (point.error_mm > 4.0) point.wire = 10.0 * points.front().wire;
  const AtEqualError there = at_equal_error(points, 0.98, 5.0);
  EXPECT_EQ(there.payload_end, End::bracketed);
  EXPECT_EQ(there.wire_end, End::not_left) << "what errs more sends more on the wire, too";
  EXPECT_NEAR(there.wire, law.at(0.0, 4.0, 0.0).wire, 1e-9);
}

TEST(EqualError, CountsSettingsOnBothSidesOfTheErrorThatHaveTheRecall) {
  const Law law{5'000.0, 0.7};
  std::vector<RivalPoint> points = law.curve();
  const auto counts = [&points](double recall, double error_mm) {
    const AtEqualError there = at_equal_error(points, recall, error_mm);
    return std::pair(there.points_below, there.points_above);
  };
  EXPECT_THAT(counts(0.98, 5.0), Pair(3, 2)) << "90, 60 and 30 Hz; 20 and 10";
  EXPECT_THAT(counts(0.98, 6.0), Pair(4, 1)) << "at the error itself is below";
  EXPECT_THAT(counts(0.98, 1.0), Pair(0, 5));
  std::erase_if(points, [](const RivalPoint& point) {
    return point.setting_rate_hz == 20.0 && point.margin > 0.5;
  });
  EXPECT_THAT(counts(0.995, 5.0), Pair(3, 1)) << "20 Hz never has that recall";
}

class EqualErrorOfRuns : public testing::Test {
 protected:
  EqualErrorOfRuns() {
    experiment_.name = "e", experiment_.scene = "crowd";
    Experiment part = experiment_;
    part.part = "curves", part.is_of_curves = true,
    part.tick_rates_hz = {30.0, 10.0, 20.0, 60.0, 90.0};
    experiment_.parts = {part, experiment_};
    experiment_.parts[1].part = "rows";
  }

  /// Runs of `policy` whose bytes are by `law`, times what is particular to each seed's game.
  void add(const std::string& policy, const Law& law, const std::string& part = "curves") {
    for (const std::uint64_t seed : {1u, 2u, 3u})
      for (const RivalPoint& point : law.curve()) {
        Cell cell{.mode = "client-server",
                  .scheme = "region",
                  .policy = policy,
                  .clients = 32,
                  .seed = seed};
        cell.parameters.tick_rate_hz = point.setting_rate_hz,
        cell.parameters.view_margin = point.margin, cell.part = part;
        RunRecord& run = runs_.emplace_back(record_for(experiment_, cell));
        run.valid = true;
        run.truth.delivered_recall = point.recall,
        run.truth.displayed_error_mm.rms = point.error_mm;
        run.down_bytes_per_client_per_s = static_cast<double>(seed) * point.payload,
        run.wire_bytes_per_client_per_s = static_cast<double>(seed) * point.wire;
      }
  }

  Experiment experiment_;
  std::vector<RunRecord> runs_;
};

TEST_F(EqualErrorOfRuns, AreRatiosPairedBySeedWithTheBestRivalFirst) {
  add("on-event", {1'000.0, 0.5});
  add("snapshot", {4'000.0, 0.5});
  add("dead-reckoning", {2'500.0, 0.5});
  const auto compared = equal_errors_of(experiment_, runs_);
  ASSERT_EQ(compared.size(), 2u) << "at the recall without a margin, and at .999";
  for (const EqualError& each : compared) {
    EXPECT_NEAR(each.error_mm, 4.0, 1e-12) << "that of the first rate, 30 Hz";
    ASSERT_EQ(each.rivals.size(), 2u);
    EXPECT_EQ(each.rivals[0].policy, "dead-reckoning");
    EXPECT_NEAR(each.rivals[0].payload.value().value, 2.5, 1e-12);
    EXPECT_NEAR(each.rivals[1].wire.value().value, 4.0, 1e-12);
    EXPECT_EQ(each.rivals[1].payload->pairs, 3u);
    EXPECT_NEAR(each.rivals[1].payload->interval.value().low, 4.0, 1e-9)
        << "what is particular to a game cancels";
  }
  EXPECT_NEAR(compared[0].recall, 0.98, 1e-12);
  EXPECT_NEAR(compared[1].recall, equal_recall, 1e-12);
  EXPECT_THAT(equal_error_table(compared),
              HasSubstr("dead-reckoning       payload 2.50 [2.50, 2.50]"));
  EXPECT_THAT(to_csv(compared), HasSubstr(",snapshot,5,bracketed,"));
}

TEST_F(EqualErrorOfRuns, LeaveOutWhatIsNoPointOfACurveOrNoValidRun) {
  add("on-event", {1'000.0, 0.5});
  add("snapshot", {4'000.0, 0.5}, "rows");
  EXPECT_TRUE(equal_errors_of(experiment_, runs_).front().rivals.empty());
  EXPECT_EQ(without_curves(experiment_, runs_).size(), 45u);
  add("snapshot", {4'000.0, 0.5});
  for (RunRecord& run : runs_) run.valid = run.cell.policy == "on-event";
  EXPECT_EQ(equal_errors_of(experiment_, runs_).size(), 2u);
  EXPECT_TRUE(equal_errors_of(experiment_, runs_).front().rivals.empty());
  EXPECT_TRUE(equal_errors_of(experiment_, runs_, "periodic").empty());
  EXPECT_EQ(equal_error_table({}), "");
}

TEST_F(EqualErrorOfRuns, MarkAnIntervalThatHoldsOneAsNoSignificantDifference) {
  add("on-event", {1'000.0, 0.5});
  add("snapshot", {1'000.0, 0.5});
  add("dead-reckoning", {2'500.0, 0.5});
  for (RunRecord& run : runs_)
    if (run.cell.policy == "snapshot" && run.cell.seed == 1)
      run.down_bytes_per_client_per_s = 1.1 * *run.down_bytes_per_client_per_s;
  const auto compared = equal_errors_of(experiment_, runs_);
  EXPECT_THAT(equal_error_table(compared),
              AllOf(ContainsRegex("snapshot +payload [0-9.]+ \\[0[^]]*\\] ~"),
                    ContainsRegex("dead-reckoning +payload 2.50 \\[2.50, 2.50\\]  "),
                    HasSubstr("~: no significant difference, the interval contains 1\n")));
  EXPECT_THAT(to_csv(compared),
              AllOf(HasSubstr(",payload_difference,wire_difference\n"),
                    HasSubstr(",no significant difference,"), HasSubstr(",higher,higher\n")));
  const std::string html = equal_error_content(experiment_, runs_, compared).html;
  EXPECT_THAT(html, ContainsRegex("snapshot</td>.*\\), no significant difference</td>"));
}

TEST_F(EqualErrorOfRuns, SayWhichRivalHasFewPointsOnASideOfTheError) {
  add("on-event", {1'000.0, 0.5});
  add("snapshot", {4'000.0, 0.5});
  const auto compared = equal_errors_of(experiment_, runs_);
  const RivalRatio& few = compared.front().rivals.front();
  EXPECT_EQ(few.points_below, 3u);
  EXPECT_EQ(few.points_above, 2u);
  EXPECT_THAT(equal_error_table(compared),
              AllOf(HasSubstr("  3 points below, 2 above\n"), HasSubstr("fewer than 5\n")));
  EXPECT_THAT(to_csv(compared), HasSubstr(",bracketed,3,2,higher,higher\n"));
  EXPECT_THAT(equal_error_content(experiment_, runs_, compared).html, HasSubstr("3, 2 (few)"));
  for (RunRecord& run : runs_)
    if (run.cell.seed == 2 && run.cell.parameters.tick_rate_hz == 90.0) run.valid = false;
  EXPECT_EQ(equal_errors_of(experiment_, runs_).front().rivals.front().points_below, 2u)
      << "the fewest of all seeds";
}

TEST_F(EqualErrorOfRuns, LeavePointsUnsaidWhereThereAreEnough) {
  const auto with_ten = [this](const std::string& policy, const Law& law) {
    add(policy, law);
    for (const std::uint64_t seed : {1u, 2u, 3u})
      for (const double rate : {12.0, 14.0, 16.0, 40.0, 50.0}) {
        RunRecord& run = runs_.emplace_back(runs_.back());
        const RivalPoint point = law.at(rate, 120.0 / rate, 1.0);
        run.cell.seed = seed, run.cell.parameters.tick_rate_hz = rate;
        run.cell.parameters.view_margin = point.margin;
        run.truth.delivered_recall = point.recall;
        run.truth.displayed_error_mm.rms = point.error_mm;
        run.down_bytes_per_client_per_s = static_cast<double>(seed) * point.payload;
        run.wire_bytes_per_client_per_s = static_cast<double>(seed) * point.wire;
      }
  };
  with_ten("on-event", {1'000.0, 0.5});
  with_ten("snapshot", {4'000.0, 0.5});
  EXPECT_THAT(equal_error_table(equal_errors_of(experiment_, runs_)), Not(HasSubstr("points")));
}

TEST_F(EqualErrorOfRuns, NameARivalThatNeverGetsSoCloseWithoutARatio) {
  add("on-event", {1'000.0, 0.5});
  add("snapshot", {4'000.0, 0.5});
  for (RunRecord& run : runs_)
    if (run.cell.policy == "snapshot")
      run.truth.displayed_error_mm.rms = 100.0 * *run.truth.displayed_error_mm.rms;
  const auto compared = equal_errors_of(experiment_, runs_);
  EXPECT_FALSE(compared.front().rivals.front().payload);
  EXPECT_THAT(equal_error_table(compared), HasSubstr("never so small an error with this recall"));
}

}  // namespace
}  // namespace rink::loadgen
