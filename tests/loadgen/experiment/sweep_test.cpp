// Sweeps: what a parameter does stands in a column of table and CSV, and as a curve per scheme in
// the report.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "loadgen/experiment/parameter.h"
#include "loadgen/measure/summary.h"
#include "loadgen/report/report.h"
#include "loadgen/report/sections/section_content.h"
#include "loadgen/report/table.h"
#include "tests/loadgen/report/canned_reports.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Experiment sweep_of_cells() {
  Experiment experiment = small_experiment();
  experiment.schemes = {"none", "grid", "region"};
  experiment.cell_sizes = {2.0, 0.5, 1.0};
  experiment.view_margins = {0.0, 0.25};
  experiment.design = Design::one_at_a_time;
  experiment.clients = {10};
  experiment.seeds = {1, 2};
  return experiment;
}

/// Runs whose precision is 1 / (1 + side of a cell).
std::vector<RunRecord> canned_runs_of(const Experiment& experiment) {
  std::vector<RunRecord> runs;
  for (const Cell& cell : cells_of(experiment)) {
    RunRecord run = record_for(experiment, cell);
    run.valid = true;
    run.truth.relevance = "x";
    run.truth.filter_precision =
        cell.scheme == "none"
            ? 0.05
            : 1.0 / (1.0 + cell.parameters.cell_size + cell.parameters.view_margin);
    run.truth.filter_recall = 0.98;
    run.down_bytes_per_client_per_s = 1000.0 / *run.truth.filter_precision;
    run.state_hash = "same";
    runs.push_back(run);
  }
  return runs;
}

const PlotTable& table_called(const Report& report, const std::string& name) {
  const auto table = std::find_if(report.tables.begin(), report.tables.end(),
                                  [&name](const PlotTable& t) { return t.name == name; });
  if (table == report.tables.end()) throw std::runtime_error("no table " + name);
  return *table;
}

TEST(Sweep, EachSchemeIsACurveAlongTheParameterInAscendingOrder) {
  const Experiment experiment = sweep_of_cells();
  const Report report = report_of(experiment, canned_runs_of(experiment), {});
  const PlotTable& table = table_called(report, "sweep-cell_size");
  const auto column = [&table](const std::string& name) {
    return static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), name) -
                                    table.columns.begin());
  };
  std::vector<std::string> schemes, sizes;
  for (const auto& row : table.rows) {
    ASSERT_EQ(row.size(), table.columns.size());
    schemes.push_back(row[column("scheme")]), sizes.push_back(row[column("cell_size")]);
    if (row[column("scheme")] == "grid") {
      EXPECT_NEAR(std::stod(row[column("precision")]),
                  1.0 / (1.0 + std::stod(row[column("cell_size")])), 1e-12);
    }
  }
  EXPECT_THAT(schemes, testing::ElementsAre("none", "grid", "grid", "grid", "region"))
      << "with the first margin alone";
  EXPECT_THAT(sizes, testing::ElementsAre("", "0.5", "1", "2", ""));
  EXPECT_EQ(table_called(report, "sweep-view_margin").rows.size(), 1u + 2u + 2u);
  EXPECT_THAT(report.html,
              AllOf(HasSubstr("Precision against recall, by side of a cell [m]"),
                    HasSubstr("Bytes against precision, by margin around the view [m]")));
  EXPECT_THAT(report.html, Not(HasSubstr("by ticks per second")));
}

/// Expressions that differ in their numbers alone are a curve, in the experiment's order; whatever
/// else they are named stands as it is.
TEST(Stages, ExpressionsOfOneFormAreACurveOfBytesAgainstErrorAndRecall) {
  Experiment experiment = small_experiment();
  experiment.schemes = {"aura",
                        "aura with tiers(at=0.7)",
                        "aura with tiers(at=0.3 at=0.6)",
                        "aura with priority(budget=400)",
                        "aura with priority(budget=100)",
                        "grid(cell_size=2) with priority(budget=100)"};
  experiment.clients = {5, 10};
  experiment.seeds = {1, 2};
  std::vector<RunRecord> runs = canned_runs_of(experiment);
  for (RunRecord& run : runs)
    run.truth.displayed_error_mm.rms = 3.0, run.truth.delivered_recall = 0.9;
  const Report report = report_of(experiment, runs, {});
  const PlotTable& table = table_called(report, "stages");
  const auto column = [&table](const std::string& name) {
    return static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), name) -
                                    table.columns.begin());
  };
  std::vector<std::string> forms, numbers;
  for (const auto& row : table.rows) {
    ASSERT_EQ(row.size(), table.columns.size());
    forms.push_back(row[column("form")]), numbers.push_back(row[column("numbers")]);
    EXPECT_EQ(row[column("displayed_error_mm_rms")], "3");
    EXPECT_EQ(row[column("clients")], "10") << "at the largest number of clients";
  }
  EXPECT_THAT(forms,
              testing::ElementsAre("aura", "aura with tiers(at)", "aura with tiers(at)",
                                   "aura with priority(budget)", "aura with priority(budget)",
                                   "grid(cell_size) with priority(budget)"));
  EXPECT_THAT(numbers, testing::ElementsAre("", "0.7", "0.3 0.6", "400", "100", "2 100"));
  EXPECT_THAT(report.html, AllOf(HasSubstr("Bytes against displayed error"),
                                 HasSubstr("Bytes against delivered recall")));
  const Experiment plain = sweep_of_cells();
  EXPECT_THAT(report_of(plain, canned_runs_of(plain), {}).html,
              Not(HasSubstr("Bytes against delivered recall")))
      << "nothing there differs in its numbers alone";
}

