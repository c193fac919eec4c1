// What figures per second are divided by: n ticks over the n periods that they begin, in whichever
// way a game is played.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "game/control/key_log_file.h"
#include "game/net/server_trace.h"
#include "game/process/process.h"
#include "loadgen/run/cell_runner.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/peers/peer_report.h"
#include "loadgen/run/peers/peer_run.h"
#include "loadgen/run/virtual_run.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

/// Players who press nothing, and a policy that says every body at every tick: so many updates, and
/// no more.
class SpanTest : public testing::Test {
 protected:
  SpanTest() {
    settings_.directory = folder_;
    settings_.wants_truth = false;
    settings_.serve = test::binary_folder() + "/bin/rink-serve";
    settings_.bots = test::binary_folder() + "/bin/rink-bots";
    settings_.peer = test::binary_folder() + "/bin/rink-peer";
    experiment_.name = "span";
    experiment_.scene = "crowd";
    experiment_.transport = TransportKind::virtual_time;
    experiment_.population = Population::per_client;
    experiment_.schemes = {"none"};
    experiment_.policies = {"periodic"};
    experiment_.clients = {4};
    experiment_.tick_rates_hz = {20.0};
    experiment_.warm_up_s = 0.25;
  }
  Cell cell() const { return cells_of(experiment_).front(); }
  std::filesystem::path no_keys() const {
    write_key_log(folder_ / "no.keys");
    return folder_ / "no.keys";
  }
  void write_key_log(const std::filesystem::path& file) const {
    write_game_plan(experiment_, cell(), file);
    game::KeyLog log = game::read_key_log(file);
    log.events.clear();
    game::write_key_log(file, log);
  }
  nlohmann::json report(const char* who) const {
    return nlohmann::json::parse(test::text_of(folder_ / (name_of(cell()) + "." + who + ".json")));
  }
  RunRecord sound(const std::optional<RunRecord>& record) const {
    EXPECT_TRUE(record);
    EXPECT_EQ(record.value_or(RunRecord{}).why_invalid, "");
    return record.value_or(RunRecord{});
  }

  test::TemporaryFolder folder_{"span"};
  RunnerSettings settings_;
  Experiment experiment_;
};

TEST_F(SpanTest, RatesOfASteadyStreamDoNotDependOnHowLongItIsWatched) {
  std::optional<double> down;
  for (const double duration_s : {0.5, 1.0, 4.0}) {
    experiment_.duration_s = duration_s;
    const RunRecord record = sound(run_virtual_cell(settings_, experiment_, cell(), no_keys()));
    const double rate_hz = record.cell.parameters.tick_rate_hz, clients = record.cell.clients;
    const game::Scene scene = scene_of(experiment_, cell());
    const auto bodies = static_cast<double>(scene.bodies.bats.size() + scene.bodies.pucks.size());
    EXPECT_EQ(static_cast<double>(*record.ticks), duration_s * rate_hz);
    EXPECT_NEAR(*record.measured_s, duration_s, 1e-9);
    EXPECT_NEAR(*record.messages_per_s, clients * bodies * rate_hz, 1e-6)
        << "each client is sent each body that moves at each tick";
    EXPECT_EQ(static_cast<double>(*record.update_age_samples),
              clients * static_cast<double>(*record.ticks));
    const auto states = report("server");
    EXPECT_EQ(states["state_bytes_sent"].get<std::uint64_t>() /
                  states["messages_sent"].get<std::uint64_t>(),
              9u)
        << "two f32 and the step from the handle before, in blocks of a few bytes more";
    if (!down) down = record.traffic.updates;
    EXPECT_NEAR(*record.traffic.updates / *down, 1.0, 5e-3)
        << "of some 403 bytes a frame, a stamp takes two, and ten more where the time doubles";
  }
}

