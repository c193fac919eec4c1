// Demands on a comparison: what they mean, what they refuse before anything runs, and that what was
// not measured fails.
#include "loadgen/measure/assertion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/loadgen/complaint.h"
#include "tests/loadgen/report/canned_reports.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Experiment experiment() {
  Experiment result = small_experiment();
  result.schemes = {"none", "grid", "region"};
  result.clients = {10, 20};
  result.view_margins = {0.0, 0.5};
  return result;
}

/// Down bytes are clients x 100 for none, x 10 for grid and x 4 for region, plus the margin.
std::vector<SummaryRow> measured() {
  std::vector<RunRecord> runs;
  for (const Cell& cell : cells_of(experiment())) {
    runs.push_back(record_for(experiment(), cell));
    const double scale = cell.scheme == "none" ? 100.0 : cell.scheme == "grid" ? 10.0 : 4.0;
    runs.back().down_bytes_per_client_per_s =
        scale * cell.clients + (cell.scheme == "none" ? 0.0 : cell.parameters.view_margin);
    runs.back().update_age_ms.p99 = 12.5;
    runs.back().valid = true;
  }
  return summarise(runs);
}

bool holds(const std::string& text) {
  return Assertion(text, experiment()).judge(measured()).holds;
}
std::string words(const std::string& text) {
  return Assertion(text, experiment()).judge(measured()).words;
}

std::string assertion_complaint(const std::string& text) {
  return complaint_of([&] { Assertion(text, experiment()); });
}

TEST(Assertion, ArithmeticAndLogicBindAsUsual) {
  for (const char* text :
       {"1 + 2 * 3 == 7", "(1 + 2) * 3 == 9", "8 / 2 / 2 == 2", "7 - 2 - 1 == 4", "-2 * -3 > 5",
        "not 1 > 2", "1 > 2 or 2 > 1 and 3 > 2", "(1 < 2) and 1e3 >= 999.5", "not (1 > 2 or 3 > 4)",
        "1 != 2", "1 <= 1", "- (2 - 3) == 1"})
    EXPECT_TRUE(holds(text)) << text;
  for (const char* text : {"1 > 1", "1 < 2 and 2 < 1", "not 1 < 2", "1 / 0 > 0 or 1 > 2"})
    EXPECT_FALSE(holds(text)) << text;
}

TEST(Assertion, SelectsSchemesThatAreComposed) {
  Experiment composed = small_experiment();
  composed.schemes = {"region", "aura and not (sight or team) with dwell(matches=3)"};
  std::vector<RunRecord> runs;
  for (const Cell& cell : cells_of(composed)) {
    runs.push_back(record_for(composed, cell));
    runs.back().down_bytes_per_client_per_s = cell.scheme == "region" ? 2.0 : 7.0;
    runs.back().valid = true;
  }
  EXPECT_TRUE(Assertion("down_bytes_per_client_per_s[ scheme = aura and not (sight or team) with "
                        "dwell(matches=3) ] == 7",
                        composed)
                  .judge(summarise(runs))
                  .holds);
}

TEST(Assertion, FiguresAreMeansOfSelectedCells) {
  EXPECT_TRUE(holds("down_bytes_per_client_per_s[scheme=none,clients=20] == 2000"));
  EXPECT_TRUE(
      holds("down_bytes_per_client_per_s[scheme=region, clients=10, view_margin=0.5] == 40.5"));
  EXPECT_TRUE(holds("update_age_ms_p99 <= 12.5"));
  EXPECT_TRUE(holds("down_bytes_per_client_per_s_max[scheme=none,clients=10] == 1000"));
}

TEST(Assertion, WhatIsLeftOpenMustHoldForEveryValueAndPairsLikeWithLike) {
  EXPECT_TRUE(
      holds("down_bytes_per_client_per_s[scheme=none] / down_bytes_per_client_per_s[scheme=region] "
            "> 20"));
  EXPECT_TRUE(
      holds("down_bytes_per_client_per_s[scheme=none] / "
            "down_bytes_per_client_per_s[scheme=region,view_margin=0] == 25"));
  EXPECT_FALSE(holds("down_bytes_per_client_per_s[scheme=none] > 1500")) << "not with ten clients";
  EXPECT_THAT(
      words("down_bytes_per_client_per_s[scheme=none] > 1500"),
      AllOf(HasSubstr(
                "fails: down_bytes_per_client_per_s of client-server-none-periodic-10 = 1000\n"),
            HasSubstr(
                "holds: down_bytes_per_client_per_s of client-server-none-periodic-20 = 2000\n")));
}

TEST(Assertion, WhatWasNotMeasuredFailsAndIsNamed) {
  EXPECT_FALSE(holds("filter_recall >= 0"));
  EXPECT_FALSE(holds("not filter_recall >= 0"));
  EXPECT_TRUE(holds("filter_recall >= 0 or 1 > 0"));
  EXPECT_FALSE(holds("down_bytes_per_client_per_s_high > 0")) << "one replication has no interval";
  EXPECT_THAT(
      words("filter_recall[scheme=grid,clients=10,view_margin=0] == 1"),
      HasSubstr(
          "fails, undefined: filter_recall of client-server-grid-periodic-10-margin0 = undefined"));
  EXPECT_FALSE(Assertion("update_age_ms_p99 < 20", experiment()).judge({}).holds) << "nothing ran";
}

TEST(Assertion, NamesThatDoNotExistAreRefusedWithThoseThatDo) {
  EXPECT_THAT(assertion_complaint("down_bytes > 3"),
              AllOf(HasSubstr("no figure is called down_bytes"),
                    HasSubstr("down_bytes_per_client_per_s"), HasSubstr("update_age_ms_p99")));
  EXPECT_THAT(assertion_complaint("filter_recall[filter=grid] > 3"),
              AllOf(HasSubstr("no key of a cell is called filter"), HasSubstr("scheme")));
  EXPECT_THAT(assertion_complaint("filter_recall[scheme=gird] > 3"),
              AllOf(HasSubstr("no cell for filter_recall[scheme=gird]"),
                    HasSubstr("client-server-grid-periodic-10")));
  EXPECT_THAT(assertion_complaint("filter_recall[clients=ten] > 3"),
              HasSubstr("clients = ten is not"));
  EXPECT_THAT(assertion_complaint("filter_recall[clients=30] > 3"), HasSubstr("no cell for"));
}

TEST(Assertion, WhatIsNoDemandIsRefusedWithTheColumn) {
  for (const char* text : {"", "1", "1 >", "(1 > 2", "1 > 2)", "1 < 2 < 3", "ticks[",
                           "ticks[scheme]", "ticks[scheme=none > 1", "1 + (2 > 1) > 0", "1 and 2",
                           "not 1", "1 > 2 3", "1 = 1", "\x01 > 1"})
    EXPECT_THAT(assertion_complaint(text),
                AllOf(HasSubstr("--assert '"), HasSubstr("column"), HasSubstr("expected")))
        << text;
  const std::string deep(1'000, '(');
  EXPECT_THAT(assertion_complaint(deep + "1 > 0"), HasSubstr("levels of parentheses"));
  std::string nots;
  for (int i = 0; i < 500; ++i) nots += "not ";
  EXPECT_THAT(assertion_complaint(nots + "1 > 0"), HasSubstr("levels of parentheses"));
  EXPECT_THAT(assertion_complaint(std::string(100'000, '-') + "1 > 0"), HasSubstr("longer than"));
}

}  // namespace
}  // namespace rink::loadgen
