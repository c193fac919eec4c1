// Nodes as processes that share a simulation, with their bots: one game, measured, and named if
// they fail; and how their reports are combined.
#include "loadgen/run/nodes/node_processes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "loadgen/measure/tables/nodes_table.h"
#include "loadgen/run/cell_runner.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/nodes/node_reports.h"
#include "loadgen/run/run_ending.h"
#include "tests/loadgen/report/canned_reports.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

/// Five players, three at one node and two at the other.
class NodeProcessesTest : public testing::Test {
 protected:
  NodeProcessesTest() {
    settings_.directory = folder_;
    settings_.serve = test::binary_folder() + "/bin/rink-serve";
    settings_.bots = test::binary_folder() + "/bin/rink-bots";
    experiment_.name = "small", experiment_.scene = "arena";
    experiment_.population = Population::per_client;
    experiment_.schemes = {"region"}, experiment_.policies = {"on-event"};
    experiment_.clients = {5}, experiment_.nodes = {2.0};
    experiment_.view_area = 4.0;
    experiment_.keys = KeySource::live;
    experiment_.tick_rates_hz = {20.0};
    experiment_.warm_up_s = 0.3, experiment_.duration_s = 1.2;
    write_game_plan(experiment_, cell(), folder_ / "log.keys");
  }
  Cell cell() const { return cells_of(experiment_).front(); }
  std::optional<RunRecord> run() const {
    return run_cell(settings_, experiment_, cell(), folder_ / "log.keys");
  }
  nlohmann::json report(const std::string& ending) const {
    return nlohmann::json::parse(test::text_of(folder_ / (name_of(cell()) + ending)));
  }

  test::TemporaryFolder folder_{"node-processes"};
  RunnerSettings settings_;
  Experiment experiment_;
};

TEST_F(NodeProcessesTest, PlayOneGameWithTheirClientsAndSayWhatItCost) {
  const auto record = run();
  ASSERT_TRUE(record);
  // On a machine that is busy with something else keys may be late, and then the run does not
  // count; all else holds.
  EXPECT_THAT(record->why_invalid, AnyOf("", HasSubstr("could not keep their schedule")));
  EXPECT_EQ(record->state_hash.size(), 16u);
  EXPECT_EQ(record->ticks, 24u);
  EXPECT_GT(*record->nodes.between_bytes_per_s, 1000.0);
  EXPECT_GT(*record->nodes.busiest_link_bytes_per_s, *record->nodes.between_bytes_per_s)
      << "each of two links carries all that both send each other";
  EXPECT_GT(*record->nodes.busiest_cpu_s, 0.0);
  EXPECT_LT(*record->nodes.busiest_cpu_s, *record->server_cpu_s);
  EXPECT_FALSE(record->physics_us_per_tick) << "nodes play beside their ticks";
  EXPECT_EQ(report(".server.json")["clients"], 5.0);
  EXPECT_EQ(report(".bots.json")["bytes_received_by_bot"].size(), 5u);
  const nlohmann::json three = report(".node0.server.json"), two = report(".node1.server.json");
  EXPECT_EQ(three["clients"].get<int>() + two["clients"].get<int>(), 5);
  EXPECT_EQ(three["node_bytes_sent"][0], 0);
  EXPECT_GT(three["node_bytes_sent"][1], 0);
  EXPECT_EQ(two["node_bytes_sent"][1], 0);
  EXPECT_GT(two["node_bytes_sent"][0], 0);
}

TEST_F(NodeProcessesTest, NameWhoIsKilled) {
  const std::filesystem::path script = folder_ / "serve.sh";
  std::ofstream(script)
      << "#!/bin/sh\ncase \"$*\" in *--join*) (sleep 1; kill -9 $$) & ;; esac\nexec "
      << settings_.serve.string() << " \"$@\"\n";
  std::filesystem::permissions(script, std::filesystem::perms::owner_all);
  settings_.serve = script;
  experiment_.duration_s = 20.0;
  const auto record = run();
  ASSERT_TRUE(record);
  EXPECT_FALSE(record->valid);
  EXPECT_THAT(record->why_invalid, HasSubstr("node process 1 was ended by signal 9"));
}