/// A tick is one write to each client, however many bodies there are; a segment carries 1,448 bytes
/// of it.
TEST_F(SpanTest, ATickIsAWriteToEachClientAndAsManySegmentsAsItsBytesFill) {
  experiment_.duration_s = 1.0;
  for (const auto& [population, least] :
       {std::pair{Population::per_client, 1.0}, {Population::fixed, 7.0}}) {
    experiment_.population = population;
    const RunRecord record = sound(run_virtual_cell(settings_, experiment_, cell(), no_keys()));
    const nlohmann::json server = report("server"), bots = report("bots");
    const double writes_per_s = 4 * 20.0,
                 segments_per_write = std::ceil(server["bytes_sent"].get<double>() /
                                                server["writes_sent"].get<double>() / 1448.0);
    EXPECT_EQ(record.writes_per_s, writes_per_s);
    EXPECT_GE(segments_per_write, least);
    EXPECT_NEAR(*record.segments_per_s,
                writes_per_s * segments_per_write + bots["segments_sent"].get<double>(), 1e-9);
    EXPECT_LE(bots["segments_sent"], 4) << "a heartbeat a second";
  }
}

/// At 20 Hz 0.26 s falls between ticks 5 and 6 and 0.26 + 1.01 s after tick 25, which is the last,
/// ends the game and is not counted: 6 to 24, and 19 periods.
TEST_F(SpanTest, WhereWarmUpAndDurationAreNoMultiplesOfATickTheSpanBeginsAndEndsOnTicks) {
  experiment_.warm_up_s = 0.26, experiment_.duration_s = 1.01;
  const RunRecord record = sound(run_virtual_cell(settings_, experiment_, cell(), no_keys()));
  const game::Scene scene = scene_of(experiment_, cell());
  const auto bodies = static_cast<double>(scene.bodies.bats.size() + scene.bodies.pucks.size());
  EXPECT_EQ(record.ticks, 19u);
  EXPECT_NEAR(*record.measured_s, 19 / 20.0, 1e-9);
  EXPECT_NEAR(*record.messages_per_s, 4 * bodies * 20.0, 1e-6);
  EXPECT_EQ(record.update_age_samples, 4u * 20u)
      << "clients count by stamps: that of tick 25 is before 1.27 s";
  EXPECT_NEAR(report("bots")["measured_s"].get<double>(), 1.01, 1e-9)
      << "their own counters they read by their clock";
  EXPECT_EQ(record.entities,
            scene.bodies.bats.size() + scene.bodies.pucks.size() + scene.bodies.posts.size());
}

TEST_F(SpanTest, OverSocketsAsManyTicksAreCountedAndSentAsInVirtualTime) {
  experiment_.transport = TransportKind::tcp;
  experiment_.duration_s = 0.4;
  const RunRecord record = sound(run_cell(settings_, experiment_, cell(), no_keys()));
  const game::Scene scene = scene_of(experiment_, cell());
  EXPECT_EQ(record.ticks, 8u);
  EXPECT_EQ(report("server")["messages_sent"].get<std::uint64_t>(),
            8 * 4 * (scene.bodies.bats.size() + scene.bodies.pucks.size()));
  EXPECT_NEAR(*record.measured_s, 0.4, 0.02);
  EXPECT_EQ(record.update_age_samples, 8u * 4u);
  for (const char* who : {"server", "bots"})
    EXPECT_EQ(report(who)["evidence_bytes"], 0) << "none was asked for";
}

/// A hundred bats and a thousand pucks are ten kilobytes a tick, in seven datagrams or more to each
/// client: one sample each.
TEST_F(SpanTest, ATickThatComesInSeveralDatagramsIsOneSample) {
  experiment_.transport = TransportKind::udp;
  experiment_.population = Population::fixed;
  experiment_.duration_s = 0.3;
  const RunRecord record = sound(run_cell(settings_, experiment_, cell(), no_keys()));
  EXPECT_EQ(record.ticks, 6u);
  EXPECT_EQ(record.update_age_samples, 6u * 4u);
}

