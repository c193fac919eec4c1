// The measure of error, truth from independent methods, and how points become answers.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/accuracy/diagram.h"
#include "bench/accuracy/guarded.h"
#include "bench/accuracy/run_time.h"
#include "bench/accuracy/stability.h"
#include "bench/accuracy/tables.h"
#include "bench/trials/stability_trials.h"

namespace rink::accuracy {
namespace {

DiagramTrial trial_named(const std::string& name) {
  for (DiagramTrial& trial : diagram_trials())
    if (trial.trial.name == name) return trial;
  return {};
}

Point point_at(double dt, double run_s, double error) {
  return {.dt = dt, .run_s = run_s, .error = {.p90 = error, .max = error}};
}

TEST(PositionError, IsTheNearestRankAndTheLargestDistance) {
  std::vector<Vector2> truth(10, Vector2(1.0, 1.0)), places;
  for (int k = 1; k <= 10; ++k) places.emplace_back(1.0 + 0.3 * k, 1.0 - 0.4 * k);  // 0.5 k away
  const PositionError error = position_error(places, truth);
  EXPECT_NEAR(error.p90, 4.5, 1e-15);
  EXPECT_NEAR(error.max, 5.0, 1e-15);
  places[3].x() = NAN;
  EXPECT_EQ(position_error(places, truth).max, HUGE_VAL);
  EXPECT_EQ(position_error(std::vector{truth[0]}, std::vector{truth[0]}).p90, 0.0);
}

TEST(Truth, OfPairsIsClosedFormAndEqualsTheExtendedEngine) {
  const DiagramTrial pairs = trial_named("pairs");
  const auto closed = places_of_pairs(pairs.trial),
             extended = places_in_extended_precision(pairs.trial);
  EXPECT_LT(position_error(extended, closed).max, 1e-14);  // a rounding of a place at 32 m is 4e-15
}

TEST(Truth, OfDragByWarpedTimeEqualsTheExtendedEngineWithDrag) {
  const DiagramTrial drag = trial_named("drag");
  const auto warped = places_by_warped_time(drag.trial),
             extended = places_in_extended_precision(drag.trial);
  EXPECT_LT(position_error(extended, warped).max, 1e-13);
}

TEST(Truth, OfPressedPucksIsWhereTheExactEngineLeavesThem) {
  const DiagramTrial pressed = trial_named("pressed");
  EXPECT_LT(
      position_error(places_in_extended_precision(pressed.trial), places_of_pressed(pressed.trial))
          .max,
      1e-9);
}

TEST(Diagram, ExactEngineIsRightToRoundingInEveryScene) {
  for (const DiagramTrial& trial : diagram_trials()) {
    const Point point =
        measure(trial, trial.true_places(trial.trial), {"exact"}, frame, {.repeats = 1});
    EXPECT_LT(point.error.p90, trial.trial.name == "pressed" ? 1e-9 : 1e-11) << trial.trial.name;
    EXPECT_LT(point.error.max, 1e-6) << trial.trial.name;
    EXPECT_EQ(point.escapes, 0u) << trial.trial.name;
    EXPECT_LT(point.overlap, 1e-9) << trial.trial.name;
  }
}

TEST(Diagram, TimeAtAnErrorLiesOnTheLineBetweenTheTwoPointsAround) {
  const std::vector<Point> points{point_at(0.1, 1.0, 1e-1), point_at(0.05, 10.0, 1e-2),
                                  point_at(0.025, 100.0, 1e-4)};
  const auto met = time_at_error(points, 1e-3);
  ASSERT_TRUE(met);
  EXPECT_EQ(met->kind, TimeAtError::Kind::met);
  EXPECT_NEAR(met->run_s, std::sqrt(10.0 * 100.0), 1e-12);
  EXPECT_EQ(time_at_error(points, 1.0)->kind, TimeAtError::Kind::faster);
  EXPECT_EQ(time_at_error(points, 1e-5)->kind, TimeAtError::Kind::never);
  EXPECT_NEAR(time_at_error(points, 1e-5)->run_s, 100.0, 0.0);
  EXPECT_FALSE(time_at_error({}, 1.0));
}

TEST(Diagram, AStepThatIsRightByChanceIsNoAnswer) {
  const std::vector<Point> points{point_at(0.1, 1.0, 1e-4), point_at(0.05, 2.0, 1e-1),
                                  point_at(0.025, 4.0, 1e-2)};
  EXPECT_EQ(time_at_error(points, 1e-3)->kind, TimeAtError::Kind::never);
}

TEST(Diagram, OrderIsTheSlopeOfErrorOverStep) {
  std::vector<Point> points{point_at(1.0, 1.0, 50.0)};
  for (int k = 1; k < 6; ++k) points.push_back(point_at(std::exp2(-k), 1.0, std::exp2(-2.0 * k)));
  EXPECT_NEAR(order_of(points).value(), 2.0, 1e-12);
  EXPECT_FALSE(order_of(std::vector{points[0], points[1]}));
}

TEST(Diagram, StandingIsRelativeToTheExactEngineOfTheSamePanel) {
  Panel panel{{.trial = {.name = "gas"}}};
  panel.series = {{{"exact"}, {point_at(0.0, 1e-3, 1e-15)}},
                  {{"chipmunk"}, {point_at(0.1, 0.1, 1e-2), point_at(0.05, 0.4, 1e-4)}},
                  {{"box2d"}, {point_at(0.1, 0.5, 1e-2)}}};
  EXPECT_NEAR(standing_of(panel, panel.series[1]).least_ratio.value(), 200.0, 1e-9);
  EXPECT_TRUE(standing_of(panel, panel.series[2]).is_bound);
  EXPECT_EQ(standing_of(panel, panel.series[2]).ratio, "> 500");
  EXPECT_NE(headline_of(panel).find("chipmunk 200, box2d > 500"), std::string::npos)
      << headline_of(panel);
}

TEST(Diagram, NamesTheBestOfTheOtherLibrariesAndSaysIfBox2dV3IsMissing) {
  Panel panel{{.trial = {.name = "gas"}}};
  panel.series = {{{"exact"}, {point_at(0.0, 1e-3, 1e-15)}},
                  {{"paper", "rk4"}, {point_at(0.1, 2e-3, 1e-9)}},
                  {{"chipmunk"}, {point_at(0.1, 0.1, 1e-2), point_at(0.05, 0.4, 1e-4)}},
                  {{"box2d"}, {point_at(0.1, 5e-4, 1e-1)}}};
  EXPECT_EQ(best_stepper_of(panel),
            "best of the other libraries: chipmunk, 200 times the exact engine; cheapest at 1/60 "
            "s: box2d, 0.5 times, which errs by 1.0e-01 m; the best stepper is missing, for box2d3 "
            "was not run");
  EXPECT_NE(text_of(panel).find(best_stepper_of(panel)), std::string::npos);
  panel.series.push_back({{"box2d3"}, {point_at(0.1, 0.02, 1e-2), point_at(0.05, 0.08, 1e-4)}});
  EXPECT_NE(best_stepper_of(panel).find("best of the other libraries: box2d3, 40 times"),
            std::string::npos)
      << best_stepper_of(panel);
  EXPECT_EQ(best_stepper_of(panel).find("missing"), std::string::npos);
  panel.series = {panel.series[0], panel.series[3]};
  EXPECT_NE(best_stepper_of(panel).find("no other library errs by so little"), std::string::npos);
  panel.series.pop_back();
  EXPECT_EQ(best_stepper_of(panel), "");
}

TEST(RunTime, CountsWhereProcessorAndRealTimeDifferByATenthAtMost) {
  EXPECT_TRUE((RunTime{.processor_s = 0.91, .real_s = 1.0}).counts());
  EXPECT_FALSE((RunTime{.processor_s = 0.89, .real_s = 1.0}).counts()) << "somebody had the core";
  EXPECT_FALSE((RunTime{.processor_s = 1.2, .real_s = 1.0}).counts()) << "a second thread helped";
}

TEST(Guarded, WorkHandsBackItsBytes) {
  const Outcome outcome = guarded([] { return to_bytes(42.5); }, 5.0);
  ASSERT_TRUE(outcome.output) << outcome.why_not;
  EXPECT_EQ(from_bytes<double>(*outcome.output), 42.5);
}

TEST(Guarded, ACrashAndAHangAreResults) {
  EXPECT_NE(guarded([]() -> std::string { std::abort(); }, 5.0).why_not.find("signal 6"),
            std::string::npos);
  const Outcome hung = guarded(
      []() -> std::string {
        for (volatile bool always = true; always;) {
        }
        return "";
      },
      0.2);
  EXPECT_FALSE(hung.output);
  EXPECT_EQ(hung.why_not, "longer than 0.2 s");
  std::atomic<bool> is_interrupted = true;
  EXPECT_EQ(guarded([] { return std::string(); }, 5.0, &is_interrupted).why_not, "interrupted");
}

TEST(Stability, ExactEngineSurvivesWhatIsQuickToTry) {
  for (const Trial& trial : stability_trials()) {
    if (trial.name == "dense" || trial.name == "crowd" || trial.name == "collapse") continue;
    const Wear wear = endure(trial, {"exact"}, frame);
    EXPECT_TRUE(wear.has_survived()) << trial.name;
    EXPECT_TRUE(wear.overlap < 1e-9 || trial.world.allow_overlap)
        << trial.name << ": " << wear.overlap;
    EXPECT_LT(wear.energy_error, trial.is_conservative() ? 1e-12 : 1e-6) << trial.name;
  }
}

TEST(Stability, VerdictNamesTheReason) {
  EXPECT_EQ((Survival{.contender = {"exact"}, .is_done = true}.verdict()), "yes");
  EXPECT_EQ((Survival{.contender = {"exact"}, .why_not = "signal 6 (Aborted)"}.verdict()),
            "no: signal 6 (Aborted)");
  EXPECT_EQ((Survival{.contender = {"exact"}, .is_done = true, .wear = {.escapes = 3}}.verdict()),
            "no: 3 escaped");
  EXPECT_EQ(
      (Survival{.contender = {"exact"}, .is_done = true, .wear = {.is_finite = false}}.verdict()),
      "no: not numbers");
}

TEST(Contenders, AreAllEnginesWithTheirIntegratorsAndThePeersThatAreThere) {
  const auto all = contenders({}, {});
  EXPECT_EQ(all.front().name(), "exact");
  for (const Contender& contender : all)
    EXPECT_NE(make_world(Trial(), contender, frame), nullptr) << contender.name();
  EXPECT_EQ(contenders({"exact"}, {"rk4"}).size(), 1u);
  EXPECT_TRUE(absences({"exact"}).empty());
}

}  // namespace
}  // namespace rink::accuracy
