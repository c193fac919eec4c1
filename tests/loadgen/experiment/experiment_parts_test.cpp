// Experiments of several parts, each with what the experiment says and what it says otherwise; and
// cells in virtual time that run beside each other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "loadgen/experiment/experiment_file.h"
#include "loadgen/measure/run_fields.h"
#include "loadgen/run/campaign.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/virtual_run.h"
#include "tests/loadgen/complaint.h"
#include "tests/temporary_folder.h"
#include "tests/words.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string whole =
    "name = 'e'\nscene = 'crowd'\nseeds = [1, 2]\nclients = [3]\ntransport = 'virtual'\ndelay_ms = "
    "5\n";

Experiment read(const std::string& text) { return parse_experiment(text, "x.toml", {}); }

TEST(ExperimentParts, TakeWhatTheExperimentSaysUnlessTheySayOtherwise) {
  const Experiment experiment = read(whole +
                                     "[[parts]]\nname = 'one'\n[[parts]]\nname = 'two'\nseeds = "
                                     "7\ndelay_ms = 50\npolicies = ['on-event', 'periodic']\n");
  ASSERT_EQ(experiment.parts.size(), 2u);
  const Experiment &one = experiment.parts[0], &two = experiment.parts[1];
  EXPECT_EQ(one.seeds, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(two.seeds, (std::vector<std::uint64_t>{7}));
  EXPECT_EQ(one.delay_ms, 5.0);
  EXPECT_EQ(two.delay_ms, 50.0);
  EXPECT_EQ(two.clients, one.clients);
  EXPECT_EQ(two.scene, "crowd");
  EXPECT_EQ(&part_of(experiment, "two"), &two);
  EXPECT_EQ(&part_of(experiment, ""), &experiment);
  EXPECT_EQ(cells_of(experiment).size(), 3u * 2u + 3u * 2u);
}

TEST(ExperimentParts, HaveCellsOfDifferentNames) {
  std::set<std::string> names;
  const auto cells = cells_of(read(
      whole + "extrapolate = [true, false]\n[[parts]]\nname = 'one'\n[[parts]]\nname = 'two'\n"));
  for (const Cell& cell : cells) names.insert(name_of(cell));
  EXPECT_EQ(names.size(), cells.size());
  EXPECT_THAT(names, testing::Contains("two-client-server-region-periodic-paper-3-seed1"));
}

TEST(ExperimentParts, MayBeOfTheBaselineThatAnotherRuns) {
  const Experiment experiment = read(whole +
                                     "baseline_scheme = 'grid'\n[[parts]]\nname = 'one'\nschemes = "
                                     "'grid'\n[[parts]]\nname = 'two'\nschemes = 'region'\n");
  EXPECT_EQ(experiment.parts[1].baseline_scheme, "grid");
}

TEST(ExperimentParts, AreRefusedByNameAndLine) {
  const auto complaint = [](const std::string& text) {
    return complaint_of([&] { parse_experiment(whole + text, "dir/x.toml", {}); });
  };
  EXPECT_THAT(complaint("[[parts]]\nname = 'one'\n[[parts]]\nname = 'one'\n"),
              HasSubstr("parts: the name one is that of another part"));
  EXPECT_THAT(complaint("[[parts]]\nseeds = 1\n"),
              HasSubstr("dir/x.toml:7: parts: name is missing"));
  EXPECT_THAT(complaint("[[parts]]\nname = 'a/b'\n"),
              StartsWith("dir/x.toml:8: parts.name = 'a/b': allowed is"));
  EXPECT_THAT(complaint("[[parts]]\nname = 'one'\nscene = 'match'\n"),
              StartsWith("dir/x.toml:9: unknown key parts.scene"));
  EXPECT_THAT(complaint("[[parts]]\nname = 'one'\nclients = 0\n"),
              StartsWith("dir/x.toml:9: parts.clients = 0: allowed is"));
  EXPECT_THAT(complaint("[[parts]]\nname = 'one'\ncurves = 1\n"),
              StartsWith("dir/x.toml:9: parts.curves = 1: allowed is true"));
  EXPECT_THAT(complaint("clientz = 3\n[[parts]]\nname = 'one'\n"),
              StartsWith("dir/x.toml:7: unknown key clientz"));
  EXPECT_THAT(complaint("parts = 3\n"), HasSubstr("parts = 3: allowed is a list of tables"));
}

TEST(Policies, AreComparedByAThresholdOnlyIfTheyTakeOne) {
  const auto cells =
      cells_of(read("name = 'e'\nscene = 'crowd'\nschemes = 'region'\nbaseline_scheme = 'region'\n"
                    "policies = ['periodic', 'snapshot', 'dead-reckoning', 'dead-reckoning-drag', "
                    "'on-event']\nthreshold = [0.002, 0.02, 0.2]\nextrapolate = [true, false]\n"));
  std::map<std::string, int> count;
  for (const Cell& cell : cells) ++count[policy_name(cell)];
  EXPECT_EQ(count, (std::map<std::string, int>{{"periodic", 1},
                                               {"periodic (paper)", 1},
                                               {"snapshot", 1},
                                               {"dead-reckoning", 3},
                                               {"dead-reckoning-drag", 3},
                                               {"on-event", 1}}));
}

/// What a campaign says does not depend on what else runs at the time.
TEST(CampaignInVirtualTime, SaysTheSameWhetherCellsRunBesideEachOtherOrAlone) {
  const Experiment experiment = read(
      "name = 'e'\nscene = 'crowd'\npopulation = 'per_client'\nseeds = [1, 2]\nclients = "
      "[4]\ntransport = 'virtual'\nduration_s = 0.5\nwarm_up_s = 0.1\n"
      "[[parts]]\nname = 'one'\n[[parts]]\nname = 'two'\ncurves = true\nduration_s = 0.8\ndelay_ms "
      "= 30\npolicies = ['on-event', 'periodic']\n");
  const test::TemporaryFolder folder("parts");
  ResultsDirectory results(folder / "out", false);
  RunnerSettings settings;
  settings.directory = results.subdirectory("cells");
  std::ostringstream said;
  Progress progress(said, false, cells_of(experiment).size(), 0.1);
  const auto write_keys = [&](const Cell& cell, const std::filesystem::path& file) {
    write_game_plan(part_of(experiment, cell.part), cell, file);
  };
  const CampaignResult outcome =
      run_campaign({experiment, settings, results, write_keys}, progress);
  const std::vector<Cell> cells = cells_of(experiment);
  ASSERT_EQ(outcome.runs.size(), cells.size()) << outcome.output_failure;
  settings.directory = folder.path();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_EQ(outcome.runs[i].cell, cells[i]) << "in the order of the plan";
    EXPECT_TRUE(outcome.runs[i].valid) << outcome.runs[i].why_invalid;
    const Experiment& part = part_of(experiment, cells[i].part);
    const std::filesystem::path keys = results.path() / "keys" /
                                       ("seed" + std::to_string(cells[i].seed) + "-4" +
                                        (cells[i].part == "two" ? "-0.9s" : "") + ".keys");
    settings.keeps_traces = cells[i].part == "one";
    const auto alone = run_virtual_cell(settings, part, cells[i], keys);
    ASSERT_TRUE(alone);
    EXPECT_EQ(to_json(*alone).dump(), to_json(outcome.runs[i]).dump());
    const bool has_evidence =
        std::filesystem::exists(results.path() / "cells" / (name_of(cells[i]) + ".server.jsonl"));
    EXPECT_EQ(has_evidence, cells[i].part == "one") << "points of curves keep none";
    EXPECT_EQ(alone->truth.late_entry_ms.max.has_value(), cells[i].part == "one")
        << "nor is it found out when entities became relevant to them";
    EXPECT_TRUE(alone->truth.delivered_recall && alone->truth.displayed_error_mm.p50)
        << "all else is";
  }
}

}  // namespace
}  // namespace rink::loadgen
