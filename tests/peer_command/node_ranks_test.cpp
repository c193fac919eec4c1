// Nodes as ranks of MPI, rink-serve with --transport mpi: clients of each play the game of one
// engine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "game/control/game.h"
#include "game/control/key_log_file.h"
#include "game/control/replay.h"
#include "game/model/scene_file.h"
#include "game/net/exit_status.h"
#include "game/process/process.h"
#include "tests/peer_command/peer_processes.h"
#include "tests/peer_command/rank_processes.h"
#include "tests/peer_command/uneven_scene.h"

namespace rink::game {
namespace {

using testing::AllOf;

class NodesAsRanks : public RankProcesses {
 protected:
  NodesAsRanks() { std::ofstream(folder_ / "small.toml") << small_scene; }

  std::string scene() const { return (folder_ / "small.toml").string(); }
  std::string record_of(int rank) const {
    return (folder_ / ("game." + std::to_string(rank) + ".keys")).string();
  }
  /// A rank that seats two players by default, and its record.
  Words node(Words further = {}) const {
    add(further, "--scene", scene());
    add(further, "--clients", "2");
    add(further, "--duration", "2");
    add(further, "--record", (folder_ / "game.keys").string());
    return with_program(further, "rink-serve", {});
  }
  /// Unless the flag is given.
  static void add(Words& arguments, const std::string& flag, const std::string& value) {
    if (std::ranges::find(arguments, flag) == arguments.end())
      arguments.insert(arguments.end(), {flag, value});
  }
  /// What follows `beginning` in a line of the ranks' output.
  std::optional<std::string> line_after(const std::string& beginning) const {
    std::istringstream lines(test::text_of(output_));
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(beginning) && !lines.eof()) return line.substr(beginning.size());
    return std::nullopt;
  }
  std::optional<std::string> place_of(int rank) const {
    return line_after("rank " + std::to_string(rank) + ": listening on ");
  }
  bool until(const std::function<bool()>& is_reached, std::chrono::seconds limit = 60s) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!is_reached() && !launcher_->ending() && std::chrono::steady_clock::now() < end) {
      launcher_->attend(5ms);
      for (const auto& bot : bots_) bot->attend(5ms);
    }
    return is_reached();
  }
  bool all_listen(int count) {
    return until([&] {
      for (int rank = 0; rank < count; ++rank)
        if (!place_of(rank)) return false;
      return true;
    });
  }
  /// One of `count` ranks in the middle of a game; 0 if there is none.
  pid_t one_that_plays(int count) {
    if (!all_listen(count)) return 0;
    std::this_thread::sleep_for(2s);
    const std::vector<pid_t> ranks = children_of(launcher_->id(), "rink-serve");
    return ranks.size() == static_cast<std::size_t>(count) ? ranks[1] : 0;
  }
  Process& bots(int rank, Words further = {}) {
    add(further, "--connect", place_of(rank).value_or("nowhere:1"));
    add(further, "--count", "2");
    add(further, "--scene", scene());
    add(further, "--players", "waypoint");
    add(further, "--duration", "2");
    add(further, "--view", "0.2");
    return *bots_.emplace_back(
        std::make_unique<Process>(test::binary_folder() + "/bin/rink-bots", further));
  }
  /// The launcher and all bots have ended well.
  void expect_good_end() {
    until([] { return false; });
    ASSERT_TRUE(launcher_->ending());
    EXPECT_EQ(launcher_->ending()->exit_status, 0) << launcher_->stderr_tail();
    for (const auto& bot : bots_) {
      for (int k = 0; k < 1000 && !bot->ending(); ++k) bot->attend(10ms);
      ASSERT_TRUE(bot->ending());
      EXPECT_EQ(bot->ending()->exit_status, 0) << bot->stderr_tail();
    }
  }
  /// The log that each rank has written, which one engine replays to its hash.
  KeyLog same_log(int count) const {
    const KeyLog log = read_key_log(std::filesystem::path(record_of(0)));
    for (int rank = 1; rank < count; ++rank)
      EXPECT_EQ(log, read_key_log(std::filesystem::path(record_of(rank))));
    EXPECT_TRUE(log.hash);
    EXPECT_EQ(replay(log, recorded_scene(log, record_of(0))), log.hash.value_or(0));
    return log;
  }
  /// All have printed that hash.
  void expect_hash(int count, std::uint64_t hash) const {
    char text[32];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    for (int rank = 0; rank < count; ++rank)
      EXPECT_THAT(line_after("node " + std::to_string(rank) + " of " + std::to_string(count) + ": ")
                      .value_or("nothing"),
                  HasSubstr(text));
  }
  static std::vector<int> key_counts(const KeyLog& log) {
    std::vector<int> counts(8, 0);
    for (const InputEvent& event : log.events) ++counts[event.player];
    return counts;
  }

  std::deque<std::unique_ptr<Process>> bots_;
};

