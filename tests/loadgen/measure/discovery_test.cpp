// Delays of discovery as distribution functions: exact where they say something, bounded, and
// censored where nothing came.
#include "loadgen/measure/tables/discovery_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "loadgen/report/dictionary.h"
#include "loadgen/report/sections/section_content.h"
#include "tests/loadgen/report/canned_reports.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Point = SampleDistribution::Point;

/// 1, 2, ... `ended` ms, and `never` without an end.
SampleDistribution evenly(std::uint64_t ended, std::uint64_t never) {
  SampleDistribution delays;
  for (std::uint64_t i = ended; i > 0; --i) delays.add(1e-3 * static_cast<double>(i));
  for (std::uint64_t i = 0; i < never; ++i) delays.add_never();
  return delays;
}

TEST(SampleDistribution, AFewAreAllInTheDistribution) {
  SampleDistribution delays;
  for (const double delay_s : {0.005, 0.0, 0.0, 0.0051, 0.005}) delays.add(delay_s);
  delays.add_never(), delays.add_never(), delays.add_never();
  EXPECT_EQ(delays.samples(), 8u);
  EXPECT_THAT(delays.distribution(200),
              ElementsAre(Point{0.0, 2.0 / 8.0}, Point{5.0, 4.0 / 8.0}, Point{5.1, 5.0 / 8.0}));
}

/// Of n delays evenly spread over n ms the part below d ms is d / (n + never).
TEST(SampleDistribution, ManyGiveABoundedNumberOfPointsEachOfWhichIsExact) {
  for (const std::uint64_t ended : {150u, 198u, 199u, 1000u, 54321u}) {
    const SampleDistribution delays = evenly(ended, 250);
    const std::vector<Point> points = delays.distribution(200);
    ASSERT_LE(points.size(), 200u) << ended;
    EXPECT_GE(points.size(), std::min<std::size_t>(100, ended)) << ended;
    EXPECT_EQ(points.front(), (Point{0.0, 0.0}));
    const double all = static_cast<double>(ended + 250);
    double before = -1.0;
    for (const Point& point : points) {
      EXPECT_NEAR(point.fraction, point.thousandths / all, 1e-12) << ended;
      EXPECT_GT(point.fraction, before);
      before = point.fraction;
    }
    EXPECT_DOUBLE_EQ(points.back().thousandths, static_cast<double>(ended));
    EXPECT_DOUBLE_EQ(points.back().fraction, 1.0 - static_cast<double>(delays.never()) /
                                                       static_cast<double>(delays.samples()));
  }
}

TEST(SampleDistribution, WhatNeverCameKeepsTheDistributionAtNothing) {
  EXPECT_THAT(evenly(0, 3).distribution(200), ElementsAre(Point{0.0, 0.0}));
  EXPECT_TRUE(SampleDistribution().distribution(200).empty());
}

TEST(SampleDistribution, OfSeveralRunsAreThoseOfAllTogether) {
  SampleDistribution together = evenly(10, 1);
  together.merge(evenly(20, 2));
  EXPECT_EQ(together.samples(), 33u);
  EXPECT_EQ(together.never(), 3u);
  EXPECT_EQ(together.distribution(200).at(10), (Point{10.0, 20.0 / 33.0}))
      << "each of the first ten twice";
}

TEST(SampleDistribution, ReadBackAsTheyWereWrittenAndNothingElseIsTaken) {
  const SampleDistribution delays = evenly(7, 2);
  const std::string text = delays.to_json().dump();
  EXPECT_EQ(SampleDistribution::from_json(nlohmann::json::parse(text)), delays);
  for (const char* wrong :
       {"[]", "{}", R"({"never":0})", R"({"never":-1,"millionths":[]})",
        R"({"never":0,"millionths":[[1]]})", R"({"never":0,"millionths":[[1,0]]})",
        R"({"never":0,"millionths":[[2,1],[1,1]]})", R"({"never":0,"millionths":[[2,1],[2,1]]})",
        R"({"never":0,"millionths":[[1.5,1]]})", R"({"never":0,"millionths":3})"})
    EXPECT_FALSE(SampleDistribution::from_json(nlohmann::json::parse(wrong))) << wrong;
}

class DiscoveryTable : public testing::Test {
 protected:
  /// A run of `scheme` whose discoveries lie in the folder.
  void add(const std::string& scheme, std::uint64_t seed, const Discoveries& discoveries,
           std::uint32_t clients = 10, const std::string& part = "") {
    RunRecord& run = runs_.emplace_back(
        record_for(small_experiment(), {"client-server", scheme, "periodic", clients, seed}));
    run.valid = true;
    run.cell.part = part;
    write_discoveries(discovery_file(folder_.path(), run.cell), discoveries);
  }

  test::TemporaryFolder folder_{"discoveries"};
  std::vector<RunRecord> runs_;
};

