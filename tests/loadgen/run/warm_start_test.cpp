// Runs that begin from a saved game: they play on the game that was never interrupted, and are
// judged as any other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/control/game_state.h"
#include "game/control/key_log_file.h"
#include "game/net/server_trace.h"
#include "game/net/trace_lines.h"
#include "im/basics/hexadecimal.h"
#include "loadgen/experiment/experiment_file.h"
#include "loadgen/run/cell_runner.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/virtual_run.h"
#include "tests/loadgen/complaint.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class WarmStart : public testing::Test {
 protected:
  WarmStart() {
    settings_.directory = folder_ / "cells";
    std::filesystem::create_directory(settings_.directory);
    std::filesystem::create_directory(folder_ / "keys");
    settings_.serve = test::binary_folder() + "/bin/rink-serve";
    settings_.bots = test::binary_folder() + "/bin/rink-bots";
    experiment_.name = "small", experiment_.scene = "crowd";
    experiment_.transport = TransportKind::virtual_time;
    experiment_.population = Population::per_client;
    experiment_.schemes = {"region"}, experiment_.clients = {6}, experiment_.seeds = {3};
    experiment_.tick_rates_hz = {20.0};
    experiment_.start_s = 20.0, experiment_.warm_up_s = 0.25, experiment_.duration_s = 1.0;
  }

  Cell cell() const { return cells_of(experiment_).front(); }
  void write_plan() const { write_game_plan(experiment_, cell(), log()); }
  std::filesystem::path log() const { return folder_ / "keys" / "seed3.keys"; }
  std::vector<game::InputEvent> keys() const { return game::read_key_log(log()).events; }
  RunRecord virtual_run() const {
    return run_virtual_cell(settings_, experiment_, cell(), log()).value_or(RunRecord{});
  }
  std::filesystem::path evidence_file() const {
    return settings_.directory / (name_of(cell()) + ".server.jsonl");
  }

  /// Of the game of all keys, played from the scene's beginning in one go to the last tick.
  std::string hash_in_one_go() const {
    game::Game game(scene_of(experiment_, cell()));
    for (const game::InputEvent& key : keys()) game.submit(key);
    game.advance(experiment_.start_s + (experiment_.warm_up_s + experiment_.duration_s));
    return hexadecimal(game.hash());
  }
  std::size_t keys_within(double from_s, double until_s) const {
    const auto all = keys();
    return static_cast<std::size_t>(std::ranges::count_if(all, [=](const game::InputEvent& key) {
      return key.time >= from_s && key.time < until_s;
    }));
  }

  test::TemporaryFolder folder_{"warm"};
  RunnerSettings settings_;
  Experiment experiment_;
};

TEST_F(WarmStart, RunInVirtualTimePlaysOnTheGameAndIsJudgedByIt) {
  experiment_.delay_ms = 10.0;
  write_plan();
  const RunRecord record = virtual_run();
  EXPECT_EQ(record.why_invalid, "");
  EXPECT_EQ(record.state_hash, hash_in_one_go());
  EXPECT_EQ(record.truth.error, "");
  EXPECT_GT(record.truth.delivered_recall.value_or(0.0), 0.9);
  EXPECT_EQ(record.start_s, 20.0);
  EXPECT_EQ(record.keys_due, keys_within(20.25, 21.25))
      << "those before the start were pressed, those of the warm-up are not counted";
  const nlohmann::json ages = nlohmann::json::parse(
      test::text_of(settings_.directory / (name_of(cell()) + ".bots.json")))["update_age_ms"];
  EXPECT_NEAR(ages["min_s"].get<double>(), 0.01, 1e-9);
  EXPECT_NEAR(ages["max_s"].get<double>(), 0.01, 1e-9);
  const game::ServerTrace trace = game::read_server_trace(evidence_file());
  EXPECT_EQ(trace.from_s, 20.25);
  EXPECT_EQ(trace.until_s, 21.25);
  ASSERT_FALSE(trace.keys.empty());
  EXPECT_GT(trace.keys.front().time, 20.0);
}