/// A second and the one after it, counted apart, are the two together: what happens at the border
/// is in one of them.
TEST_F(SpanTest, SpansThatFollowEachOtherAddUp) {
  const std::filesystem::path log = folder_ / "some.keys";
  experiment_.scene = "arena";
  experiment_.policies = {"on-event"};
  experiment_.schemes = {"region"};
  experiment_.view_area = 4.0;
  experiment_.delay_ms = 5.0;
  experiment_.duration_s = 2.0;
  for (const char* mode : {"client-server", peer_mode}) {
    SCOPED_TRACE(mode);
    experiment_.modes = {mode};
    write_game_plan(experiment_, cell(), log);
    const auto counted = [&](double warm_up_s, double duration_s) {
      experiment_.warm_up_s = warm_up_s, experiment_.duration_s = duration_s;
      const bool are_peers = cell().mode == peer_mode;
      sound(
          (are_peers ? run_virtual_peers : run_virtual_cell)(settings_, experiment_, cell(), log));
      nlohmann::json carried = report(are_peers ? "peers" : "server"), players = report("bots"),
                     sums;
      for (const char* key :
           {"ticks", "measured_s", "messages_sent", "bytes_sent", "bytes_received", "writes_sent",
            "segments_sent", "state_bytes_sent", "key_bytes_received"})
        sums[key] = carried[key];
      for (const char* key :
           {"bytes_sent", "bytes_received", "segments_sent", "keys_due", "keys_sent", "measured_s"})
        sums[std::string("players' ") + key] = players[key];
      if (!are_peers) sums["physics_events"] = carried["physics_events"];
      sums["ages"] = players["update_age_ms"]["count"];
      for (const nlohmann::json& bytes : players["bytes_received_by_bot"])
        sums["by player " + std::to_string(sums.size())] = bytes;
      return sums;
    };
    const nlohmann::json first = counted(0.25, 1.0), second = counted(1.25, 1.0),
                         both = counted(0.25, 2.0);
    for (const auto& [key, value] : both.items()) {
      EXPECT_NEAR(first[key].get<double>() + second[key].get<double>(), value.get<double>(), 1e-9)
          << key;
      EXPECT_GT(first[key], 0) << key;
    }
  }
}

TEST_F(SpanTest, WindowsOfPeersAreMeasuredFromWarmUpToTheEndOfTheLast) {
  experiment_.warm_up_s = 0.25, experiment_.duration_s = 2.0;
  EXPECT_EQ(last_window(experiment_, cell()), 45u);
  EXPECT_EQ(measured_windows(experiment_, cell()), 40u) << "5 to 44";
  experiment_.warm_up_s = 0.0;
  EXPECT_EQ(measured_windows(experiment_, cell()), 39u) << "1 to 39, for nothing ends at the start";
  experiment_.duration_s = 0.01;
  EXPECT_EQ(measured_windows(experiment_, cell()), 0u);
}

/// Costs of ticks are those of the ticks that are counted.
TEST_F(SpanTest, EvidenceHasTheCostOfEachMeasuredTickAndOfNoOther) {
  experiment_.duration_s = 1.0;
  settings_.wants_truth = true;
  const RunRecord record = sound(run_virtual_cell(settings_, experiment_, cell(), no_keys()));
  const game::ServerTrace trace =
      game::read_server_trace((folder_ / (name_of(cell()) + ".server.jsonl")).string());
  ASSERT_EQ(trace.ticks.size(), *record.ticks);
  EXPECT_DOUBLE_EQ(trace.ticks.front().simulated_s, 0.25);
  EXPECT_DOUBLE_EQ(trace.ticks.back().simulated_s, 1.2);
  EXPECT_DOUBLE_EQ(trace.end_s, 1.25) << "the game goes on to the end";
}

