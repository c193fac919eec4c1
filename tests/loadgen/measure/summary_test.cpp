// Means over replications by hand, runs that do not count, the agreement of games, and the table's
// shape.
#include "loadgen/measure/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "loadgen/measure/judge_run.h"
#include "loadgen/report/table.h"
#include "tests/loadgen/report/canned_reports.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;
using testing::Not;

RunRecord run(const std::string& scheme, std::uint32_t clients, std::uint64_t seed, double down,
              bool valid = true) {
  const Cell cell{"client-server", scheme, "periodic", clients, seed};
  RunRecord record = record_for(small_experiment(), cell);
  judge(record, canned_server_report(cell), canned_bots_report(cell));
  record.down_bytes_per_client_per_s = down;
  record.state_hash = "hash-of-seed-" + std::to_string(seed);
  record.valid = valid;
  record.why_invalid = valid ? "" : "bots were late";
  return record;
}

const std::vector<RunRecord> runs{run("none", 10, 1, 100.0),      run("grid", 10, 1, 30.0),
                                  run("none", 10, 2, 104.0),      run("grid", 10, 2, 36.0),
                                  run("none", 10, 3, 1e9, false), run("grid", 10, 3, 33.0)};

TEST(Summary, MeansAndDeviationsAreThoseOfTheValidRuns) {
  const auto rows = summarise(runs);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].scheme, "none");
  EXPECT_EQ(rows[0].valid_runs, 2u);
  EXPECT_EQ(rows[0].invalid_runs, 1u);
  const Statistic& none = rows[0].of("down_bytes_per_client_per_s");
  EXPECT_DOUBLE_EQ(none.mean.value(), 102.0);
  EXPECT_DOUBLE_EQ(none.deviation.value(), std::sqrt(8.0));
  EXPECT_DOUBLE_EQ(none.min.value(), 100.0);
  EXPECT_DOUBLE_EQ(none.max.value(), 104.0);
  const Statistic& grid = rows[1].of("down_bytes_per_client_per_s");
  EXPECT_DOUBLE_EQ(grid.mean.value(), 33.0);
  EXPECT_DOUBLE_EQ(grid.deviation.value(), 3.0);
  EXPECT_NEAR(grid.interval->high, 33.0 * std::exp(4.302652730 * std::sqrt(3.0) / 33.0), 1e-6);
}

TEST(Summary, AFigureThatOneValidRunLacksIsAbsent) {
  std::vector<RunRecord> some = runs;
  some[0].update_age_ms.p99.reset();
  const auto rows = summarise(some);
  EXPECT_FALSE(rows[0].of("update_age_ms_p99").mean);
  EXPECT_TRUE(rows[0].of("update_age_ms_p50").mean);
  EXPECT_TRUE(rows[1].of("update_age_ms_p99").mean);
}

TEST(Summary, WithoutAValidRunThereIsARowButNoFigure) {
  const auto rows = summarise(std::vector<RunRecord>{run("none", 10, 1, 5.0, false)});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_FALSE(rows[0].of("down_bytes_per_client_per_s").mean);
  EXPECT_FALSE(rows[0].ratio("down_bytes_per_client_per_s"));
}

TEST(Summary, RatiosAreToTheBaselinePairedBySeed) {
  const auto rows = summarise(runs);
  EXPECT_FALSE(rows[0].ratio("down_bytes_per_client_per_s")) << "the baseline itself";
  const Ratio ratio = rows[1].ratio("down_bytes_per_client_per_s").value();
  EXPECT_EQ(ratio.pairs, 2u) << "the third seed's baseline does not count";
  EXPECT_NEAR(ratio.value, std::sqrt(30.0 / 100.0 * 36.0 / 104.0), 1e-12);
  EXPECT_TRUE(ratio.interval);
  EXPECT_FALSE(summarise(runs, {"region", "periodic"})[1].ratio("down_bytes_per_client_per_s"))
      << "no such baseline was run";
  EXPECT_THAT(
      comparisons_csv(rows, {}),
      HasSubstr("client-server,grid,periodic,10,0,0,1,0.05,0.3,0,0,30,0.005,1,1,0,,none,periodic,"
                "update_age_ms_p50,1,1,1,2,no significant difference,none with periodic\n"));
}

TEST(Summary, ParametersPucksAndCoresMakeRowsOfTheirOwn) {
  std::vector<RunRecord> some{run("grid", 10, 1, 30.0), run("grid", 10, 1, 40.0),
                              run("grid", 10, 1, 50.0), run("grid", 10, 2, 60.0)};
  some[1].cell.parameters.cell_size = 3.0;
  some[2].cell.pucks = 7;
  ASSERT_EQ(summarise(some).size(), 3u);
  EXPECT_DOUBLE_EQ(summarise(some)[0].of("down_bytes_per_client_per_s").mean.value(), 45.0);
  EXPECT_EQ(summarise(some)[2].pucks, 7u);
}

TEST(Summary, RowsAreGroupedByClientsAscendingWithTheSchemesInOrder) {
  const auto rows = summarise(std::vector<RunRecord>{run("none", 30, 1, 1), run("grid", 30, 1, 1),
                                                     run("none", 5, 1, 1), run("grid", 5, 1, 1)});
  std::string order;
  for (const SummaryRow& row : rows) order += row.scheme + std::to_string(row.clients) + " ";
  EXPECT_EQ(order, "none5 grid5 none30 grid30 ");
}

