// Drawn mobility traces: the laws that they promise, and the way through a file and back.
#include "loadgen/mobility/trace_models.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "loadgen/mobility/trace_formats.h"
#include "tests/loadgen/mobility/agent_places.h"

namespace rink::loadgen {
namespace {

class EveryTraceModel : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, EveryTraceModel, testing::ValuesIn(trace_models()),
                         [](const auto& name) {
                           return name.param == "flash-crowd" ? "flash_crowd" : name.param;
                         });

TEST_P(EveryTraceModel, EveryAgentIsThereFromBeginningToEndWithinTheSquare) {
  const MobilityTrace trace = drawn_trace(
      {.name = GetParam(), .count = 500, .side = 800.0, .duration_s = 300.0, .seed = 7});
  ASSERT_EQ(trace.agents.size(), 500u);
  for (const Agent& agent : trace.agents) {
    EXPECT_EQ(agent.points.front().time_s, 0.0);
    EXPECT_EQ(agent.points.back().time_s, 300.0);
    EXPECT_TRUE(agent.returns.empty());
    for (std::size_t k = 0; k < agent.points.size(); ++k) {
      const TracePoint& point = agent.points[k];
      EXPECT_TRUE(point.x >= 0.0 && point.x <= 800.0 && point.y >= 0.0 && point.y <= 800.0);
      EXPECT_TRUE(k == 0 || point.time_s > agent.points[k - 1].time_s);
    }
  }
}

TEST_P(EveryTraceModel, TheSeedDecidesAndAFileKeepsEveryBit) {
  TraceModel model{.name = GetParam(), .count = 10'000, .duration_s = 120.0, .seed = 3};
  const MobilityTrace trace = drawn_trace(model);
  const MobilityTrace again = parse_trace(csv_of(trace), "drawn", "csv");
  ASSERT_EQ(again.agents.size(), trace.agents.size());
  for (std::size_t k = 0; k < trace.agents.size(); ++k)
    ASSERT_EQ(again.agents[k].points, trace.agents[k].points);
  EXPECT_EQ(csv_of(drawn_trace(model)), csv_of(trace));
  model.seed = 4;
  EXPECT_NE(csv_of(drawn_trace(model)), csv_of(trace));
}

TEST(TraceModels, WalkersGoAtTheSpeedsOfPedestrians) {
  const MobilityTrace trace = drawn_trace(
      {.name = "hotspots", .count = 4000, .side = 500.0, .duration_s = 400.0, .seed = 1});
  std::vector<double> speeds;
  for (const Agent& agent : trace.agents)
    for (std::size_t k = 1; k < agent.points.size(); ++k) {
      const double way = std::hypot(agent.points[k].x - agent.points[k - 1].x,
                                    agent.points[k].y - agent.points[k - 1].y);
      if (way == 0.0) continue;
      speeds.push_back(way / (agent.points[k].time_s - agent.points[k - 1].time_s));
      break;
    }
  ASSERT_GT(speeds.size(), 3000u);
  const auto count = static_cast<double>(speeds.size());
  const double mean = std::accumulate(speeds.begin(), speeds.end(), 0.0) / count;
  double squares = 0.0;
  for (const double speed : speeds) squares += (speed - mean) * (speed - mean);
  // Who is faster begins its first way as early, so that none is left out by speed.
  EXPECT_NEAR(mean, 1.34, 4.0 * 0.26 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count), 0.26, 0.02);
}

TEST(TraceModels, TheFirstHotSpotHoldsItsShareOfZipf) {
  const TraceModel model{
      .name = "hotspots", .count = 10'000, .side = 20'000.0, .duration_s = 1.0, .seed = 5};
  const MobilityTrace trace = drawn_trace(model);
  // Places of the beginning, in cells of a spot's size: the fullest neighbourhood.
  std::map<std::pair<int, int>, int> cells;
  const double cell = 500.0;
  for (const Agent& agent : trace.agents)
    ++cells[{static_cast<int>(agent.points[0].x / cell),
             static_cast<int>(agent.points[0].y / cell)}];
  int fullest = 0;
  for (const auto& [at, count] : cells) {
    int around = 0;
    for (int dx = -2; dx <= 2; ++dx)
      for (int dy = -2; dy <= 2; ++dy)
        if (const auto there = cells.find({at.first + dx, at.second + dy}); there != cells.end())
          around += there->second;
    fullest = std::max(fullest, around);
  }
  double harmonic = 0.0;
  for (int rank = 1; rank <= 100; ++rank) harmonic += 1.0 / rank;
  const double share = 1.0 / harmonic;  // 0.193
  EXPECT_GT(fullest, 0.9 * share * 10'000);
  EXPECT_LT(fullest, 2.5 * share * 10'000) << "others' spots may overlap it";
}

TEST(TraceModels, AFlashCrowdComesTogetherAndGoes) {
  const TraceModel model{
      .name = "flash-crowd", .count = 5000, .side = 200.0, .duration_s = 1000.0, .seed = 2};
  const MobilityTrace trace = drawn_trace(model);
  const double radius = std::sqrt(0.8 * 5000 * 0.65 / std::numbers::pi);
  const auto within = [&](double instant_s) {
    return std::ranges::count_if(trace.agents, [&](const Agent& agent) {
      return (place_at(agent, instant_s) - Vector2(100.0, 100.0)).norm() <= radius + 1e-9;
    });
  };
  const double area_share = std::numbers::pi * radius * radius / (200.0 * 200.0);
  const double even = 5000 * area_share, all = 4000 + 1000 * area_share;
  EXPECT_NEAR(static_cast<double>(within(0.0)), even, 4.0 * std::sqrt(even));
  EXPECT_NEAR(static_cast<double>(within(600.0)), all, 4.0 * std::sqrt(5000 * 0.8 * 0.2));
  EXPECT_LT(within(1000.0), 2.0 * even + 200);
}

TEST(TraceModels, CommutersTravelAsLongAsFlightsOfTheirLengthTake) {
  EXPECT_NEAR(flight_time_s(100.0), 30.55 * std::pow(100.0, 0.11), 1e-9);
  EXPECT_NEAR(flight_time_s(5000.0), 0.76 * std::pow(5000.0, 0.72), 1e-9);
  const MobilityTrace trace = drawn_trace(
      {.name = "commuters", .count = 2000, .side = 10'000.0, .duration_s = 20'000.0, .seed = 9});
  std::size_t shorter = 0;
  for (const Agent& agent : trace.agents) {
    ASSERT_GE(agent.points.size(), 5u) << "home, out, work, back, home";
    const TracePoint &out = agent.points[1], &work = agent.points[2];
    const double way = std::hypot(work.x - out.x, work.y - out.y);
    EXPECT_NEAR(work.time_s - out.time_s, flight_time_s(way), 1e-6);
    shorter += way < 2000.0 ? 1u : 0u;
    EXPECT_EQ(agent.points.back().x, agent.points.front().x) << "at home again";
  }
  // The density (d + 1500)^-1.75 puts 0.60 of distances up to 10 km below 2 km; ways that would
  // leave the square, most of them long, are drawn anew.
  EXPECT_GT(static_cast<double>(shorter) / 2000.0, 0.60);
  EXPECT_LT(static_cast<double>(shorter) / 2000.0, 0.75);
}

}  // namespace
}  // namespace rink::loadgen