class NumberOfNodes : public NodesAsRanks, public testing::WithParamInterface<int> {};

TEST_P(NumberOfNodes, PlayWithClientsOfEachTheGameOfOneEngine) {
  const int count = GetParam();
  const std::string clients = std::to_string(8 / count);
  run({{count, node({"--clients", clients})}});
  ASSERT_TRUE(all_listen(count)) << launcher_->stderr_tail();
  for (int rank = 0; rank < count; ++rank) bots(rank, {"--count", clients});
  expect_good_end();
  const KeyLog log = same_log(count);
  expect_hash(count, log.hash.value_or(0));
  EXPECT_THAT(key_counts(log), testing::Each(testing::Gt(0))) << "players of all ranks play";
}
INSTANTIATE_TEST_SUITE_P(Ranks, NumberOfNodes, testing::Values(2, 4));

TEST_F(NodesAsRanks, GiveFreeBatsToLatecomersAtEach) {
  run({{2, node({"--clients", "3", "--duration", "6"})}});
  ASSERT_TRUE(all_listen(2)) << launcher_->stderr_tail();
  for (int rank = 0; rank < 2; ++rank) bots(rank, {"--count", "3", "--duration", "6"});
  std::this_thread::sleep_for(2s);
  for (int rank = 0; rank < 2; ++rank)
    bots(rank, {"--count", "1", "--first", "6", "--duration", "6"});
  expect_good_end();
  EXPECT_THAT(key_counts(same_log(2)), testing::Each(testing::Gt(0)));
}

TEST_F(NodesAsRanks, ShiftZonesTowardEqualLoad) {
  std::ofstream(folder_ / "small.toml") << uneven_scene();
  run({{2, node({"--duration", "3"})}});
  ASSERT_TRUE(all_listen(2)) << launcher_->stderr_tail();
  for (int rank = 0; rank < 2; ++rank) bots(rank, {"--duration", "3"});
  expect_good_end();
  expect_hash(2, same_log(2).hash.value_or(0));
  const std::string output = test::text_of(output_);
  EXPECT_THAT(output, HasSubstr("zones shifted "));
  EXPECT_THAT(output, testing::Not(HasSubstr("zones shifted 0 times")));
}

TEST_F(NodesAsRanks, ListenAtThePortAndTheirNumberAndNameOneWhosePortIsTaken) {
  const auto other = std::make_unique<Process>(test::binary_folder() + "/bin/rink-serve",
                                               Words{"--scene", scene(), "--port", "0"});
  std::optional<std::string> place;
  for (int k = 0; k < 1000 && !place; ++k)
    other->attend(10ms), place = other->line_after("listening on ");
  ASSERT_TRUE(place);
  const int taken = std::stoi(place->substr(place->find(':') + 1));
  run({{3, node({"--port", std::to_string(taken - 2)})}});
  ASSERT_TRUE(ends());
  EXPECT_EQ(launcher_->ending()->exit_status, static_cast<int>(ExitStatus::address_in_use));
  EXPECT_THAT(launcher_->stderr_tail(), AllOf(HasSubstr("rank 2: "), HasSubstr("in use")));
  EXPECT_EQ(place_of(0), "127.0.0.1:" + std::to_string(taken - 2));
}

TEST_F(NodesAsRanks, WhoDifferAreNamedAndNobodyPlays) {
  run({{1, node()},
       {1, node({"--seed", "9"})},
       {1, node({"--duration", "3"})},
       {1, node({"--balance", "50"})},
       {1, node({"--clients", "7"})},
       {1, with_program({}, "rink-peer", {"--scene", scene()})}});
  ASSERT_TRUE(ends());
  EXPECT_EQ(launcher_->ending()->exit_status, static_cast<int>(ExitStatus::not_admitted));
  EXPECT_THAT(
      launcher_->stderr_tail(),
      AllOf(HasSubstr("rank 1 cannot play with rank 0: it has another scene"),
            HasSubstr("rank 2 cannot play with rank 0: it is to play 3 s in windows of"),
            HasSubstr("rank 3 cannot play with rank 0: its --balance is 50, here it is 25"),
            HasSubstr("rank 4 cannot play with rank 0: it wants to play 7 bats, of 8 here 6 are"),
            HasSubstr("rank 5 cannot play with rank 0: it has other keys")));
  EXPECT_EQ(test::text_of(output_), "");
}

