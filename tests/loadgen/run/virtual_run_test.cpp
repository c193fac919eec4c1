// Runs under a virtual clock: closed forms of their latencies, the same game as elsewhere, the same
// bytes every time.
#include "loadgen/run/virtual_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <sstream>
#include <vector>

#include "game/control/game.h"
#include "game/control/key_log.h"
#include "game/net/evidence.h"
#include "loadgen/measure/summary.h"
#include "loadgen/measure/truth/bots_evidence.h"
#include "loadgen/run/campaign.h"
#include "loadgen/run/game_plan.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class VirtualRunTest : public testing::Test {
 protected:
  VirtualRunTest() {
    settings_.directory = folder_;
    settings_.serve = test::binary_folder() + "/bin/rink-serve";
    settings_.bots = test::binary_folder() + "/bin/rink-bots";
    experiment_.name = "small";
    experiment_.scene = "crowd";
    experiment_.transport = TransportKind::virtual_time;
    experiment_.population = Population::per_client;
    experiment_.schemes = {"none", "region"};
    experiment_.clients = {6};
    experiment_.seeds = {3};
    experiment_.tick_rates_hz = {20.0};
    experiment_.warm_up_s = 0.25;
    experiment_.duration_s = 2.0;
  }

  std::filesystem::path key_log(const Cell& cell) const {
    const std::filesystem::path file = folder_ / "log.keys";
    write_game_plan(experiment_, cell, file);
    return file;
  }
  RunRecord run(const Cell& cell) const {
    const auto record = run_virtual_cell(settings_, experiment_, cell, key_log(cell));
    EXPECT_TRUE(record);
    EXPECT_EQ(record.value_or(RunRecord{}).why_invalid, "");
    return record.value_or(RunRecord{});
  }
  nlohmann::json report(const Cell& cell, const char* who) const {
    return nlohmann::json::parse(test::text_of(folder_ / (name_of(cell) + "." + who + ".json")));
  }
  Cell first_cell() const { return cells_of(experiment_).front(); }

  test::TemporaryFolder folder_{"virtual"};
  RunnerSettings settings_;
  Experiment experiment_;
};

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
    const std::set<std::string> of_processes{
        "cpu_share",       "evidence_bytes", "histogram_ns_per_record",
        "burst_bytes_max", "pace",           "send_us_max",
        "spread",          "time_managed"};
    for (const auto& [key, value] : over_sockets.items())
      EXPECT_TRUE(of_processes.contains(key) || mine.contains(key))
          << "the " << who << "' report over sockets has " << key;
  }
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
    const Outcome outcome = run_campaign(experiment_, settings_, results, write_keys, progress);
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
            report(first_cell(), "bots")["total_bytes_sent"].get<std::uint64_t>() + 6 * 5)
      << "the bots take their leave after their report";
}

TEST_F(VirtualRunTest, TruthThatTakesInTheOwnSideAndPostsIsFoundByTheExpressionThatSaysSo) {
  experiment_.clients = {12};
  experiment_.relevance = Relevance::disc;
  experiment_.also_relevant = {"team", "always"};
  settings_.wants_truth = true;
  const auto truth = [this](const std::string& scheme) {
    Cell cell = first_cell();
    cell.scheme = scheme;
    cell.parameters.view_margin = 0.0;
    return run(cell).truth;
  };
  const TruthFigures all = truth("aura or team or always"), near = truth("aura"),
                     mates = truth("team"), own = truth("owner");
  EXPECT_THAT(all.relevance,
              AllOf(HasSubstr("disc of"), HasSubstr("or a bat of the player's team, or any post")));
  EXPECT_GT(all.filter_recall.value_or(0.0), 0.98) << "what is missing is as old as a decision";
  EXPECT_GT(all.filter_precision.value_or(0.0), 0.8) << "the rim of boxes that reach into the disc";
  EXPECT_LT(near.filter_recall.value_or(1.0), all.filter_recall.value_or(0.0) - 0.2)
      << "five of his side, and the posts, are elsewhere";
  EXPECT_EQ(mates.filter_precision, 1.0);
  EXPECT_LT(mates.filter_recall.value_or(1.0), 0.8);
  EXPECT_FALSE(own.filter_precision) << "his own bat is in no count, and nothing else is chosen";
}