/// The server's own means beside what it noted of each tick, and the processes' costs beside what
/// the kernel says of them.
TEST_F(SpanTest, CostsOfTicksAndProcessesAreThoseThatWereNoted) {
  experiment_.transport = TransportKind::tcp;
  experiment_.duration_s = 0.3;
  settings_.wants_truth = true;
  const RunRecord record = sound(run_cell(settings_, experiment_, cell(), no_keys()));
  const game::ServerTrace trace =
      game::read_server_trace((folder_ / (name_of(cell()) + ".server.jsonl")).string());
  ASSERT_EQ(trace.ticks.size(), 6u);
  double physics_s = 0.0, filter_s = 0.0, send_s = 0.0, longest_s = 0.0;
  for (const game::ServerTrace::Tick& tick : trace.ticks) {
    physics_s += tick.physics_s, filter_s += tick.filter_s, send_s += tick.send_s;
    longest_s = std::max(longest_s, tick.physics_s + tick.filter_s + tick.send_s);
  }
  constexpr double rounding_us = 1e-3;  // the file has nanoseconds
  EXPECT_NEAR(*record.physics_us_per_tick, 1e6 * physics_s / 6, rounding_us);
  EXPECT_NEAR(*record.filter_us_per_tick, 1e6 * filter_s / 6, rounding_us);
  EXPECT_NEAR(*record.send_us_per_tick, 1e6 * send_s / 6, rounding_us);
  EXPECT_NEAR(*record.tick_us.max, 1e6 * longest_s, 2 * rounding_us);
  EXPECT_FALSE(record.tick_us.p50) << "six ticks";
  const double processors = static_cast<double>(game::allowed_processors().size());
  ASSERT_TRUE(record.health.bots_cpu_share);
  EXPECT_GT(*record.health.bots_cpu_share, 0.0);
  EXPECT_LE(*record.health.bots_cpu_share * 0.3 * processors, *record.bots_cpu_s + 0.02)
      << "a part of what the process used from start to end, but for the kernel's 10 ms";
  EXPECT_NEAR(*record.nodes.mean_cpu_s, (*record.server_cpu_s + *record.bots_cpu_s) / (1 + 4),
              1e-12)
      << "the nodes are the server and four bots";
  EXPECT_EQ(record.nodes.busiest_cpu_s, record.server_cpu_s);
  for (const char* who : {"server", "bots"})
    EXPECT_GT(report(who)["evidence_bytes"], 1'000) << "in memory until the run is over";
  EXPECT_GT(*record.health.histogram_ns_per_record, 0.1);
  EXPECT_LT(*record.health.histogram_ns_per_record, 1e5);
  rusage children{};
  ASSERT_EQ(getrusage(RUSAGE_CHILDREN, &children), 0);
  EXPECT_LE(static_cast<double>(*record.server_rss_bytes),
            1024.0 * static_cast<double>(children.ru_maxrss))
      << "never more than the largest of the two ever had";
  EXPECT_GT(*record.server_rss_bytes, 1'000'000u);
}

/// Under `on-event` most ticks have nothing to say to most players, and whoever flies into the view
/// of one is said with a stamp of long ago.
TEST_F(SpanTest, AStateOnEntryIsNoNewsOfTheTickWhoseStampItBears) {
  experiment_.schemes = {"region"};
  experiment_.policies = {"on-event"};
  experiment_.clients = {6};
  experiment_.view_fractions = {0.05};
  experiment_.duration_s = 4.0;
  for (const double delay_ms : {0.0, 10.0}) {
    experiment_.delay_ms = delay_ms;
    const std::filesystem::path log = folder_ / "some.keys";
    write_game_plan(experiment_, cell(), log);
    const RunRecord record = sound(run_virtual_cell(settings_, experiment_, cell(), log));
    const nlohmann::json ages = report("bots")["update_age_ms"];
    EXPECT_NEAR(ages["min_s"].get<double>(), 1e-3 * delay_ms, 1e-12);
    EXPECT_NEAR(ages["max_s"].get<double>(), 1e-3 * delay_ms, 1e-12);
    EXPECT_GT(*record.update_age_samples, 100u);
    EXPECT_LE(*record.update_age_samples, record.cell.clients * *record.ticks);
  }
}

}  // namespace
}  // namespace rink::loadgen
