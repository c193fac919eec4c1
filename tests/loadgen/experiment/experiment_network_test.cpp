// The modelled network of an experiment: what its table says, what it refuses, and what it does to
// a run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "loadgen/experiment/experiment_file.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/virtual_run.h"
#include "tests/loadgen/complaint.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::string minimal_virtual = "name = 'x'\nscene = 'crowd'\ntransport = 'virtual'\n";

Experiment experiment_with(const std::string& text) {
  return parse_experiment(minimal_virtual + text, "x.toml", {});
}

std::string network_complaint(const std::string& text) {
  return complaint_of([&] { experiment_with(text); });
}

TEST(ExperimentNetwork, WithoutItTheDelayIsAllThereIs) {
  const Experiment experiment = experiment_with("delay_ms = 25");
  EXPECT_FALSE(experiment.network_is_modelled);
  EXPECT_EQ(experiment.network.to_listener, (rti::LinkConditions{.latency_ns = 25'000'000}));
  EXPECT_EQ(experiment.network.from_listener, experiment.network.to_listener);
}

TEST(ExperimentNetwork, EveryKeyArrives) {
  const Experiment experiment = experiment_with(R"(
[network]
latency_ms = 30
jitter_ms = 2.5
loss = 0.1
burst = 4
reorder = 0.02
reorder_ms = 7
duplicate = 0.03
rate_bits_per_s = 1_000_000
queue_bytes = 20_000
seed = 9
channels = "datagrams"
[network.down]
latency_ms = 50
gilbert_elliott = {to_bad = 0.1, to_good = 0.5, loss_good = 0.01, loss_bad = 0.9}
[[network.links]]
first = 2
last = 3
latency_ms = 80
[[network.partition]]
from_s = 1
until_s = 2.5
first = 4
direction = "down"
)");
  const rti::LinkConditions up{.latency_ns = 30'000'000,
                               .jitter_ns = 2'500'000,
                               .loss = rti::PacketLoss::in_bursts(0.1, 4.0),
                               .reorder = 0.02,
                               .held_ns = 7'000'000,
                               .duplicate = 0.03,
                               .rate_bits_per_s = 1'000'000,
                               .queue_bytes = 20'000};
  rti::LinkConditions down = up;
  down.latency_ns = 50'000'000;
  down.loss = {.to_bad = 0.1, .to_good = 0.5, .loss_good = 0.01, .loss_bad = 0.9};
  EXPECT_EQ(experiment.network.to_listener, up);
  EXPECT_EQ(experiment.network.from_listener, down);
  rti::LinkConditions worse_up = up, worse_down = down;
  worse_up.latency_ns = worse_down.latency_ns = 80'000'000;
  EXPECT_EQ(experiment.network.of(3, rti::LinkDirection::to_listener), worse_up);
  EXPECT_EQ(experiment.network.of(3, rti::LinkDirection::from_listener), worse_down)
      << "all but the latency is as for every other link";
  EXPECT_EQ(experiment.network.of(4, rti::LinkDirection::to_listener), up);
  EXPECT_EQ(experiment.network.seed, 9u);
  EXPECT_TRUE(experiment.network_carries_datagrams);
  EXPECT_EQ(experiment.delay_ms, 50.0);
  ASSERT_EQ(experiment.network.partitions.size(), 1u);
  const rti::Partition& cut = experiment.network.partitions.front();
  EXPECT_EQ(cut.from_ns, 1'000'000'000);
  EXPECT_EQ(cut.until_ns, 2'500'000'000);
  EXPECT_EQ(cut.first, 4u);
  EXPECT_EQ(cut.last, UINT32_MAX);
  EXPECT_EQ(cut.direction, rti::LinkDirection::from_listener);
}

TEST(ExperimentNetwork, WhatMakesNoNetworkIsRefusedWithLineAndKey) {
  EXPECT_THAT(network_complaint("[network]\nlatency_ms = -1"),
              AllOf(StartsWith("x.toml:5: network.latency_ms = -1"), HasSubstr("0 to 10000")));
  EXPECT_THAT(network_complaint("[network]\nloss = 1"),
              HasSubstr("network.loss = 1: allowed is a number from 0 to 0.99"));
  EXPECT_THAT(network_complaint("[network]\nloss = 0.9\nburst = 2"),
              HasSubstr("at least loss / (1 - loss)"));
  EXPECT_THAT(network_complaint("[network]\nloss = 0.1\n[network.gilbert_elliott]\nto_bad = 0.1"),
              AllOf(HasSubstr("network.gilbert_elliott: loss and burst"), StartsWith("x.toml:6")));
  EXPECT_THAT(network_complaint("[network.up]\nqueue_bytes = 10"),
              HasSubstr("network.up.queue_bytes = 10: allowed is a whole number from 1500"));
  EXPECT_THAT(network_complaint("[network]\nlosses = 0.1"),
              AllOf(HasSubstr("unknown key network.losses"), HasSubstr("jitter_ms")));
  EXPECT_THAT(network_complaint("[[network.partition]]\nfrom_s = 3\nuntil_s = 2"),
              HasSubstr("network.partition.until_s = 2"));
  EXPECT_THAT(network_complaint("[[network.partition]]\nfrom_s = 3"),
              HasSubstr("until_s is missing"));
  EXPECT_THAT(network_complaint("[[network.links]]\nfirst = 3\nlast = 2"),
              HasSubstr("network.links.last = 2"));
  EXPECT_THAT(network_complaint("[network]\npartition = 3"), HasSubstr("a list of tables"));
  EXPECT_THAT(network_complaint("network = 3"), HasSubstr("network = 3: allowed is a table"));
  try {
    parse_experiment("name = 'x'\nscene = 'crowd'\n[network]\nloss = 0.1", "x.toml", {});
    FAIL();
  } catch (const ExperimentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("only transport = \"virtual\""));
  }
}

class BadNetworkRun : public testing::Test {
 protected:
  /// The records of the clients and the server over the network that `text` says.
  nlohmann::json run(const std::string& text) {
    const Experiment experiment = experiment_with(
        "population = 'per_client'\nclients = 6\nschemes = 'region'\ntick_rate_hz = 20\n" + text);
    const Cell cell = cells_of(experiment).front();
    RunnerSettings settings;
    settings.directory = folder_;
    const std::filesystem::path keys = std::filesystem::path(folder_) / "log.keys";
    write_game_plan(experiment, cell, keys);
    record_ = run_virtual_cell(settings, experiment, cell, keys).value();
    return nlohmann::json::parse(test::text_of(std::filesystem::path(folder_) /
                                               (name_of(cell) + ".server.json")))["network"];
  }
  test::TemporaryFolder folder_{"network"};
  RunRecord record_;
};

TEST_F(BadNetworkRun, LossIsCountedAndTheSameGameIsPlayed) {
  run("delay_ms = 20");
  const std::string hash = record_.state_hash;
  const nlohmann::json counted =
      run("[network]\nlatency_ms = 20\njitter_ms = 3\nloss = 0.05\nburst = 2");
  EXPECT_EQ(record_.why_invalid, "");
  EXPECT_EQ(record_.state_hash, hash);
  EXPECT_GT(counted["lost"].get<int>(), 5);
  EXPECT_EQ(counted["lost"], counted["retransmitted"]);
  EXPECT_EQ(counted, run("[network]\nlatency_ms = 20\njitter_ms = 3\nloss = 0.05\nburst = 2"));
}

TEST_F(BadNetworkRun, ACutOfASecondHealsAndOneOfTenLosesTheClients) {
  const nlohmann::json counted = run("[[network.partition]]\nfrom_s = 1\nuntil_s = 2");
  EXPECT_EQ(record_.why_invalid, "");
  EXPECT_GT(counted["cut"].get<int>(), 0);
  run("duration_s = 9\n[[network.partition]]\nfrom_s = 1\nuntil_s = 11\nlast = 0");
  EXPECT_THAT(record_.why_invalid, HasSubstr("1 clients lost by the server"));
}

}  // namespace
}  // namespace rink::loadgen
