// The generator's own health: the functions that judge runs, fed by the real filters on uniform
// points in straight motion, give the closed forms of the literature.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <numbers>
#include <vector>

#include "game/model/random_stream.h"
#include "im/filter.h"
#include "loadgen/measure/truth/classification.h"
#include "loadgen/measure/truth/scope_history.h"
#include "loadgen/measure/truth/surroundings.h"
#include "tests/loadgen/measure/areas.h"

namespace rink::loadgen {
namespace {

using std::numbers::pi;

constexpr double R = interest_radius;  // the interest radius [m]
constexpr double side = 24.0;     // of the box in which the points are [m]; observers stay farther
                                  // from its border than anything they ask about
constexpr double density = 60.0;  // points per m^2
constexpr double speed = 1.0;     // of points and observers [m/s]
constexpr double relative_speed =
    4.0 / pi * speed;  // mean, for two equal speeds in independent uniform directions
constexpr std::uint32_t observer_count =
    1'200;  // with a third of them their own directions alone move the churn by 1 %

/// Points and observers that fly straight; points number from 0.
class Gas {
 public:
  Gas() : random_(20'260) {
    const auto count = static_cast<std::uint32_t>(density * side * side);
    for (std::uint32_t i = 0; i < count; ++i)
      points_.push_back(
          {{random_.uniform(0.0, side), random_.uniform(0.0, side)}, speed * random_.direction()});
    constexpr double margin = 5.0;
    for (std::uint32_t i = 0; i < observer_count; ++i)
      observers_.push_back(
          {{random_.uniform(margin, side - margin), random_.uniform(margin, side - margin)},
           speed * random_.direction()});
  }
  std::uint32_t point_count() const { return static_cast<std::uint32_t>(points_.size()); }
  Vector2 point(std::uint32_t i, double time) const {
    return points_[i].start + time * points_[i].velocity;
  }
  Vector2 observer(std::uint32_t i, double time) const {
    return observers_[i].start + time * observers_[i].velocity;
  }
  std::vector<Placed> placed(double time) const {
    std::vector<Placed> all;
    for (std::uint32_t i = 0; i < point_count(); ++i)
      all.push_back({i, point(i, time), Vector2(0.0, 0.0)});
    return all;
  }

 private:
  struct Body {
    Vector2 start, velocity;
  };
  game::RandomStream random_;
  std::vector<Body> points_, observers_;
};

/// One of the real filters, told where everything is at an instant; observers subscribe to the
/// square of half side `reach`.
class Decisions {
 public:
  Decisions(const Gas& gas, const std::string& scheme, double reach, double cell_size = 0.0)
      : gas_(gas),
        reach_(reach),
        filter_(im::make_filter(scheme, {.world = {0.0, 0.0, side, side}, .cell_size = cell_size})),
        steps_(observer_count) {}

  void match(double time) {
    for (std::uint32_t i = 0; i < gas_.point_count(); ++i) {
      const Vector2 at = gas_.point(i, time);
      filter_->set_update_region(i, {at.x(), at.y(), at.x(), at.y()});
    }
    for (std::uint32_t i = 0; i < observer_count; ++i) {
      const Vector2 at = gas_.observer(i, time);
      filter_->set_subscription_region(
          i, {at.x() - reach_, at.y() - reach_, at.x() + reach_, at.y() + reach_});
    }
    for (const im::Change& change : filter_->match())
      steps_[change.subscriber].push_back(
          {time, change.entity, change.transition == im::Transition::entered});
  }
  const std::vector<ScopeStep>& steps(std::uint32_t observer) const { return steps_[observer]; }
  std::vector<std::uint32_t> scope(std::uint32_t observer) const {
    ScopeHistory history(steps_[observer]);
    history.advance(1e9);
    std::vector<std::uint32_t> entities;
    history.list(nobody, entities);
    return entities;
  }

