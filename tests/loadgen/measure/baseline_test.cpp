// Ratios refer to a baseline over any axis, and cells run in a seeded order.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "loadgen/experiment/experiment_file.h"
#include "loadgen/measure/summary.h"
#include "loadgen/report/table.h"
#include "tests/loadgen/complaint.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;

const std::string swept =
    "name = 'e'\nscene = 'crowd'\nschemes = ['grid', 'region']\npolicies = ['on-event', "
    "'periodic']\nview_margin = [0, 0.3]\nclients = [5, 10]\nseeds = [1, 2, 3]\n";

Experiment swept_by(const std::string& text) { return parse_experiment(text, "x.toml", {}); }

std::vector<RunRecord> runs_of(const Experiment& experiment) {
  std::vector<RunRecord> runs;
  for (const Cell& cell : cells_of(experiment)) {
    RunRecord& run = runs.emplace_back(record_for(experiment, cell));
    run.valid = true;
    run.down_bytes_per_client_per_s = (cell.scheme == "grid" ? 2.0 : 1.0) *
                                      (cell.policy == "periodic" ? 10.0 : 1.0) *
                                      (1.0 + cell.parameters.view_margin) * cell.clients;
  }
  return runs;
}

TEST(BaselineOverAnyAxis, ComparesASweepWithOneOfItsOwnValues) {
  const Experiment experiment =
      swept_by(swept + "baseline = { scheme = 'region', policy = 'periodic', view_margin = 0.3 }");
  const std::vector<RunRecord> runs = runs_of(experiment);
  for (const SummaryRow& row : summarise(runs, experiment.baseline())) {
    const auto ratio = row.ratio("down_bytes_per_client_per_s");
    const bool is_baseline =
        row.scheme == "region" && row.policy == "periodic" && row.parameters.view_margin == 0.3;
    EXPECT_EQ(ratio.has_value(), !is_baseline);
    if (ratio) {
      EXPECT_NEAR(ratio->value,
                  (row.scheme == "grid" ? 2.0 : 1.0) * (row.policy == "periodic" ? 1.0 : 0.1) *
                      (1.0 + row.parameters.view_margin) / 1.3,
                  1e-12);
    }
  }
  EXPECT_THAT(table_of(runs, false, experiment.baseline()),
              HasSubstr("times less: than region with periodic, view_margin 0.3"));
  EXPECT_THAT(comparisons_csv(summarise(runs, experiment.baseline()), experiment.baseline()),
              HasSubstr(",\"region with periodic, view_margin 0.3\"\n"));
}

/// `none` has no margin, so it is compared with the first one that ran.
TEST(BaselineOverAnyAxis, MayHaveAParameterThatACellLacks) {
  const Experiment experiment = swept_by(
      "name = 'e'\nscene = 'crowd'\nschemes = ['none', 'region']\nview_margin = [0.5, "
      "0.7]\nbaseline = { scheme = 'region' }");
  const std::vector<Cell> cells = cells_of(experiment);
  ASSERT_EQ(cells.front().scheme, "none");
  EXPECT_EQ(
      baseline_among(cells, cells.front(), experiment.baseline()).value().parameters.view_margin,
      0.5);
  for (const SummaryRow& row : summarise(runs_of(experiment), experiment.baseline()))
    EXPECT_EQ(row.ratio("down_bytes_per_client_per_s").has_value(), row.scheme == "none");
}

TEST(BaselineOverAnyAxis, LeavesEachCellWhatItDoesNotName) {
  const Experiment experiment = swept_by(swept + "baseline = { view_margin = 0 }");
  for (const SummaryRow& row : summarise(runs_of(experiment), experiment.baseline())) {
    const auto ratio = row.ratio("down_bytes_per_client_per_s");
    ASSERT_EQ(ratio.has_value(), row.parameters.view_margin == 0.3) << name_of(row);
    if (ratio) {
      EXPECT_NEAR(ratio->value, 1.3, 1e-12) << "its own scheme and policy without a margin";
    }
  }
  EXPECT_THAT(table_of(runs_of(experiment), false, experiment.baseline()),
              HasSubstr("times less: than view_margin 0, 95"));
}