/// The same sets by another way: every figure but the dates of entries agrees.
TEST_F(VirtualRunTest, RelevanceByTheExpressionRegionIsThatOfTheRectangle) {
  experiment_.clients = {12};
  settings_.wants_truth = true;
  const Cell region = cells_of(experiment_).back();
  const TruthFigures rectangle = run(region).truth;
  experiment_.relevance = Relevance::filter;
  experiment_.relevant = "region";
  const TruthFigures by_filter = run(region).truth;
  EXPECT_EQ(by_filter.filter_recall, rectangle.filter_recall);
  EXPECT_EQ(by_filter.filter_precision, rectangle.filter_precision);
  EXPECT_EQ(by_filter.delivered_recall, rectangle.delivered_recall);
  EXPECT_EQ(by_filter.displayed_error_mm.rms, rectangle.displayed_error_mm.rms);
  EXPECT_EQ(by_filter.wasted_bytes_fraction, rectangle.wasted_bytes_fraction);
  ASSERT_TRUE(rectangle.filter_recall && rectangle.wasted_bytes_fraction)
      << "or the test shows nothing";
}

TEST_F(VirtualRunTest, ByContactLessOfWhatIsRelevantIsInTheViewTheFartherOneLooksAhead) {
  experiment_.clients = {12};
  experiment_.relevance = Relevance::contact;
  settings_.wants_truth = true;
  experiment_.view_margins = {0.0};
  const Cell none = first_cell(), region = cells_of(experiment_).back();
  double recall_before = 1.01, precision_before = 0.0;
  for (const double contact_s : {0.1, 0.3, 0.9}) {
    experiment_.contact_s = contact_s;
    const TruthFigures truth = run(region).truth;
    EXPECT_THAT(truth.relevance, HasSubstr("can touch the bat within 0." +
                                           std::to_string(std::lround(10.0 * contact_s)) + " s"));
    EXPECT_LT(truth.filter_recall.value_or(2.0), recall_before);
    EXPECT_GE(truth.filter_precision.value_or(-1.0), precision_before);
    recall_before = truth.filter_recall.value_or(0.0),
    precision_before = truth.filter_precision.value_or(2.0);
    EXPECT_EQ(run(none).truth.filter_recall, 1.0);
  }
}

/// Every entry and every exit that the server said reached a watched bot, without delay, and is in
/// its evidence.
TEST_F(VirtualRunTest, ChurnIsWhatTheServersFilterSaidWithinTheSpan) {
  experiment_.schemes = {"region"};
  experiment_.delay_ms = 0.0;
  experiment_.duration_s = 3.0;
  settings_.wants_truth = true;
  const RunRecord record = run(first_cell());
  const nlohmann::json server = report(first_cell(), "server");
  ASSERT_GT(server["scope_exits"], 10);
  ASSERT_GT(server["scope_entries"], 10);
  const double changes =
      server["scope_exits"].get<double>() + server["scope_entries"].get<double>();
  EXPECT_NEAR(*record.truth.churn_per_client_per_s, changes / 6.0 / 3.0, 1e-9);
  std::uint64_t exits = 0;
  for (const BotsEvidence::Bot& bot :
       read_bots_evidence((folder_ / (name_of(first_cell()) + ".bots.jsonl")).string()).bots)
    for (const BotsEvidence::ScopeChange& change : bot.changes)
      exits += !change.is_in && change.instant_s >= experiment_.warm_up_s &&
               change.instant_s < experiment_.warm_up_s + experiment_.duration_s;
  EXPECT_EQ(server["scope_exits"], exits);
}

/// Without delay a player's mirror follows each decision at once, so at any instant it has in scope
/// what the decision in force then let through.
TEST_F(VirtualRunTest, TheDecisionInForceIsThatOfTheNewestTick) {
  experiment_.schemes = {"region"};
  experiment_.delay_ms = 0.0;
  settings_.wants_truth = true;
  run(first_cell());
  const std::string stem = (folder_ / name_of(first_cell())).string();
  const game::ServerEvidence server = game::read_server_evidence(stem + ".server.jsonl");
  const BotsEvidence bots = read_bots_evidence(stem + ".bots.jsonl");
  const game::Game game(scene_of(experiment_, first_cell()));
  ASSERT_EQ(server.decisions.size(), 20u * 6u) << "20 instants of 6 players";
  std::set<std::vector<std::uint32_t>> different;
  for (const game::ServerEvidence::Decision& decision : server.decisions) {
    const std::uint32_t body = game.bat(decision.player)->index;
    const std::uint32_t bat =
        std::ranges::find(server.objects, body, &game::ServerEvidence::Naming::body)->object;
    std::set<std::uint32_t> mirrored,
        decided(server.scope_of(decision).begin(), server.scope_of(decision).end());
    for (const BotsEvidence::ScopeChange& change :
         std::ranges::find(bots.bots, bat, &BotsEvidence::Bot::object)->changes) {
      if (change.instant_s > decision.instant_s) break;
      if (change.is_in) mirrored.insert(change.object);
      else mirrored.erase(change.object);
    }
    decided.erase(bat), mirrored.erase(bat);
    ASSERT_EQ(decided, mirrored) << "player " << decision.player << " at " << decision.instant_s
                                 << " s";
    different.emplace(decided.begin(), decided.end());
  }
  EXPECT_GT(different.size(), 60u) << "or the test shows nothing";
}