TEST_F(DiscoveryTable, PoolsTheValidReplicationsOfACell) {
  add("grid", 1, {evenly(2, 0), evenly(0, 1)});
  add("region, but odd", 1, {evenly(1, 0), {}});
  add("grid", 2, {evenly(2, 4), evenly(1, 0)});
  add("grid", 3, {evenly(9, 9), evenly(9, 9)});
  runs_.back().valid = false;
  add("grid", 4, {});
  std::ofstream(discovery_file(folder_.path(), runs_.back().cell)) << "torn";
  add("grid", 5, {});
  std::ofstream(discovery_file(folder_.path(), runs_.back().cell))
      << R"({"schema":2,"late_discovery":{"never":9,"millionths":[]},"missed_contact":{"never":9,"millionths":[]}})";
  const auto cells = discoveries_in(folder_.path(), runs_);
  ASSERT_EQ(cells.size(), 2u);
  const std::string csv = discovery_csv(cells), names = ",client-server,grid,periodic,10,0,0,1,";
  EXPECT_THAT(csv, testing::StartsWith(
                       "part,mode,scheme,policy,clients,pucks,bats,server_cores,view_fraction"));
  EXPECT_THAT(csv, HasSubstr(",kind,delay_ms,fraction,samples,never\n"));
  EXPECT_THAT(csv, HasSubstr(",late_discovery,0,0,8,4\n"));
  EXPECT_THAT(csv, HasSubstr(",late_discovery,1,0.25,8,4\n"));
  EXPECT_THAT(csv, HasSubstr(",late_discovery,2,0.5,8,4\n"));
  EXPECT_THAT(csv, HasSubstr(",missed_contact,1,0.5,2,1\n"));
  EXPECT_THAT(csv, HasSubstr("\n" + names));
  EXPECT_THAT(csv, HasSubstr("\n,client-server,\"region, but odd\",periodic"));
  for (const char* column : {"kind", "delay_ms", "fraction", "samples", "never"})
    EXPECT_TRUE(data_dictionary_csv().find("\n" + std::string(column) + ",discovery,") !=
                std::string::npos)
        << column;
  EXPECT_THAT(csv, Not(HasSubstr("18"))) << "an invalid run is in no sample";
}

/// The curve ends as far below 1 as never was discovered, and says so.
TEST_F(DiscoveryTable, IsDrawnForTheLargestNumberOfClients) {
  add("grid", 1, {evenly(30, 10), {}}, 20);
  add("region", 1, {evenly(40, 0), {}}, 20);
  add("region", 1, {evenly(5, 95), {}}, 2);
  const Experiment experiment = small_experiment();
  const auto cells = discoveries_in(folder_.path(), runs_);
  const Findings findings{experiment, runs_, {}, lines_of(runs_), "x", cells};
  const SectionContent content = discovery_content(findings);
  ASSERT_EQ(content.pictures.size(), 1u);
  EXPECT_THAT(content.html, HasSubstr("grid: 10 of 40 never discovered (25.0 % never)"));
  EXPECT_THAT(content.html, HasSubstr("region: 0 of 40 never discovered"));
  EXPECT_THAT(content.html, HasSubstr("what was never discovered: grid 10 of 40."));
  EXPECT_THAT(content.html, Not(HasSubstr("95 of 100"))) << "of the smaller number of clients";
  EXPECT_THAT(content.html, HasSubstr("Missed contacts: no player touched a body that it did not "
                                      "know of, so there is no plot."));
  ASSERT_EQ(content.tables.size(), 1u);
  EXPECT_EQ(content.tables[0].name, "late-discovery");
  EXPECT_EQ(content.tables[0].rows.size(), 31u + 41u)
      << "a point at nothing and one for each delay";
}

/// Side by side: what is late with a delay of 50 ms is not without one.
TEST_F(DiscoveryTable, IsDrawnForEachPartOfTheLargestNumberOfClients) {
  add("region", 1, {evenly(30, 10), {}}, 20, "late");
  add("region", 1, {evenly(40, 0), {}}, 20, "prompt");
  add("region", 1, {evenly(5, 95), {}}, 2, "smaller");
  Experiment experiment = small_experiment();
  for (const char* part : {"late", "prompt", "smaller"})
    experiment.parts.push_back(small_experiment()), experiment.parts.back().part = part;
  const auto cells = discoveries_in(folder_.path(), runs_);
  const SectionContent content =
      discovery_content({experiment, runs_, {}, lines_of(runs_), "x", cells});
  EXPECT_THAT(content.tables,
              testing::ElementsAre(testing::Field(&PlotTable::name, "late-discovery-late"),
                                   testing::Field(&PlotTable::name, "late-discovery-prompt")));
  EXPECT_THAT(content.html, testing::AllOf(HasSubstr("Late discoveries, 20 clients, late"),
                                           HasSubstr("what was never discovered: region 10 of 40."),
                                           HasSubstr("what was never discovered, here nothing.")));
}

}  // namespace
}  // namespace rink::loadgen