TEST(BaselineOverAnyAxis, MayBeTheMode) {
  const Experiment experiment = swept_by(
      "name = 'm'\nscene = 'arena'\ntransport = 'virtual'\nmodes = ['client-server', "
      "'peer-to-peer']\npolicies = 'on-event'\nbaseline = { mode = 'client-server' }");
  std::size_t compared = 0;
  for (const SummaryRow& row : summarise(runs_of(experiment), experiment.baseline()))
    compared += row.mode == "peer-to-peer" && row.ratio("down_bytes_per_client_per_s").has_value();
  EXPECT_EQ(compared, 3u);
}

TEST(BaselineOverAnyAxis, ThatNoCellHasIsRefusedByName) {
  const auto complaint = [](const std::string& text) {
    return complaint_of([&] { swept_by(swept + text); });
  };
  EXPECT_THAT(complaint("baseline = { view_margin = 0.7 }"),
              HasSubstr("x.toml: baseline: no cell of the experiment is view_margin 0.7"));
  EXPECT_THAT(complaint("baseline = { scheme = 'none' }"),
              HasSubstr("no cell of the experiment is none"));
  EXPECT_THAT(complaint("baseline = { margin = 0.3 }"),
              HasSubstr("baseline.margin = 0.3: allowed are mode, scheme, policy"));
  EXPECT_THAT(complaint("baseline = { view_margin = 'wide' }"),
              HasSubstr("baseline.view_margin = wide: no value of that key"));
  EXPECT_THAT(complaint("baseline = 3"), HasSubstr("baseline = 3: allowed is a table"));
  EXPECT_THROW(swept_by(swept + "baseline = { clients = 7 }"), BaselineError);
}

TEST(RunningOrder, IsAPermutationOfEachReplicationThatFollowsFromItsSeed) {
  const Experiment experiment = swept_by(swept);
  const std::vector<Cell> planned = cells_of(experiment), order = running_order(experiment);
  ASSERT_EQ(planned.size(), order.size());
  EXPECT_EQ(order, running_order(experiment));
  EXPECT_NE(order, planned);
  EXPECT_TRUE(std::ranges::is_permutation(order, planned,
                                          [](const Cell& a, const Cell& b) { return a == b; }));
  EXPECT_TRUE(std::ranges::is_sorted(order, {}, &Cell::seed))
      << "an interrupted experiment has whole replications";
  const std::size_t n = planned.size() / 3;
  std::set<std::vector<std::string>> orders;
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < n; ++i) names.push_back(name_of(without_seed(order[k * n + i])));
    orders.insert(names);
  }
  EXPECT_EQ(orders.size(), 3u) << "each replication has an order of its own";
}

// The document had it that whole replications come one after the other, parts or not.
TEST(RunningOrder, GoesPartByPartAndThereReplicationByReplication) {
  const Experiment experiment =
      swept_by(swept + "[[parts]]\nname = 'one'\n[[parts]]\nname = 'two'\n");
  std::vector<std::pair<std::string, std::uint64_t>> replications;
  for (const Cell& cell : running_order(experiment))
    if (replications.empty() || replications.back() != std::pair(cell.part, cell.seed))
      replications.emplace_back(cell.part, cell.seed);
  EXPECT_EQ(replications,
            (std::vector<std::pair<std::string, std::uint64_t>>{
                {"one", 1}, {"one", 2}, {"one", 3}, {"two", 1}, {"two", 2}, {"two", 3}}));
}

/// Over many seeds each cell is in each place about as often.
TEST(RunningOrder, PutsEveryCellInEveryPlace) {
  Experiment experiment;
  experiment.seeds.clear();
  for (std::uint64_t seed = 0; seed < 3000; ++seed) experiment.seeds.push_back(seed);
  std::map<std::pair<std::string, std::size_t>, int> count;
  const auto order = running_order(experiment);
  for (std::size_t i = 0; i < order.size(); ++i) ++count[{order[i].scheme, i % 3}];
  ASSERT_EQ(count.size(), 9u);
  for (const auto& [place, times] : count)
    EXPECT_NEAR(times, 1000, 110) << place.first << " at " << place.second;
}

}  // namespace
}  // namespace rink::loadgen