TEST_F(NodesAsRanks, OneThatIsKilledEndsAll) {
  run({{4, node({"--clients", "0", "--duration", "1000"})}});
  const pid_t rank = one_that_plays(4);
  ASSERT_NE(rank, 0) << launcher_->stderr_tail();
  ASSERT_EQ(kill(rank, SIGKILL), 0);
  ASSERT_TRUE(ends(10s));
  EXPECT_NE(launcher_->ending()->exit_status, 0);
  EXPECT_THAT(launcher_->stderr_tail(), HasSubstr("signal 9"));
}

TEST_F(NodesAsRanks, OneThatFallsSilentIsWaitedForWithPatienceThenAllEnd) {
  run({{4, node({"--clients", "0", "--duration", "1000", "--node-patience", "1"})}});
  const pid_t rank = one_that_plays(4);
  ASSERT_NE(rank, 0) << launcher_->stderr_tail();
  ASSERT_EQ(kill(rank, SIGSTOP), 0);
  ASSERT_TRUE(ends(20s));
  EXPECT_EQ(launcher_->ending()->exit_status, static_cast<int>(ExitStatus::connection_lost));
  EXPECT_THAT(launcher_->stderr_tail(), HasSubstr("was silent for 1 s"));
}

TEST_F(NodesAsRanks, KeepWhatWasPlayedWhenOneOrTheLauncherIsInterrupted) {
  for (const bool is_one : {true, false}) {
    run({{2, node({"--duration", "1000"})}});
    ASSERT_TRUE(all_listen(2)) << launcher_->stderr_tail();
    for (int rank = 0; rank < 2; ++rank) bots(rank, {"--duration", "1000", "--view", "1"});
    std::this_thread::sleep_for(3s);
    const std::vector<pid_t> ranks = children_of(launcher_->id(), "rink-serve");
    ASSERT_EQ(ranks.size(), 2u);
    ASSERT_EQ(kill(is_one ? ranks.front() : launcher_->id(), SIGINT), 0);
    ASSERT_TRUE(ends(20s));
    // Interrupted, Open MPI ends with 1 whatever its ranks end with.
    EXPECT_EQ(launcher_->ending()->exit_status,
              is_one ? static_cast<int>(ExitStatus::interrupted) : 1);
    for (int rank = 0; rank < 2; ++rank) {
      const KeyLog log = read_key_log(std::filesystem::path(record_of(rank)));
      ASSERT_TRUE(log.hash);
      EXPECT_EQ(replay(log, recorded_scene(log, record_of(rank))), *log.hash);
    }
  }
}

TEST_F(NodesAsRanks, OneWithoutALauncherIsOneServer) {
  const auto alone = std::make_unique<Process>(
      test::binary_folder() + "/bin/rink-serve",
      Words{"--transport", "mpi", "--scene", scene(), "--clients", "0", "--duration", "1"});
  for (int k = 0; k < 4000 && !alone->ending(); ++k) alone->attend(10ms);
  ASSERT_TRUE(alone->ending());
  EXPECT_EQ(alone->ending()->exit_status, 0) << alone->stderr_tail();
  Game one(load_scene(scene()));
  one.advance(1.0);
  char text[32];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(one.hash()));
  EXPECT_THAT(alone->line_after("node 0 of 1: ").value_or("nothing"), HasSubstr(text));
}

/// How rink-serve ends with these flags beside --transport mpi, without a launcher.
std::pair<int, std::string> ending_of(const Words& further) {
  Words words{"--transport", "mpi", "--scene", "arena"};
  words.insert(words.end(), further.begin(), further.end());
  Process node(test::binary_folder() + "/bin/rink-serve", words);
  while (!node.ending()) node.attend(10ms);
  return {node.ending()->exit_status, node.stderr_tail()};
}

TEST(NodeAsARank, RefusesFlagsThatRanksDoNotHave) {
  for (const auto& [flag, value] : std::vector<std::pair<std::string, std::string>>{
           {"--nodes", "2"}, {"--join", "127.0.0.1:1"}, {"--node-listen", "127.0.0.1:0"}}) {
    const auto [status, words] = ending_of({flag, value, "--duration", "1"});
    EXPECT_EQ(status, 2) << flag;
    EXPECT_THAT(words, HasSubstr("with --transport mpi the launcher says how many there are"));
  }
  const auto [status, words] = ending_of({"--budget", "9"});
  EXPECT_EQ(status, 2);
  EXPECT_THAT(words, HasSubstr("--budget: nodes play each window whole"));
}

TEST(NodeAsARank, SaysWhatToInstallWhereThereIsNoMpi) {
  if (rti::Ranks::is_built_in()) GTEST_SKIP() << "this build has MPI";
  const auto [status, words] = ending_of({"--duration", "1"});
  EXPECT_EQ(status, 1);
  EXPECT_THAT(words, HasSubstr("this build has no MPI: install libopenmpi-dev and openmpi-bin"));
}

}  // namespace
}  // namespace rink::game
