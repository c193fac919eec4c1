// Peers under a virtual clock: the game that a server plays, latencies by closed forms, every byte
// accounted for, and the same bytes every time.
#include "loadgen/run/peers/peer_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "game/net/peer/traffic.h"
#include "loadgen/experiment/experiment_file.h"
#include "loadgen/measure/tables/modes_table.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/virtual_run.h"
#include "tests/loadgen/complaint.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;

class PeerRunTest : public testing::Test {
 protected:
  PeerRunTest() {
    settings_.directory = folder_;
    experiment_.name = "small";
    experiment_.scene = "arena";
    experiment_.transport = TransportKind::virtual_time;
    experiment_.population = Population::per_client;
    experiment_.modes = {"client-server", peer_mode};
    experiment_.schemes = {"none", "grid", "region"};
    experiment_.policies = {"on-event"};
    experiment_.clients = {9};
    experiment_.seeds = {3};
    experiment_.view_area = 4.0;
    experiment_.view_margins = {0.0};
    experiment_.tick_rates_hz = {20.0};
    experiment_.warm_up_s = 0.5;
    experiment_.duration_s = 2.0;
  }

  RunRecord run(const Cell& cell) const {
    const std::filesystem::path log = folder_ / "log.keys";
    write_game_plan(experiment_, cell, log);
    const auto record = (cell.mode == peer_mode ? run_virtual_peers : run_virtual_cell)(
        settings_, experiment_, cell, log);
    EXPECT_TRUE(record);
    EXPECT_EQ(record.value_or(RunRecord{}).why_invalid, "") << name_of(cell);
    EXPECT_EQ(record.value_or(RunRecord{}).truth.error, "") << name_of(cell);
    return record.value_or(RunRecord{});
  }
  nlohmann::json peers_report(const Cell& cell) const {
    return nlohmann::json::parse(test::text_of(folder_ / (name_of(cell) + ".peers.json")));
  }

  test::TemporaryFolder folder_{"peer-run"};
  RunnerSettings settings_;
  Experiment experiment_;
};

TEST_F(PeerRunTest, EndsInTheServersStateUnderEverySchemeAndPolicy) {
  experiment_.policies = {"on-event", "periodic"};
  experiment_.schemes = {"none", "grid", "region", "aura"};
  std::set<std::string> hashes;
  for (const Cell& cell : cells_of(experiment_)) hashes.insert(run(cell).state_hash);
  EXPECT_EQ(hashes.size(), 1u);
}

/// Claims, verdicts and arrivals each take a delay, and updates come with the arrivals.
TEST_F(PeerRunTest, AWindowIsThreeDelaysOldWhenItIsKnown) {
  for (const double delay_ms : {1.0, 10.0, 15.0}) {
    experiment_.delay_ms = delay_ms;
    const RunRecord record = run(cells_of(experiment_).back());
    ASSERT_TRUE(record.update_age_ms.p50);
    EXPECT_NEAR(*record.update_age_ms.p50, 3.0 * delay_ms, 1e-3 * 3.0 * delay_ms);
    EXPECT_NEAR(*record.update_age_ms.max, 3.0 * delay_ms, 1e-3 * 3.0 * delay_ms);
    EXPECT_EQ(record.ticks_on_time_fraction, 1.0);
    // Half a window on average until it ends, and two delays until all have agreed, for a bat that
    // is the peer's own.
    EXPECT_GE(*record.key_to_effect_ms.p50, 2.0 * delay_ms);
    EXPECT_LE(*record.key_to_effect_ms.p50, 50.0 + 4.0 * delay_ms);
  }
}

TEST_F(PeerRunTest, WhenAgreementTakesLongerThanAWindowItFallsBehindAndPlaysTheSameGame) {
  const Cell cell = cells_of(experiment_).back();
  const std::string hash = run(cell).state_hash;
  experiment_.delay_ms = 25.0;
  const RunRecord record = run(cell);
  EXPECT_EQ(record.state_hash, hash);
  // Window k ends at 50 k ms, and is known 75 ms after the one before it is; the last that counts
  // is the 49th.
  EXPECT_NEAR(*record.update_age_ms.max, 50.0 + 25.0 * 49, 1.0);
  EXPECT_EQ(record.ticks_on_time_fraction, 0.0);
}

/// Each segment that is lost holds everybody up.
TEST_F(PeerRunTest, OverALossyNetworkItIsLateAndTheSameGame) {
  const Cell cell = cells_of(experiment_).back();
  const std::string hash = run(cell).state_hash;
  experiment_.network_is_modelled = true;
  for (rti::LinkConditions* link :
       {&experiment_.network.to_listener, &experiment_.network.from_listener})
    link->latency_ns = 5'000'000, link->loss = rti::PacketLoss::independent(0.002);
  const RunRecord record = run(cell);
  EXPECT_EQ(record.state_hash, hash);
  EXPECT_LT(*record.ticks_on_time_fraction, 0.9);
}

