// The axis of nodes in experiments: its cells, their names, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "loadgen/experiment/experiment_file.h"
#include "loadgen/run/game_plan.h"
#include "tests/loadgen/complaint.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string of_arena = "name = 'x'\nscene = 'arena'\nkeys = 'live'\n";

std::string complaint_on_nodes(const std::string& text) {
  return complaint_of([&] { parse_experiment(text, "dir/x.toml", {}); });
}

TEST(ExperimentNodes, AreAnAxisWhoseCellsAreNamedByTheirNumber) {
  const Experiment experiment =
      parse_experiment(of_arena + "nodes = [1, 2, 8]\nschemes = 'region'\nbaseline = {nodes = 1}\n",
                       "dir/x.toml", {});
  std::vector<std::string> names;
  for (const Cell& cell : cells_of(experiment)) {
    names.push_back(name_of(cell));
    EXPECT_EQ(baseline_of(cell, experiment.baseline()).parameters.nodes, 1u);
  }
  EXPECT_THAT(names, testing::ElementsAre("client-server-region-periodic-10-seed1",
                                          "client-server-region-periodic-10-nodes2-seed1",
                                          "client-server-region-periodic-10-nodes8-seed1"));
  EXPECT_EQ(variant_of(cells_of(experiment)[1]), "2 nodes");
}

TEST(ExperimentNodes, OutsideTheRangeAreRefusedByFileLineAndKey) {
  for (const char* number : {"0", "65", "1.5", "-2", "'two'"})
    EXPECT_THAT(complaint_on_nodes(of_arena + "nodes = " + number),
                testing::AllOf(StartsWith("dir/x.toml:4: nodes = "),
                               HasSubstr("whole numbers from 1 to 64")))
        << number;
}

TEST(ExperimentNodes, RefuseWhatServersThatShareASimulationDoNotDo) {
  EXPECT_EQ(complaint_on_nodes(of_arena + "nodes = 2"), "no complaint");
  EXPECT_EQ(complaint_on_nodes("name = 'x'\nscene = 'arena'\nnodes = 1\ntransport = 'virtual'"),
            "no complaint");
  EXPECT_THAT(complaint_on_nodes(of_arena + "nodes = [1, 2]\nmodes = ['peer-to-peer']"),
              StartsWith("dir/x.toml: "));
  EXPECT_THAT(complaint_on_nodes("name = 'x'\nscene = 'arena'\nnodes = [1, 2]\n"
                                 "modes = ['client-server', 'peer-to-peer']\nclients = 4"),
              HasSubstr("dir/x.toml: nodes = 2 is of servers that share a simulation"));
  for (const char* transport : {"virtual", "udp", "shm"})
    EXPECT_THAT(complaint_on_nodes(of_arena + "nodes = 2\ntransport = '" + transport + "'"),
                HasSubstr(std::string("dir/x.toml: nodes = 2 needs transport = \"tcp\", not \"") +
                          transport + "\""));
  EXPECT_THAT(complaint_on_nodes("name = 'x'\nscene = 'arena'\nnodes = [4, 2]"),
              HasSubstr("dir/x.toml: nodes = 4 needs keys = \"live\""));
  EXPECT_THAT(complaint_on_nodes(of_arena + "nodes = 2\nstart_s = 1"),
              HasSubstr("dir/x.toml: nodes = 2 begins with the scene"));
  EXPECT_THAT(complaint_on_nodes(of_arena + "nodes = [1, 8]\nclients = [16, 4]"),
              HasSubstr("dir/x.toml: nodes = 8 is more than clients = 4"));
  EXPECT_THAT(
      complaint_on_nodes(of_arena + "[[parts]]\nname = 'a'\nnodes = 2\ntransport = 'virtual'"),
      HasSubstr("nodes = 2 needs transport"));
}

TEST(ExperimentNodes, RefuseASceneWithScriptedKeys) {
  const test::TemporaryFolder folder("nodes-keys");
  std::ofstream(folder / "scripted.toml") << R"(
name = "scripted"
[field]
length = 4.0
width = 2.0
[[bat]]
name = "left"
position = [0.5, 1.0]
half_extent = [0.125, 0.25]
mass = 2.0
[[bat]]
name = "right"
position = [3.5, 1.0]
half_extent = [0.125, 0.25]
mass = 2.0
[[key]]
time = 0.1
bat = "left"
key = "up"
is_down = true
)";
  const Experiment experiment =
      parse_experiment("name = 'x'\nscene = 'scripted.toml'\nkeys = 'live'\nnodes = 2\nclients = 2",
                       folder / "x.toml", {});
  EXPECT_THAT(complaint_of([&] {
                write_game_plan(experiment, cells_of(experiment).front(), folder / "some.keys");
              }),
              testing::AllOf(HasSubstr("experiment x: nodes: scene "), HasSubstr("scripted.toml"),
                             HasSubstr("has scripted keys")));
}

}  // namespace
}  // namespace rink::loadgen
