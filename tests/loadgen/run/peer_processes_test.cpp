// Peers as processes over sockets: the game that peers under a virtual clock play, measured
// likewise, and named if they fail.
#include "loadgen/run/peers/peer_processes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "loadgen/run/game_plan.h"
#include "loadgen/run/peers/peer_run.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

class PeerProcessesTest : public testing::Test {
 protected:
  PeerProcessesTest() {
    settings_.directory = folder_;
    settings_.peer = test::binary_folder() + "/bin/rink-peer";
    experiment_.name = "small";
    experiment_.scene = "arena";
    experiment_.population = Population::per_client;
    experiment_.modes = {peer_mode};
    experiment_.schemes = {"region"};
    experiment_.policies = {"on-event"};
    experiment_.clients = {3};
    experiment_.seeds = {3};
    experiment_.view_area = 4.0;
    experiment_.tick_rates_hz = {30.0};
    experiment_.warm_up_s = 0.5;
    experiment_.duration_s = 1.5;
    write_game_plan(experiment_, cell(), log());
  }
  Cell cell() const { return cells_of(experiment_).front(); }
  std::filesystem::path log() const { return folder_ / "log.keys"; }

  test::TemporaryFolder folder_{"peer-processes"};
  RunnerSettings settings_;
  Experiment experiment_;
};

TEST_F(PeerProcessesTest, PlayTheGameOfThoseUnderAVirtualClockAndSayWhatItCost) {
  const auto record = run_peer_processes(settings_, experiment_, cell(), log());
  experiment_.transport = TransportKind::virtual_time;
  const auto virtual_record = run_virtual_peers(settings_, experiment_, cell(), log());
  ASSERT_TRUE(record && virtual_record);
  // On a machine that is busy with something else keys may be late, and then the run does not
  // count; all else holds.
  EXPECT_THAT(record->why_invalid, AnyOf("", HasSubstr("could not keep their schedule")));
  EXPECT_EQ(record->state_hash, virtual_record->state_hash);
  EXPECT_EQ(record->truth.error, "");
  EXPECT_EQ(record->keys_due, virtual_record->keys_due);
  EXPECT_EQ(record->keys_sent, record->keys_due);
  EXPECT_GT(*record->truth.filter_recall, 0.8);
  EXPECT_GT(*record->nodes.busiest_cpu_s, 0.0);
  EXPECT_GE(*record->nodes.busiest_cpu_s, *record->nodes.mean_cpu_s);
  std::uint64_t largest = 0;
  for (int process = 0; process < 3; ++process) {
    const auto report = nlohmann::json::parse(
        test::text_of(folder_ / (name_of(cell()) + ".peer" + std::to_string(process) + ".json")));
    largest = std::max(largest, report["rss_bytes"].get<std::uint64_t>());
  }
  EXPECT_EQ(record->server_rss_bytes, largest);
  EXPECT_NEAR(*record->traffic.halo + *record->traffic.claims + *record->traffic.agreement +
                  *record->traffic.interest + *record->traffic.updates + *record->traffic.keys,
              *record->up_bytes_per_client_per_s, 1e-3 * *record->up_bytes_per_client_per_s);
  // The same messages, but for a byte less in each frame, and for windows that one of them noted a
  // moment later.
  EXPECT_NEAR(*record->traffic.agreement, *virtual_record->traffic.agreement,
              0.1 * *virtual_record->traffic.agreement);
}

TEST_F(PeerProcessesTest, NameWhoIsKilled) {
  const std::filesystem::path script = folder_ / "peer.sh";
  std::ofstream(script) << "#!/bin/sh\ncase \"$*\" in *--join*) mkdir "
                        << (folder_ / "once").string()
                        << " 2>/dev/null && (sleep 1; kill -9 $$) & ;; esac\nexec "
                        << settings_.peer.string() << " \"$@\"\n";
  std::filesystem::permissions(script, std::filesystem::perms::owner_all);
  settings_.peer = script;
  const auto record = run_peer_processes(settings_, experiment_, cell(), log());
  ASSERT_TRUE(record);
  EXPECT_FALSE(record->valid);
  EXPECT_THAT(
      record->why_invalid,
      testing::MatchesRegex("peer process [12] was ended by signal 9 .*; 2 others ended after it"));
}

TEST_F(PeerProcessesTest, NameAFirstOneThatDoesNotListenAndEndWhenTheUserWantsTo) {
  settings_.peer = "/bin/false";
  const auto record = run_peer_processes(settings_, experiment_, cell(), log());
  ASSERT_TRUE(record);
  EXPECT_EQ(record->why_invalid, "the first peer ended with status 1 before it listened");
  const std::atomic<bool> is_interrupted = true;
  settings_.is_interrupted = &is_interrupted;
  EXPECT_FALSE(run_peer_processes(settings_, experiment_, cell(), log()));
}

}  // namespace
}  // namespace rink::loadgen
