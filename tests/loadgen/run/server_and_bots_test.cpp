// The two commands by hand with the flags that experiments do not set, and what a cell of an
// experiment hands to them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "game/process/process.h"
#include "loadgen/run/cell_runner.h"
#include "loadgen/run/game_plan.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using namespace std::chrono_literals;

class ServerAndBots : public testing::Test {
 protected:
  struct Played {
    int server = -1, bots = -1;  ///< exit status
    nlohmann::json server_report, bots_report;
  };

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string key(const std::string& name, char filling) const {
    std::ofstream(folder_ / name, std::ios::binary) << std::string(32, filling);
    std::filesystem::permissions(
        folder_ / name, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    return file(name);
  }

  /// Twelve bats and 120 pucks for 0.7 s at 20 Hz.
  Played play(const std::vector<std::string>& for_server,
              const std::vector<std::string>& for_bots) const {
    Played played;
    std::vector<std::string> flags{"--scene",      "crowd", "--bat-count", "12",
                                   "--puck-count", "120",   "--clients",   "12",
                                   "--rate",       "20",    "--duration",  "0.7",
                                   "--warm-up",    "0.1",   "--patience",  "2",
                                   "--port",       "0",     "--report",    file("server.json")};
    flags.insert(flags.end(), for_server.begin(), for_server.end());
    game::Process server(test::binary_folder() + "/bin/rink-serve", flags, {});
    std::optional<std::string> place;
    for (int i = 0; i < 1000 && !place; ++i)
      server.attend(10ms), place = server.line_after("listening on ");
    EXPECT_TRUE(place) << server.stderr_tail();
    if (!place) return played;
    flags = {
        "--connect", *place, "--count",    "12", "--seed", "7", "--duration", "0.7",
        "--warm-up", "0.1",  "--patience", "2",  "--view", "1", "--report",   file("bots.json")};
    flags.insert(flags.end(), for_bots.begin(), for_bots.end());
    game::Process bots(test::binary_folder() + "/bin/rink-bots", flags, {});
    const auto limit = std::chrono::steady_clock::now() + 20s;
    while ((!server.ending() || !bots.ending()) && std::chrono::steady_clock::now() < limit)
      server.attend(5ms), bots.attend(5ms);
    if (!server.ending() || !bots.ending()) return played;
    played.server = server.ending()->exit_status, played.bots = bots.ending()->exit_status;
    played.server_report =
        nlohmann::json::parse(std::ifstream(file("server.json")), nullptr, false);
    played.bots_report = nlohmann::json::parse(std::ifstream(file("bots.json")), nullptr, false);
    return played;
  }

  test::TemporaryFolder folder_{"server-and-bots"};
};

TEST_F(ServerAndBots, PlayWithTheSameKeyFileAndNotWithAnother) {
  const std::string ours = key("ours.key", 'a'), theirs = key("theirs.key", 'b');
  const Played same = play({"--key-file", ours}, {"--key-file", ours});
  EXPECT_EQ(same.server, 0);
  EXPECT_EQ(same.bots, 0);
  EXPECT_EQ(same.server_report["ticks"], 12);
  const Played another = play({"--key-file", ours}, {"--key-file", theirs});
  EXPECT_NE(another.server, 0);
  EXPECT_NE(another.bots, 0);
}

/// All bytes of twelve bots leave by three sockets, in fewer segments, and both ends count the
/// same.
TEST_F(ServerAndBots, ShareSocketsAndCountWhatTheseCarry) {
  const Played apart = play({}, {}), shared = play({"--transport", "bundle"}, {"--bundle", "3"});
  ASSERT_EQ(apart.server, 0);
  ASSERT_EQ(shared.server, 0);
  ASSERT_EQ(shared.bots, 0);
  EXPECT_EQ(shared.server_report["lost_federates"], 0);
  EXPECT_EQ(shared.bots_report["clients"], 12);
  for (const char* kind : {"total_bytes", "kernel_bytes"}) {
    const auto of = [&](const nlohmann::json& report, const char* way) {
      return report[std::string(kind) + way].get<double>();
    };
    EXPECT_NEAR(of(shared.server_report, "_sent"), of(shared.bots_report, "_received"), 2000.0);
    EXPECT_NEAR(of(shared.server_report, "_received"), of(shared.bots_report, "_sent"), 2000.0);
  }
  EXPECT_LT(shared.server_report["kernel_segments_sent"].get<double>(),
            0.6 * apart.server_report["kernel_segments_sent"].get<double>());
}

TEST_F(ServerAndBots, BotsThatShareSocketsOfAnotherTransportAreRefused) {
  game::Process bots(test::binary_folder() + "/bin/rink-bots",
                     {"--bundle", "2", "--transport", "udp"}, {});
  while (!bots.ending()) bots.attend(5ms);
  EXPECT_NE(bots.ending()->exit_status, 0);
  EXPECT_NE(bots.stderr_tail().find(
                "--bundle: bots share sockets with --transport bundle alone, not udp"),
            std::string::npos)
      << bots.stderr_tail();
}

/// Spread over half a tick of 50 ms, the writes of one instant are those of one of 16 phases, and
/// on average they leave a quarter of a tick later.
TEST_F(ServerAndBots, ASpreadTickLeavesInSmallBurstsAndArrivesLater) {
  const Played at_once = play({"--scheme", "none"}, {}),
               spread = play({"--scheme", "none", "--spread", "0.5"}, {});
  ASSERT_EQ(at_once.server, 0);
  ASSERT_EQ(spread.server, 0);
  EXPECT_EQ(at_once.server_report["spread"], 0.0);
  EXPECT_EQ(spread.server_report["spread"], 0.5);
  const auto mean_s = [](const Played& played) {
    return played.bots_report["update_age_ms"]["sum_s"].get<double>() /
           played.bots_report["update_age_ms"]["count"].get<double>();
  };
  const double phases = 11.0,
               mean_phase_s =
                   0.5 * phases / 16.0 * 0.025;  // twelve connections have the phases 0 to 11 of 16
  EXPECT_GT(mean_s(spread) - mean_s(at_once), 0.5 * mean_phase_s);
  EXPECT_LT(2 * spread.server_report["burst_bytes_max"].get<std::uint64_t>(),
            at_once.server_report["burst_bytes_max"].get<std::uint64_t>());
  EXPECT_EQ(spread.bots_report["update_age_ms"]["count"], 12 * 12);
}

/// What an experiment calls `view_margin` and `sweep_ticks` reaches the processes, for the wider
/// regions let more through, and the game stays what it was.
TEST_F(ServerAndBots, MarginAndSweepOfACellReachItsProcesses) {
  Experiment experiment;
  experiment.name = "margins", experiment.scene = "crowd";
  experiment.schemes = {"region"}, experiment.policies = {"periodic"}, experiment.clients = {6};
  experiment.tick_rates_hz = {20.0}, experiment.population = Population::per_client;
  experiment.warm_up_s = 0.1, experiment.duration_s = 0.4;
  RunnerSettings settings;
  settings.directory = folder_;
  settings.serve = test::binary_folder() + "/bin/rink-serve";
  settings.bots = test::binary_folder() + "/bin/rink-bots";
  settings.wants_truth = false;
  const auto run = [&](double view_margin, std::uint32_t sweep_ticks) {
    Cell cell = cells_of(experiment).front();
    cell.parameters.view_margin = view_margin, cell.parameters.sweep_ticks = sweep_ticks;
    write_game_plan(experiment, cell, folder_ / "some.keys");
    const auto record = run_cell(settings, experiment, cell, folder_ / "some.keys");
    EXPECT_TRUE(record && record->state_hash != "");
    return record.value_or(RunRecord{});
  };
  const RunRecord plain = run(0.0, 0), wide = run(0.5, 0), swept = run(0.0, 8);
  EXPECT_GT(*wide.messages_per_s, 1.1 * *plain.messages_per_s);
  EXPECT_GT(*swept.messages_per_s, 1.1 * *plain.messages_per_s);
  EXPECT_EQ(wide.state_hash, plain.state_hash);
  EXPECT_EQ(swept.state_hash, plain.state_hash);
}

}  // namespace
}  // namespace rink::loadgen
