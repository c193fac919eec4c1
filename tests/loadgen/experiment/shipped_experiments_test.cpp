// Every experiment that comes with the program: it is read, its plan is printed, it compares
// something, and its least version runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "loadgen/experiment/experiment_file.h"
#include "loadgen/measure/summary.h"
#include "loadgen/report/table.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/peers/peer_run.h"
#include "loadgen/run/virtual_run.h"
#include "tests/command.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;

std::vector<std::string> shipped() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(test::source_folder() + "/scenes/experiments"))
    names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class ShippedExperiment : public test::CommandTest,
                          public testing::WithParamInterface<std::string> {
 protected:
  ShippedExperiment() : CommandTest("shipped-experiment") {}
  void run_least_version_of(Experiment experiment);
  static Experiment load() {
    return load_experiment(test::source_folder() + "/scenes/experiments/" + GetParam() + ".toml",
                           {});
  }
};

TEST_P(ShippedExperiment, IsFoundByItsNameAndPrintsItsPlan) {
  EXPECT_EQ(run("compare " + GetParam() + " --dry-run --out " + (folder_ / "out").string()), 0)
      << said_;
  EXPECT_THAT(printed_, HasSubstr(std::to_string(cells_of(load()).size())));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

/// Whoever sweeps a parameter under one scheme and policy alone compares each cell with itself.
TEST_P(ShippedExperiment, WithSeveralCellsOfAGameComparesThemWithABaselineThatRuns) {
  const Experiment experiment = load();
  const std::vector<Cell> cells = cells_of(experiment);
  std::set<std::string> variants, compared;
  for (const Cell& cell : cells) {
    if (cell.clients != cells.front().clients || cell.pucks != cells.front().pucks) continue;
    if (cell.bats != cells.front().bats || part_of(experiment, cell.part).is_of_curves) continue;
    variants.insert(name_of(without_seed(cell)));
    const Cell baseline = baseline_among(cells, cell, experiment.baseline())
                              .value_or(baseline_of(cell, experiment.baseline()));
    if (baseline == cell) continue;
    compared.insert(name_of(without_seed(cell)));
    EXPECT_NE(std::find(cells.begin(), cells.end(), baseline), cells.end())
        << name_of(cell) << " refers to " << name_of(baseline) << ", which does not run";
  }
  EXPECT_TRUE(variants.size() == 1 || !compared.empty())
      << "each of its " << variants.size() << " cells is its own baseline";
}

/// A few clients for a third of a second of virtual time: one cell for each of its modes and of its
/// schemes.
TEST_P(ShippedExperiment, RunsInItsLeastVersion) {
  const Experiment whole = load();
  const std::vector<Experiment> itself{whole};
  for (const Experiment& part : whole.parts.empty() ? itself : whole.parts) {
    SCOPED_TRACE(part.part);
    run_least_version_of(part);
  }
}

void ShippedExperiment::run_least_version_of(Experiment experiment) {
  experiment.transport = TransportKind::virtual_time;
  experiment.clients = {4}, experiment.seeds = {1}, experiment.duration_s = 0.25,
  experiment.warm_up_s = 0.1;
  experiment.tick_rates_hz = {20.0};
  experiment.population = Population::per_client;
  experiment.pucks = experiment.bats = {0};
  experiment.server_cores = {1};
  experiment.nodes = {1.0};  // several do not play in virtual time
  experiment.design = Design::matrix;
  for (auto* list : {&experiment.view_fractions, &experiment.view_margins, &experiment.sweep_ticks,
                     &experiment.cell_sizes, &experiment.thresholds, &experiment.output_rates_hz})
    *list = {list->back()};
  experiment.policies = {experiment.policies.back()};
  RunnerSettings settings;
  settings.directory = folder_;
  const std::filesystem::path log = folder_ / "some.keys";
  const std::vector<Cell> cells = cells_of(experiment);
  write_game_plan(experiment, cells.front(), log);
  std::set<std::string> hashes;
  for (const Cell& cell : cells) {
    if (cell.mode == dds_mode) continue;  // processes alone; tests/dds runs them
    const auto record = (cell.mode == peer_mode ? run_virtual_peers : run_virtual_cell)(
        settings, experiment, cell, log);
    ASSERT_TRUE(record) << name_of(cell);
    EXPECT_TRUE(record->valid) << name_of(cell) << ": " << record->why_invalid
                               << record->truth.error;
    EXPECT_EQ(record->ticks, 5u);
    EXPECT_TRUE(record->truth.filter_recall || cell.scheme == "owner")
        << name_of(cell) << ": " << record->truth.error;
    hashes.insert(record->state_hash);
  }
  EXPECT_TRUE(hashes.size() == 1 || experiment.keys == KeySource::live) << "one game";
}

INSTANTIATE_TEST_SUITE_P(All, ShippedExperiment, testing::ValuesIn(shipped()),
                         [](const auto& info) { return info.param; });

/// What is swept has ratios to no filter, each of its own; with one scheme alone the page said
/// `baseline` four times.
TEST(SweptExperiment, ComparesEachSweepAndMarginWithNoFilter) {
  const Experiment experiment =
      load_experiment(test::source_folder() + "/scenes/experiments/swept.toml", {});
  std::vector<RunRecord> runs;
  for (const Cell& cell : cells_of(experiment)) {
    RunRecord& run = runs.emplace_back(record_for(experiment, cell));
    run.valid = true;
    run.down_bytes_per_client_per_s =
        cell.scheme == "none"
            ? 8'000.0
            : 1'000.0 * (1.0 + cell.parameters.sweep_ticks) * (1.0 + cell.parameters.view_margin);
  }
  EXPECT_EQ(runs.size(), 2u * 5u);
  const Baseline baseline{experiment.baseline_scheme, experiment.baseline_policy};
  std::set<std::string> ratios;
  for (const SummaryRow& row : summarise(runs, baseline))
    if (row.scheme != "none")
      ratios.insert(std::to_string(row.ratio("down_bytes_per_client_per_s").value().value));
  EXPECT_EQ(ratios.size(), 4u);
  EXPECT_THAT(table_of(runs, false, baseline), HasSubstr("times less: than none with on-event"));
  std::erase_if(runs, [](const RunRecord& run) { return run.cell.scheme == "none"; });
  EXPECT_THAT(
      table_of(runs, false, {"region", "on-event"}),
      HasSubstr("nothing is compared: all cells are of the baseline, region with on-event"));
}

}  // namespace
}  // namespace rink::loadgen