 private:
  const Gas& gas_;
  double reach_;
  std::unique_ptr<im::Filter> filter_;
  std::vector<std::vector<ScopeStep>> steps_;
};

/// What was decided against what is relevant at `time`.
Classification judged(const Gas& gas, const Decisions& decisions, const RelevanceArea& area,
                      double time) {
  Surroundings surroundings(area, side, side);
  surroundings.build(gas.placed(time));
  Classification counts;
  std::vector<Relevant> relevant;
  for (std::uint32_t i = 0; i < observer_count; ++i) {
    surroundings.find(gas.observer(i, time), nobody, relevant);
    counts.add(decisions.scope(i), relevant);
  }
  return counts;
}

TEST(Health, ASetThatAgesLosesRecallAsEntitiesCrossItsBorder) {
  const Gas gas;
  Decisions decisions(gas, "region", R);
  decisions.match(0.0);
  constexpr double age = 0.06;
  const Classification counts = judged(gas, decisions, square, age);
  const double lost = 2.0 * age * relative_speed / (pi * R);
  EXPECT_NEAR(*counts.recall() / (1.0 - lost), 1.0, 0.01);
  EXPECT_NEAR((1.0 - *counts.recall()) / lost, 1.0, 0.05)
      << "the loss itself; its second order is a v / 8 R = 1 %";
  EXPECT_EQ(*judged(gas, decisions, square, 0.0).recall(), 1.0);
}

TEST(Health, ADiscLosesRecallAsASquareDoes) {
  const Gas gas;
  constexpr double age = 0.06;
  Surroundings then(disc, side, side), now(disc, side, side);
  then.build(gas.placed(0.0));
  now.build(gas.placed(age));
  Classification counts;
  std::vector<Relevant> was, is;
  for (std::uint32_t i = 0; i < observer_count; ++i) {
    then.find(gas.observer(i, 0.0), nobody, was);
    now.find(gas.observer(i, age), nobody, is);
    std::vector<std::uint32_t> chosen;
    for (const Relevant& each : was) chosen.push_back(each.entity);
    counts.add(chosen, is);
  }
  EXPECT_NEAR(*counts.recall() / (1.0 - 2.0 * age * relative_speed / (pi * R)), 1.0, 0.01);
}

TEST(Health, ASquareAroundADiscIsAPiQuarterPrecise) {
  const Gas gas;
  Decisions decisions(gas, "region", R);
  decisions.match(0.0);
  const Classification counts = judged(gas, decisions, disc, 0.0);
  EXPECT_NEAR(*counts.precision() / (pi / 4.0), 1.0, 0.01);
  EXPECT_EQ(*counts.recall(), 1.0);
}

TEST(Health, NineCellsAroundADiscArePiNinthsPrecise) {
  const Gas gas;
  Decisions decisions(gas, "grid", R, R);
  decisions.match(0.0);
  EXPECT_NEAR(*judged(gas, decisions, disc, 0.0).precision() / (pi / 9.0), 1.0, 0.03);
}

TEST(Health, CellsThatADiscTouchesAreAsPreciseAsTheirAreaSays) {
  const Gas gas;
  Surroundings surroundings(disc, side, side);
  surroundings.build(gas.placed(0.0));
  for (const double k : {0.25, 0.5, 1.0}) {
    Classification counts;
    std::vector<Relevant> relevant;
    std::vector<Vector2> lows;  // the corner of each point's cell
    for (std::uint32_t point = 0; point < gas.point_count(); ++point)
      lows.push_back(k * R * (gas.point(point, 0.0) / (k * R)).array().floor().matrix());
    for (std::uint32_t i = 0; i < observer_count; ++i) {
      const Vector2 at = gas.observer(i, 0.0);
      const double x = at.x(), y = at.y();
      std::vector<std::uint32_t> chosen;
      for (std::uint32_t point = 0; point < gas.point_count(); ++point) {
        const double *low = lows[point].data(), dx = std::clamp(x, low[0], low[0] + k * R) - x,
                     dy = std::clamp(y, low[1], low[1] + k * R) - y;
        if (dx * dx + dy * dy <= R * R) chosen.push_back(point);
      }
      surroundings.find(at, nobody, relevant);
      counts.add(chosen, relevant);
    }
    EXPECT_NEAR(*counts.precision() / (pi / (pi + 4.0 * k + k * k)), 1.0, 0.03)
        << "cells of " << k << " R";
    EXPECT_EQ(*counts.recall(), 1.0);
  }
}

TEST(Health, AMarginCostsPrecisionByTheRatioOfAreas) {
  const Gas gas;
  for (const double margin : {0.1, 0.5}) {
    Decisions decisions(gas, "region", R + margin);
    decisions.match(0.0);
    EXPECT_NEAR(*judged(gas, decisions, square, 0.0).precision() / std::pow(R / (R + margin), 2.0),
                1.0, 0.01)
        << "margin " << margin;
  }
}

constexpr double churn_span = 0.5,
                 churn_step = 0.005;  // [s]; who cuts a corner in less than a step is overlooked: a
                                      // part of order v step / R

TEST(Health, ChurnOfASquareFollowsFromItsBorder) {
  const Gas gas;
  Decisions decisions(gas, "region", R);
  for (int step = 0; step * churn_step <= churn_span; ++step) decisions.match(step * churn_step);
  double changes = 0.0;
  for (std::uint32_t i = 0; i < observer_count; ++i) {
    const ScopeChanges counted =
        count_changes(decisions.steps(i), nobody, 0.5 * churn_step, 2.0 * churn_span);
    changes += static_cast<double>(counted.entries + counted.exits);
  }
  EXPECT_NEAR(changes / observer_count / churn_span / (16.0 / pi * R * density * relative_speed),
              1.0, 0.01);
}

TEST(Health, ChurnOfADiscFollowsFromItsBorder) {
  const Gas gas;
  Surroundings surroundings(disc, side, side);
  std::vector<std::vector<Relevant>> before(observer_count);
  std::vector<std::vector<ScopeStep>> steps(observer_count);
  std::vector<Relevant> now;
  for (int step = 0; step * churn_step <= churn_span; ++step) {
    const double time = step * churn_step;
    surroundings.build(gas.placed(time));
    for (std::uint32_t i = 0; i < observer_count; ++i) {
      surroundings.find(gas.observer(i, time), nobody, now);
      const auto is_less = [](const Relevant& a, const Relevant& b) { return a.entity < b.entity; };
      std::vector<Relevant> came, went;
      std::set_difference(now.begin(), now.end(), before[i].begin(), before[i].end(),
                          std::back_inserter(came), is_less);
      std::set_difference(before[i].begin(), before[i].end(), now.begin(), now.end(),
                          std::back_inserter(went), is_less);
      for (const Relevant& each : came) steps[i].push_back({time, each.entity, true});
      for (const Relevant& each : went) steps[i].push_back({time, each.entity, false});
      before[i] = now;
    }
  }
  double changes = 0.0;
  for (const auto& own : steps) {
    const ScopeChanges counted = count_changes(own, nobody, 0.5 * churn_step, 2.0 * churn_span);
    changes += static_cast<double>(counted.entries + counted.exits);
  }
  EXPECT_NEAR(changes / observer_count / churn_span / (4.0 * R * density * relative_speed), 1.0,
              0.01);
}

}  // namespace
}  // namespace rink::loadgen