TEST_F(PeerRunTest, EveryByteIsAboutSomethingAndOnlyWhoFiltersSaysWhereItLooks) {
  std::map<std::string, nlohmann::json> by_scheme;
  for (const Cell& cell : cells_of(experiment_)) {
    if (cell.mode != peer_mode) continue;
    const RunRecord record = run(cell);
    const nlohmann::json report = peers_report(cell);
    std::uint64_t sum = 0;
    for (const char* subject : game::traffic_names)
      sum += report[std::string(subject) + "_bytes"].get<std::uint64_t>();
    EXPECT_EQ(sum, report["bytes_sent"]);
    EXPECT_NEAR(*record.traffic.halo + *record.traffic.claims + *record.traffic.agreement +
                    *record.traffic.interest + *record.traffic.updates + *record.traffic.keys +
                    *record.traffic.standby,
                *record.up_bytes_per_client_per_s, 1e-6 * *record.up_bytes_per_client_per_s);
    by_scheme[cell.scheme] = report;
  }
  EXPECT_EQ(by_scheme["none"]["interest_bytes"], 0);
  EXPECT_GT(by_scheme["grid"]["interest_bytes"], 0);
  // Where nobody crosses a cell's border, nobody says anything.
  EXPECT_LT(by_scheme["grid"]["interest_bytes"], by_scheme["region"]["interest_bytes"]);
  EXPECT_LT(by_scheme["region"]["updates_bytes"], by_scheme["none"]["updates_bytes"]);
  // What proves the windows does not depend on who looks where.
  for (const char* bytes :
       {"halo_bytes", "claims_bytes", "agreement_bytes", "keys_bytes", "standby_bytes"})
    EXPECT_EQ(by_scheme["none"][bytes], by_scheme["region"][bytes]);
}

/// Judged by the same truth as a server and its bots.
TEST_F(PeerRunTest, TellsPlayersWhatConcernsThem) {
  for (const Cell& cell : cells_of(experiment_)) {
    if (cell.mode != peer_mode) continue;
    const RunRecord record = run(cell);
    EXPECT_GT(*record.truth.filter_recall, cell.scheme == "none" ? 0.999 : 0.9) << cell.scheme;
    EXPECT_GT(*record.truth.delivered_recall, cell.scheme == "none" ? 0.99 : 0.9) << cell.scheme;
    EXPECT_GT(*record.truth.filter_precision, cell.scheme == "region" ? 0.9 : 0.0);
    EXPECT_LT(*record.truth.position_error_mm.p99, 1.0) << cell.scheme;
    EXPECT_EQ(record.keys_due, record.keys_sent);
  }
}