/// A window of 50 ms before a sample holds one tick at 20 Hz, which says each body that moves in 8
/// bytes of values.
TEST_F(VirtualRunTest, WhatCameWithinTheWindowBeforeASampleIsOneTicksUpdates) {
  experiment_.schemes = {"none"};
  experiment_.delay_ms = 0.0;
  settings_.wants_truth = true;
  const RunRecord record = run(first_cell());
  const BotsEvidence bots =
      read_bots_evidence((folder_ / (name_of(first_cell()) + ".bots.jsonl")).string());
  ASSERT_GT(bots.beliefs.size(), 1'000u);
  std::set<std::uint32_t> sizes;
  for (const BotsEvidence::Belief& belief : bots.beliefs) sizes.insert(belief.bytes);
  EXPECT_LE(*sizes.rbegin(), 16u) << "two f32, and a bat's count of keys";
  EXPECT_EQ(
      std::ranges::count_if(bots.beliefs, [](const auto& belief) { return belief.bytes == 8u; }),
      std::ranges::count_if(
          bots.beliefs, [](const auto& belief) { return belief.bytes > 0 && belief.bytes < 9; }));
  for (const BotsEvidence::Sample& sample : bots.samples) {
    const auto beliefs = std::span(bots.beliefs).subspan(sample.first, sample.last - sample.first);
    ASSERT_EQ(sample.window_s, 0.05);
    ASSERT_GT(std::ranges::count_if(beliefs, [](const auto& belief) { return belief.bytes > 0; }),
              static_cast<std::ptrdiff_t>(beliefs.size()) * 9 / 10)
        << "all that move, at " << sample.displayed_s;
  }
  EXPECT_GT(*record.truth.wasted_bytes_fraction, 0.5) << "each sees a twentieth of the field";
}

/// Under a budget that holds less than what enters, a player hears that somebody came long before
/// he hears where: until then he holds nothing.
TEST_F(VirtualRunTest, WhoIsInScopeButWasNotToldWhereIsNotDelivered) {
  experiment_.schemes = {"region", "region with priority(budget=20)"};
  experiment_.view_fractions = {0.5};
  settings_.wants_truth = true;
  const std::vector<Cell> cells = cells_of(experiment_);
  const RunRecord all = run(cells[0]), few = run(cells[1]);
  EXPECT_EQ(all.truth.filter_recall, few.truth.filter_recall) << "the same decisions";
  EXPECT_GT(*all.truth.delivered_recall, 0.95);
  EXPECT_LT(*few.truth.delivered_recall, *all.truth.delivered_recall - 0.01);
  EXPECT_LT(*few.truth.displayed_error_mm.rms, 1000.0)
      << "nobody is shown where he was before he was known";
}

/// In frames of their own a key is 15 bytes and a heartbeat 5 (docs/wire.md).
TEST_F(VirtualRunTest, UnderNoneClientsSendKeysAndHeartbeatsAlone) {
  settings_.wants_truth = true;
  experiment_.view_margins = {0.0};
  const Cell none = first_cell(), region = cells_of(experiment_).back();
  const RunRecord record = run(none);
  run(region);
  const nlohmann::json bots = report(none, "bots"), others = report(region, "bots");
  const double keys_bytes = 15.0 * bots["keys_sent"].get<double>(),
               heartbeats_max = 6.0 * experiment_.duration_s;
  EXPECT_GE(bots["bytes_sent"].get<double>(), keys_bytes);
  EXPECT_LE(bots["bytes_sent"].get<double>(), keys_bytes + 5.0 * heartbeats_max);
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
