// Runs under a virtual clock: closed forms of their latencies, the same game as elsewhere, the same
// bytes every time.
#include "loadgen/run/virtual_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/control/key_log_file.h"
#include "loadgen/measure/summary.h"
#include "loadgen/run/campaign.h"
#include "loadgen/run/game_plan.h"
#include "tests/loadgen/run/virtual_experiment.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

TEST_F(VirtualRunTest, EveryUpdateIsExactlyAsOldAsTheDelay) {
  for (const double delay_ms : {0.0, 10.0, 137.25}) {
    experiment_.delay_ms = delay_ms;
    const Cell cell = first_cell();
    const RunRecord record = run(cell);
    const nlohmann::json ages = report(cell, "bots")["update_age_ms"];
    EXPECT_NEAR(ages["min_s"].get<double>(), 1e-3 * delay_ms, 1e-12);
    EXPECT_NEAR(ages["max_s"].get<double>(), 1e-3 * delay_ms, 1e-12);
    EXPECT_EQ(ages["count"], 6 * 40) << "one per client and measured tick";
    EXPECT_EQ(record.ticks, 40u)
        << "n ticks and the n periods that they begin: the one at the end is not among them";
  }
}

TEST_F(VirtualRunTest, AKeyTakesEffectAfterTwoDelaysAndTheWaitForTheTickBetween) {
  experiment_.delay_ms = 30.0;
  const Cell cell = first_cell();
  const double delay_s = 1e-3 * experiment_.delay_ms, rate_hz = cell.parameters.tick_rate_hz,
               last_s = experiment_.warm_up_s + experiment_.duration_s;
  run(cell);
  double sum_s = 0.0, least_s = 1e9, greatest_s = 0.0;
  std::uint64_t answered = 0, due = 0;
  for (const game::InputEvent& key : game::read_key_log(folder_ / "log.keys").events) {
    if (key.time < experiment_.warm_up_s || key.time >= last_s) continue;
    ++due;
    const double tick_s = std::ceil((key.time + delay_s) * rate_hz) / rate_hz;
    if (tick_s > last_s) continue;
    const double effect_s = tick_s + delay_s - key.time;
    sum_s += effect_s;
    least_s = std::min(least_s, effect_s);
    greatest_s = std::max(greatest_s, effect_s);
    ++answered;
  }
  ASSERT_GT(answered, 20u);
  const nlohmann::json bots = report(cell, "bots");
  EXPECT_EQ(bots["keys_due"], due);
  EXPECT_EQ(bots["key_to_effect_ms"]["count"], answered);
  EXPECT_NEAR(bots["key_to_effect_ms"]["sum_s"].get<double>(), sum_s,
              2e-9 * static_cast<double>(answered))
      << "the clock counts whole nanoseconds";
  EXPECT_NEAR(bots["key_to_effect_ms"]["min_s"].get<double>(), least_s, 2e-9);
  EXPECT_NEAR(bots["key_to_effect_ms"]["max_s"].get<double>(), greatest_s, 2e-9);
  EXPECT_LE(bots["send_lateness_ms"]["max_s"].get<double>(), 1e-9);
}

TEST_F(VirtualRunTest, TheServerCountsTheDatagramsThatItSends) {
  experiment_.network_is_modelled = experiment_.network_carries_datagrams = true;
  const Cell cell = first_cell();
  run(cell);
  EXPECT_EQ(report(cell, "server")["total_bytes_sent"],
            report(cell, "bots")["total_bytes_received"]);
}

TEST_F(VirtualRunTest, PlaysTheVeryGameThatTheKeysPlayAlone) {
  const Cell cell = first_cell();
  game::Game game(scene_of(experiment_, cell));
  key_log(cell);
  for (const game::InputEvent& key : game::read_key_log(folder_ / "log.keys").events)
    game.submit(key);
  game.advance(experiment_.warm_up_s + experiment_.duration_s);
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(game.hash()));
  for (const Cell& each : cells_of(experiment_))
    EXPECT_EQ(run(each).state_hash, hash) << each.scheme;
}

TEST_F(VirtualRunTest, EndsInTheStateOfTheSameCellOverRealSockets) {
  experiment_.warm_up_s = 0.1;
  experiment_.duration_s = 0.4;
  const Cell cell = first_cell();
  const RunRecord virtual_record = run(cell);
  const nlohmann::json virtual_server = report(cell, "server"), virtual_bots = report(cell, "bots");
  experiment_.transport = TransportKind::tcp;
  const auto real_record = run_cell(settings_, experiment_, cell, folder_ / "log.keys");
  ASSERT_TRUE(real_record);
  ASSERT_NE(real_record->state_hash, "") << real_record->why_invalid;
  EXPECT_EQ(virtual_record.state_hash, real_record->state_hash);
  EXPECT_EQ(virtual_record.ticks, real_record->ticks);
  EXPECT_EQ(virtual_record.entities, real_record->entities);
  for (const auto& [who, mine] :
       std::map<const char*, nlohmann::json>{{"server", virtual_server}, {"bots", virtual_bots}}) {
    const nlohmann::json over_sockets = report(cell, who);
    // What their clocks, pace and memory say of themselves.
    const std::set<std::string> of_processes{"behind_s",
                                             "cpu_share",
                                             "evidence_bytes",
                                             "histogram_ns_per_record",
                                             "ticks_cut_short",
                                             "burst_bytes_max",
                                             "pace",
                                             "send_us_max",
                                             "spread",
                                             "time_managed",
                                             "ticks_left_out",
                                             "game_pace",
                                             "output_rate_changes",
                                             "output_rate_divisor_max"};
    for (const auto& [key, value] : over_sockets.items())
      EXPECT_TRUE(of_processes.contains(key) || mine.contains(key))
          << "the " << who << "' report over sockets has " << key;
  }
}