TEST_F(PeerRunTest, GivesTheSameBytesAgain) {
  const Cell cell = cells_of(experiment_).back();
  std::vector<std::string> texts;
  for (int time = 0; time < 2; ++time) {
    run(cell);
    std::string text;
    for (const char* ending : {".peers.json", ".bots.json", ".server.jsonl", ".bots.jsonl"})
      text += test::text_of(folder_ / (name_of(cell) + ending));
    EXPECT_GT(text.size(), 10'000u);
    texts.push_back(text);
  }
  EXPECT_EQ(texts[0], texts[1]);
}

/// Of two nodes each sends what the other receives, so both carry all that goes between them; of
/// more the busiest carries at least its share, which is twice that of one direction.
TEST_F(PeerRunTest, TheBusiestNodeCarriesWhatItSendsAndReceives) {
  for (const std::uint32_t peers : {2u, 9u}) {
    experiment_.clients = {peers};
    const RunRecord record = run(cells_of(experiment_).back());
    const double all = peers * *record.up_bytes_per_client_per_s;
    EXPECT_EQ(record.up_bytes_per_client_per_s, record.down_bytes_per_client_per_s);
    if (peers == 2) EXPECT_NEAR(*record.nodes.busiest_bytes_per_s, all, 1e-9 * all);
    else EXPECT_GT(*record.nodes.busiest_bytes_per_s, 2.0 * all / peers);
    EXPECT_LE(*record.nodes.busiest_bytes_per_s, all);
    EXPECT_GT(*record.nodes.busiest_link_bytes_per_s, *record.nodes.busiest_bytes_per_s);
    EXPECT_GE(*record.nodes.busiest_link_bytes_per_s,
              *record.wire_bytes_per_client_per_s * (1.0 - 1e-9))
        << "the mean link";
    if (peers == 2) {
      EXPECT_NEAR(*record.nodes.busiest_link_bytes_per_s, *record.wire_bytes_per_client_per_s,
                  1e-9 * all)
          << "both have the same link";
    }
    EXPECT_FALSE(record.nodes.busiest_cpu_s || record.nodes.mean_cpu_s) << "under a virtual clock";
    EXPECT_EQ(record.ticks, 40u);
  }
}

TEST_F(PeerRunTest, OnePeerPlaysAloneAndSaysNothing) {
  experiment_.clients = {1};
  const RunRecord record = run(cells_of(experiment_).back());
  EXPECT_EQ(record.down_bytes_per_client_per_s, 0.0);
}

TEST_F(PeerRunTest, ModesStandSideBySideOnlyWhereThereAreSeveral) {
  std::vector<RunRecord> runs;
  experiment_.schemes = {"region"};
  for (const Cell& cell : cells_of(experiment_)) runs.push_back(run(cell));
  const std::string table = modes_table(runs);
  EXPECT_THAT(table, testing::AllOf(HasSubstr("client-server"), HasSubstr("peer-to-peer"),
                                    HasSubstr("claims")));
  EXPECT_THAT(table,
              testing::Not(testing::AnyOf(HasSubstr("+- n="), HasSubstr("busiest link carr"))))
      << "one replication has no interval";
  std::vector<RunRecord> replicated = runs;
  replicated.insert(replicated.end(), runs.begin(), runs.end());
  replicated[2].cell.seed = replicated[3].cell.seed = 4;
  *replicated[2].up_bytes_per_client_per_s += 2000.0;
  const double half_kB = 12.7062 * 1.0;  // t(0.975, 1) s / sqrt(2), s = 2 kB / sqrt(2)
  char shown[16];
  std::snprintf(shown, sizeof shown, "%.1f", half_kB);
  EXPECT_THAT(modes_table(replicated),
              testing::AllOf(HasSubstr("+- n=2"), HasSubstr(std::string("   ") + shown)));
  EXPECT_EQ(replicated[1].cell.mode, peer_mode);
  replicated[1].nodes.busiest_link_bytes_per_s = replicated[3].nodes.busiest_link_bytes_per_s = 1.0;
  EXPECT_THAT(modes_table(replicated),
              HasSubstr("the busiest link carries less in mode peer-to-peer with clients: " +
                        std::to_string(replicated[1].cell.clients) + " under region\n"));
  replicated[0].nodes.busiest_link_bytes_per_s = 0.0;
  replicated[2].nodes.busiest_link_bytes_per_s = 2.0;
  EXPECT_THAT(modes_table(replicated),
              HasSubstr("the modes' intervals for the busiest link overlap"));
  runs.pop_back();
  EXPECT_EQ(modes_table(runs), "");
}

std::string peer_complaint(const std::string& more) {
  return complaint_of([&] {
    parse_experiment(
        "name = \"x\"\nscene = \"arena\"\nmodes = [\"client-server\", \"peer-to-peer\"]\n" + more,
        "x.toml", {});
  });
}

TEST(PeerExperiment, RefusesWhatPeersDoNotDo) {
  EXPECT_EQ(peer_complaint("transport = \"virtual\"\n"), "no complaint");
  EXPECT_EQ(peer_complaint("clients = [2, 64]\n"), "no complaint");
  EXPECT_THAT(
      peer_complaint("clients = 65\n"),
      HasSubstr(
          "x.toml: modes = peer-to-peer over sockets is of 2 to 64 processes, not clients = 65"));
  EXPECT_THAT(peer_complaint("transport = \"udp\"\n"),
              HasSubstr("needs transport = \"tcp\", \"shm\" or \"virtual\", not \"udp\""));
  EXPECT_THAT(peer_complaint("transport = \"virtual\"\nkeys = \"live\"\n"),
              HasSubstr("needs keys = \"replay\""));
  EXPECT_THAT(peer_complaint("transport = \"virtual\"\npolicies = [\"snapshot\"]\n"),
              HasSubstr("not snapshot"));
  EXPECT_THAT(peer_complaint("transport = \"virtual\"\nsweep_ticks = [0, 1]\n"),
              HasSubstr("expected sweep_ticks = 0"));
}

TEST_F(PeerRunTest, RefusesARuleOfPossessionBeforeAnythingRuns) {
  std::ofstream(folder_ / "owned.toml")
      << test::text_of(test::source_folder() + "/scenes/arena.toml")
      << "\n[match]\npossession_s = 7.0\n";
  experiment_.scene = (folder_ / "owned.toml").string();
  try {
    write_game_plan(experiment_, cells_of(experiment_).front(), folder_ / "log.keys");
    FAIL() << "expected an ExperimentError";
  } catch (const ExperimentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("possession_s"));
  }
}

TEST_F(PeerRunTest, RefusesAFieldWithGoalsBeforeAnythingRuns) {
  experiment_.scene = "crowd";
  try {
    write_game_plan(experiment_, cells_of(experiment_).front(), folder_ / "log.keys");
    FAIL() << "expected an ExperimentError";
  } catch (const ExperimentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("scene crowd has goals"));
  }
}

}  // namespace
}  // namespace rink::loadgen