TEST(Sweep, ASchemeThatGivesItsOwnSizeOfCellsRunsOnce) {
  Experiment experiment = sweep_of_cells();
  experiment.schemes = {"grid(cell_size=2)", "grid(cell_size=2) or grid"};
  experiment.view_margins = {0.0};
  experiment.seeds = {1};
  EXPECT_EQ(cells_of(experiment).size(), 1u + experiment.cell_sizes.size());
}

TEST(Sweep, WithoutOneBytesStandAgainstRecallAndPrecisionAllTheSame) {
  Experiment experiment = sweep_of_cells();
  experiment.cell_sizes = {1.0}, experiment.view_margins = {0.0};
  const Report report = report_of(experiment, canned_runs_of(experiment), {});
  EXPECT_EQ(table_called(report, "bytes-against-relevance").rows.size(), 3u);
  EXPECT_THAT(report.html, AllOf(HasSubstr("Bytes against recall"),
                                 HasSubstr("no parameter with several values")));
}

TEST(Sweep, PlotsOverClientsKeepToTheFirstValuesWhereAllWouldBeTooMany) {
  Experiment experiment = sweep_of_cells();
  std::vector<RunRecord> runs = canned_runs_of(experiment);
  EXPECT_EQ(plotted_lines({experiment, runs, {}, lines_of(runs), "x"}).size(),
            lines_of(runs).size());
  experiment.cell_sizes = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13};
  runs = canned_runs_of(experiment);
  const auto drawn = plotted_lines({experiment, runs, {}, lines_of(runs), "x"});
  ASSERT_EQ(drawn.size(), 3u);
  EXPECT_EQ(drawn[1].name, "grid") << "nothing is left to tell apart";
}

TEST(Sweep, TheTableHasAColumnForWhatDiffersAndADashWhereASchemeLacksIt) {
  const Experiment experiment = sweep_of_cells();
  const std::string table = table_of(canned_runs_of(experiment), false, {"none", "periodic"});
  EXPECT_THAT(table,
              AllOf(HasSubstr("cells, m"), HasSubstr("margin, m"), Not(HasSubstr("rate, Hz"))));
  EXPECT_THAT(table, HasSubstr("grid    periodic          0       0.5 "));
  EXPECT_THAT(table, HasSubstr("region  periodic       0.25         - "));
}

TEST(Sweep, SummariesHaveAColumnForEveryParameter) {
  const Experiment experiment = sweep_of_cells();
  const auto rows = summarise(canned_runs_of(experiment));
  for (const std::string& csv : {to_csv(rows), comparisons_csv(rows, {})})
    for (const ParameterKind& kind : parameter_kinds())
      EXPECT_THAT(csv.substr(0, csv.find('\n')), HasSubstr(std::string(",") + kind.key + ","))
          << kind.key;
}

TEST(Sweep, GamesThatEndAtOtherInstantsAreNotHeldAgainstEachOther) {
  Experiment experiment = small_experiment();
  experiment.warm_up_s = 0.0, experiment.duration_s = 1.0;
  std::vector<RunRecord> runs;
  for (const double rate : {10.0, 30.0, 7.5}) {
    Cell cell{"client-server", "none", "periodic", 10, 1};
    cell.parameters.tick_rate_hz = rate;
    runs.push_back(record_for(experiment, cell));
    runs.back().valid = true;
    runs.back().state_hash = rate == 7.5 ? "of 0.933 s" : "of 1 s";
  }
  const Agreement agreement = agreement_of(runs);
  EXPECT_EQ(agreement.games, 1u);
  EXPECT_TRUE(agreement.differing.empty());
}

}  // namespace
}  // namespace rink::loadgen