TEST_F(VirtualRunTest, ReportsHowEvenlyClientsWereUpdated) {
  const Cell cell = first_cell();
  run(cell);
  const nlohmann::json server = report(cell, "server");
  const double least = server.at("times_updated_min"), mean = server.at("times_updated_mean"),
               most = server.at("times_updated_max"), ticks = server.at("ticks");
  EXPECT_LE(least, mean);
  EXPECT_LE(mean, most);
  EXPECT_GT(most, 0.0);
  EXPECT_LE(most, ticks + 1.0);
}

TEST_F(VirtualRunTest, EndsAsInvalidWhereThePhysicsHasTooManyEvents) {
  settings_.virtual_events_per_s = 20;
  const Cell cell = first_cell();
  const auto record = run_virtual_cell(settings_, experiment_, cell, key_log(cell));
  ASSERT_TRUE(record);
  EXPECT_FALSE(record->valid);
  EXPECT_THAT(record->why_invalid,
              testing::StartsWith("the server: 21 events within a simulated second where 20 may "
                                  "be, at "));
}

TEST_F(VirtualRunTest, TheSameSeedGivesTheSameBytesWhereverItRuns) {
  std::map<std::string, std::string> first;
  for (const char* place : {"a", "a deeper/place"}) {
    ResultsDirectory results(folder_ / place, true);
    settings_.directory = results.subdirectory("cells");
    std::ostringstream said;
    Progress progress(said, false, 2, 1.0);
    const auto write_keys = [this](const Cell& cell, const std::filesystem::path& file) {
      write_game_plan(experiment_, cell, file);
    };
    const CampaignResult outcome =
        run_campaign({experiment_, settings_, results, write_keys}, progress);
    results.write("summary.csv", to_csv(summarise(outcome.runs)));
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(results.path()))
      if (entry.is_regular_file())
        files[std::filesystem::relative(entry.path(), results.path())] =
            test::text_of(entry.path());
    EXPECT_GE(files.size(), 7u)
        << "runs, summary, a key log, and two reports for each of two cells";
    if (first.empty()) first = files;
    for (const auto& [name, content] : first) EXPECT_EQ(files[name], content) << name;
    EXPECT_EQ(files.size(), first.size());
  }
}

TEST_F(VirtualRunTest, LiveKeysTakeEffectWhenTheyArrive) {
  experiment_.keys = KeySource::live;
  experiment_.delay_ms = 40.0;
  const Cell cell = first_cell();
  const RunRecord record = run(cell);
  game::Game game(scene_of(experiment_, cell));
  const double last_s = experiment_.warm_up_s + experiment_.duration_s;
  std::vector<game::InputEvent> keys = game::read_key_log(folder_ / "log.keys").events;
  std::uint64_t applied = 0;
  for (const game::InputEvent& key : keys) applied += key.time + 0.04 <= last_s ? 1u : 0u;
  const nlohmann::json server = report(cell, "server");
  EXPECT_EQ(server["keys_received"],
            keys.size() - static_cast<std::size_t>(std::ranges::count_if(
                              keys, [&](const auto& key) { return key.time >= last_s; })));
  EXPECT_EQ(server["keys_applied"], applied);
  EXPECT_EQ(run(cell).state_hash, record.state_hash);
}

TEST_F(VirtualRunTest, WhatNeedsAClockOrAKernelIsAbsentAndNoFault) {
  const RunRecord record = run(first_cell());
  EXPECT_TRUE(record.valid);
  EXPECT_FALSE(record.physics_us_per_tick || record.filter_us_per_tick || record.send_us_per_tick ||
               record.server_rss_bytes || record.server_cpu_s);
  EXPECT_GT(record.down_bytes_per_client_per_s.value_or(0.0), 0.0);
  EXPECT_GT(record.wire_bytes_per_client_per_s.value_or(0.0),
            record.down_bytes_per_client_per_s.value_or(0.0));
  const nlohmann::json server = report(first_cell(), "server");
  EXPECT_GT(server["physics_events"], 0);
  EXPECT_EQ(server["total_bytes_received"],
            report(first_cell(), "bots")["total_bytes_sent"].get<std::uint64_t>() + 6 * 3)
      << "the bots take their leave after their report";
}

/// In frames of their own a key is 13 bytes and a heartbeat 3 (docs/wire.md).
TEST_F(VirtualRunTest, UnderNoneClientsSendKeysAndHeartbeatsAlone) {
  settings_.wants_truth = true;
  experiment_.view_margins = {0.0};
  const Cell none = first_cell(), region = cells_of(experiment_).back();
  const RunRecord record = run(none);
  run(region);
  const nlohmann::json bots = report(none, "bots"), others = report(region, "bots");
  const double keys_bytes = 13.0 * bots["keys_sent"].get<double>(),
               heartbeats_max = 6.0 * experiment_.duration_s;
  EXPECT_GE(bots["bytes_sent"].get<double>(), keys_bytes);
  EXPECT_LE(bots["bytes_sent"].get<double>(), keys_bytes + 3.0 * heartbeats_max);
  EXPECT_GT(others["bytes_sent"].get<double>(), 10.0 * bots["bytes_sent"].get<double>())
      << "regions that follow the bats";
  EXPECT_EQ(record.truth.filter_recall, 1.0) << "and yet all is let through to them";
  EXPECT_EQ(record.truth.delivered_recall, 1.0);
}

TEST_F(VirtualRunTest, AnInterruptEndsItWithoutARecord) {
  const std::atomic<bool> is_interrupted = true;
  settings_.is_interrupted = &is_interrupted;
  EXPECT_FALSE(run_virtual_cell(settings_, experiment_, first_cell(), key_log(first_cell())));
}

}  // namespace
}  // namespace rink::loadgen