TEST_F(WarmStart, RunOverSocketsEndsInTheSameStateAndTheJudgeFindsTheSavedGame) {
  experiment_.transport = TransportKind::tcp;
  write_plan();
  const RunRecord record = run_cell(settings_, experiment_, cell(), log()).value_or(RunRecord{});
  EXPECT_EQ(record.state_hash, hash_in_one_go()) << record.why_invalid;
  EXPECT_EQ(record.truth.error, "");
  EXPECT_TRUE(record.truth.filter_recall);
  EXPECT_EQ(game::read_server_trace(evidence_file()).state_file, state_file_of(log()).string());
}

TEST_F(WarmStart, LiveKeysOfRandomPlayersTakeEffectInTheGameThatTheyBegan) {
  experiment_.keys = KeySource::live;
  write_plan();
  const RunRecord record = virtual_run();
  EXPECT_EQ(record.why_invalid, "");
  EXPECT_EQ(record.truth.error, "");
  EXPECT_NE(record.state_hash, hash_in_one_go()) << "keys take effect when they arrive, 10 ms late";
}

TEST_F(WarmStart, SameSeedGivesTheSameFilesInVirtualTime) {
  write_plan();
  virtual_run();
  const std::string state = test::text_of(state_file_of(log())),
                    trace = test::text_of(evidence_file());
  write_plan();
  virtual_run();
  EXPECT_EQ(test::text_of(state_file_of(log())), state);
  EXPECT_EQ(test::text_of(evidence_file()), trace);
}

TEST_F(WarmStart, EvidenceMovesWithItsSavedGameAndIsNotReadWithoutOrWithAnother) {
  write_plan();
  virtual_run();
  const test::TemporaryFolder elsewhere("elsewhere");
  std::filesystem::copy(
      folder_.path(), elsewhere.path(),
      std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing);
  const std::filesystem::path trace = elsewhere / "cells" / evidence_file().filename(),
                              state = elsewhere / "keys" / "seed3.state";
  EXPECT_EQ(game::read_server_trace(trace).state_file, state.string());
  const auto refusal = [&] {
    try {
      game::read_server_trace(trace);
    } catch (const game::TraceError& error) {
      return std::string(error.what());
    }
    return std::string("(accepted)");
  };
  std::ofstream(state, std::ios::app) << ' ';
  EXPECT_THAT(refusal(), AllOf(HasSubstr(state.string()), HasSubstr("its hash differs")));
  std::filesystem::remove(state);
  EXPECT_THAT(refusal(), AllOf(HasSubstr(state.string()), HasSubstr("cannot be read")));
}

TEST_F(WarmStart, DamagedSavedGameEndsTheServerByItsName) {
  experiment_.transport = TransportKind::tcp;
  write_plan();
  std::ofstream(state_file_of(log()), std::ios::app) << ' ';
  const RunRecord record = run_cell(settings_, experiment_, cell(), log()).value_or(RunRecord{});
  EXPECT_FALSE(record.valid);
  EXPECT_THAT(record.why_invalid, AllOf(HasSubstr("seed3.state"), HasSubstr("damaged")));
}

TEST(WarmStarts, AreAskedForOnlyWhereTheGameCanBeSaved) {
  const std::string minimal = "name = 'x'\nscene = 'arena'\n";
  const auto complaint_about = [](const std::string& text) {
    return complaint_of([&] { parse_experiment(text, "dir/x.toml", {}); });
  };
  EXPECT_THAT(complaint_about(minimal + "start_s = 601"),
              AllOf(HasSubstr("start_s"), HasSubstr("0 to 600")));
  EXPECT_THAT(complaint_about(minimal + "start_s = 20\nmodes = ['peer-to-peer']"),
              HasSubstr("expected start_s = 0"));
  EXPECT_THAT(complaint_about(minimal + "start_s = 20\nkeys = 'live'\nplayers = 'chaser'"),
              HasSubstr("start_s above 0 with keys = live"));
}

}  // namespace
}  // namespace rink::loadgen