/// The first node ends for the other's sake, with a status of its own.
TEST_F(NodeProcessesTest, NameWhoFailsFirst) {
  const std::filesystem::path script = folder_ / "serve.sh";
  const std::string serve = settings_.serve.string();
  std::ofstream(script) << "#!/bin/sh\ncase \"$*\" in\n*--join*) (sleep 1; kill -9 $$) & exec "
                        << serve << " \"$@\";;\n*) " << serve
                        << " \"$@\"; sleep 0.5; exit 5;;\nesac\n";
  std::filesystem::permissions(script, std::filesystem::perms::owner_all);
  settings_.serve = script;
  experiment_.duration_s = 20.0;
  const auto record = run();
  ASSERT_TRUE(record);
  EXPECT_THAT(record->why_invalid, HasSubstr("node process 1 was ended by signal 9"));
}

TEST_F(NodeProcessesTest, NameAFirstOneThatDoesNotListen) {
  settings_.serve = "/bin/false";
  const auto record = run();
  ASSERT_TRUE(record);
  EXPECT_EQ(record->why_invalid, "node process 0 ended with status 1 before it listened");
}

NodeResults canned_node(std::uint32_t number, std::vector<double> sent) {
  Cell cell{.mode = "client-server", .scheme = "region", .policy = "periodic", .clients = 10};
  NodeResults node{number, canned_server_report(cell), canned_bots_report(cell)};
  node.server["node_bytes_sent"] = sent;
  for (double& each : sent) each = 0.0;
  for (const char* key :
       {"node_segments_sent", "node_acknowledgements_sent", "node_kernel_segments_sent"})
    node.server[key] = sent;
  return node;
}

/// Of three nodes the second sends and receives most, and each byte between nodes counts once.
TEST(NodeReports, AddUpClientsAndFindTheBusiestLink) {
  const std::vector<NodeResults> nodes{canned_node(0, {0, 1000, 10}), canned_node(1, {2000, 0, 20}),
                                       canned_node(2, {30, 3000, 0})};
  const auto server = nodes_report(nodes), bots = bots_report_of(nodes);
  const double down = 400'000 + 66.0 * (1'000 + 40 + 0.5 * (1'000 - 600)),
               up = 4'000 + 66.0 * (100 + 300);
  EXPECT_DOUBLE_EQ(server["busiest_link_bytes"].get<double>(), down + up + 2020 + 4000);
  EXPECT_DOUBLE_EQ(server["between_nodes_bytes"].get<double>(), 6060.0);
  EXPECT_EQ(server["clients"], 30.0);
  EXPECT_EQ(server["bytes_sent"], 1'200'000.0);
  EXPECT_EQ(server["ticks"], 60);
  EXPECT_EQ(server["physics_us_per_tick"], nullptr);
  EXPECT_EQ(bots["keys_due"], 210);
  EXPECT_EQ(bots["update_age_ms"]["count"], 6'000);
  EXPECT_EQ(bots["valid"], true);
}

TEST(NodeReports, AnInvalidNodeIsNamedAndOneThatToldNothingFails) {
  std::vector<NodeResults> nodes{canned_node(0, {0, 1}), canned_node(1, {1, 0})};
  nodes[1].server["valid"] = false, nodes[1].server["why_invalid"] = "no tick was measured";
  EXPECT_EQ(nodes_report(nodes)["valid"], false);
  EXPECT_EQ(nodes_report(nodes)["why_invalid"], "node 1: no tick was measured");
  nodes[0].server.erase("node_bytes_sent");
  EXPECT_THROW(nodes_report(nodes), Failure);
}

RunRecord record_of(std::uint32_t nodes, std::uint64_t seed, double link) {
  RunRecord record;
  record.cell = {.mode = "client-server",
                 .scheme = "region",
                 .policy = "on-event",
                 .clients = 64,
                 .seed = seed};
  record.cell.parameters.nodes = nodes;
  record.valid = true;
  record.nodes.busiest_link_bytes_per_s = link;
  record.nodes.busiest_cpu_s = 1.0, record.server_cpu_s = nodes;
  return record;
}

TEST(NodesTable, SaysInASentenceWhatMoreNodesCostAndGain) {
  const std::vector<RunRecord> runs{record_of(1, 1, 1e5), record_of(2, 1, 5e4),
                                    record_of(1, 2, 2e5), record_of(2, 2, 1e5)};
  EXPECT_THAT(nodes_table(runs),
              testing::AllOf(HasSubstr("64 region"), HasSubstr("+- n=2"),
                             HasSubstr("2 nodes instead of 1: the busiest link carries 0.50 times "
                                       "(0.50 to 0.50) as much"),
                             HasSubstr("all nodes together take 2.00 times"),
                             testing::Not(HasSubstr("a key comes"))));
  EXPECT_EQ(nodes_table(std::span(runs).first(1)), "");
}

}  // namespace
}  // namespace rink::loadgen