TEST(Summary, GamesAgreeUnlessTwoValidRunsOfOneSeedDiffer) {
  EXPECT_EQ(agreement_of(runs).games, 3u - 1u);  // of the third seed only one run is valid
  EXPECT_TRUE(agreement_of(runs).differing.empty());
  std::vector<RunRecord> some = runs;
  some[4].state_hash = "odd";  // invalid, takes no part
  EXPECT_TRUE(agreement_of(some).differing.empty());
  some[1].state_hash = "odd";
  ASSERT_EQ(agreement_of(some).differing.size(), 1u);
  EXPECT_THAT(agreement_of(some).differing[0], HasSubstr("seed1: hash-of-seed-1 odd"));
  for (RunRecord& record : some) record.keys = "live";
  EXPECT_EQ(agreement_of(some).games, 0u);
}

TEST(Summary, GamesOfAPopulationThatFollowsTheClientsAreHeldAgainstEachOtherAtEachNumberOfClients) {
  std::vector<RunRecord> some{run("none", 10, 1, 1), run("grid", 10, 1, 1), run("none", 20, 1, 1),
                              run("grid", 20, 1, 1)};
  some[2].state_hash = some[3].state_hash = "more bats";
  EXPECT_EQ(agreement_of(some).differing.size(), 1u)
      << "a fixed population plays one game whoever looks on";
  for (RunRecord& record : some) record.population = "per_client";
  EXPECT_EQ(agreement_of(some).games, 2u);
  EXPECT_TRUE(agreement_of(some).differing.empty());
  some[3].state_hash = "odd";
  EXPECT_EQ(agreement_of(some).differing.size(), 1u);
}

TEST(Summary, CsvHasOneLinePerRowAndEmptyFieldsForWhatIsAbsent) {
  std::istringstream csv(to_csv(summarise(runs)));
  std::string header, none, grid, rest;
  std::getline(csv, header);
  std::getline(csv, none);
  std::getline(csv, grid);
  EXPECT_FALSE(std::getline(csv, rest));
  const auto commas = [](const std::string& line) {
    return std::count(line.begin(), line.end(), ',');
  };
  EXPECT_EQ(commas(header), static_cast<std::ptrdiff_t>(19 + 6 * figures().size()));
  EXPECT_EQ(commas(none), commas(header));
  EXPECT_THAT(none, testing::StartsWith(
                        "client-server,none,periodic,10,0,0,1,0.05,0.3,0,0,30,0.005,1,1,0,,2,1,"));
  EXPECT_THAT(none, HasSubstr(",102,"));
  EXPECT_THAT(none, HasSubstr(",,,,"));  // update_age_ms_p999
  EXPECT_THAT(none, Not(HasSubstr("1e+09")));
}

TEST(Table, FitsHundredAndTwentyColumnsAndSaysWhatDidNotCount) {
  std::vector<RunRecord> some = runs;
  some.push_back(run("region", 100'000, 1, 123'456.0));
  std::istringstream table(table_of(some, false));
  for (std::string line; std::getline(table, line);) {
    if (line.find("invalid") == std::string::npos) {
      EXPECT_LE(line.size(), 120u) << line;
    }
  }
  EXPECT_THAT(table_of(some, false), HasSubstr("same state hash: yes"));
  EXPECT_THAT(table_of(some, false),
              HasSubstr("client-server-none-periodic-10-seed3: bots were late"));
  EXPECT_THAT(table_of(some, false), Not(HasSubstr("\033")));
  some[0].state_hash = "odd";
  EXPECT_THAT(table_of(some, false), HasSubstr("same state hash: NO"));
}

TEST(Table, SaysAloudWhatReplicationsCannotTellApart) {
  const auto text = [](std::vector<RunRecord> some) { return table_of(some, false); };
  EXPECT_THAT(text({run("none", 10, 1, 100), run("grid", 10, 1, 50)}),
              HasSubstr("cannot be told from one replication"));
  EXPECT_THAT(text({run("none", 10, 1, 100), run("grid", 10, 1, 50), run("none", 10, 2, 100),
                    run("grid", 10, 2, 150)}),
              HasSubstr("no significant difference"));
  const std::string clear = text({run("none", 10, 1, 100), run("grid", 10, 1, 50),
                                  run("none", 10, 2, 100), run("grid", 10, 2, 51)});
  EXPECT_THAT(clear, HasSubstr("1.98 [1.75, 2.25]"));  // sqrt(2 * 100/51); log ratios .6931 and
                                                       // .6733, half width 12.706 * .0099
  EXPECT_THAT(clear, Not(HasSubstr("no significant difference")));
}

TEST(Table, GainsOfFilterAndPolicyStandApartAndTogetherBesideTheError) {
  std::vector<RunRecord> some;
  for (const std::uint64_t seed : {1u, 2u}) {
    const auto add = [&](const char* scheme, const char* policy, double down, double error) {
      some.push_back(run(scheme, 10, seed, down * static_cast<double>(seed)));
      some.back().cell.policy = policy;
      some.back().truth.displayed_error_mm.rms = error;
    };
    add("none", "periodic", 1200, 30), add("region", "periodic", 100, 31),
        add("none", "on-event", 400, 2), add("region", "on-event", 40, 3);
  }
  const std::string text = table_of(some, false);
  EXPECT_THAT(text,
              HasSubstr("10 clients, region with on-event: 30.0 [30.0, 30.0] times less payload"));
  EXPECT_THAT(text, HasSubstr("filter alone 12.0 [12.0, 12.0], policy alone 3.00 [3.00, 3.00]; "
                              "displayed error 3.00 mm beside 30.0 mm"));
}

}  // namespace
}  // namespace rink::loadgen
