// Peers as ranks of MPI, started by mpirun on this machine with more ranks than processors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "game/control/game.h"
#include "game/control/key_log_file.h"
#include "game/control/playing.h"
#include "game/model/scene_file.h"
#include "game/net/exit_status.h"
#include "game/net/peer/network/rank_mail.h"
#include "game/process/process.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using namespace std::chrono_literals;
using Words = std::vector<std::string>;

std::string text_of(std::uint64_t hash) {
  char text[32];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

/// The processes that `parent` started, the launcher's ranks.
std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream stat(entry.path() / "stat");
    std::string number, name, state;
    pid_t its_parent = 0;
    if (stat >> number >> name >> state >> its_parent && its_parent == parent &&
        name == "(rink-peer)")
      children.push_back(std::stoi(number));
  }
  return children;
}

/// The processor time that the process has taken in user mode, in ticks of 10 ms.
long ticks_of(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string field;
  for (int k = 1; k <= 14; ++k) stat >> field;
  return std::atol(field.c_str());
}

class RanksOfMpi : public testing::Test {
 protected:
  void SetUp() override {
    if (!rti::Ranks::is_built_in()) GTEST_SKIP() << "this build has no MPI";
    // What the launcher and MPI's own threads leave behind at the end is not ours.
    setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
  }
  void TearDown() override { unsetenv("ASAN_OPTIONS"); }

  static Words peer(Words arguments) {
    arguments.insert(arguments.begin(), {test::binary_folder() + "/bin/rink-peer", "--transport",
                                         "mpi", "--scene", "arena"});
    return arguments;
  }
  /// `groups` of ranks that differ in what they are given.
  Process& run(const std::vector<std::pair<int, Words>>& groups) {
    Words arguments{"mpirun", "--allow-run-as-root", "--oversubscribe"};
    for (const auto& [count, words] : groups) {
      if (&words != &groups.front().second) arguments.push_back(":");
      arguments.insert(arguments.end(), {"-np", std::to_string(count)});
      arguments.insert(arguments.end(), words.begin(), words.end());
    }
    output_ = (folder_ / "output").string();
    // The shell keeps what is written, however long it is, and becomes the launcher.
    arguments.insert(arguments.begin(), {"-c", "exec \"$@\" > '" + output_ + "'", "sh"});
    return *(launcher_ = std::make_unique<Process>("/bin/sh", arguments));
  }
  bool ends(std::chrono::seconds limit = 40s) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!launcher_->ending() && std::chrono::steady_clock::now() < end) launcher_->attend(10ms);
    return launcher_->ending().has_value();
  }
  nlohmann::json report() const {
    return nlohmann::json::parse(test::text_of(output_), nullptr, false);
  }
  /// One of four ranks in the middle of a long game.
  pid_t one_of_four_that_play() {
    std::vector<pid_t> ranks;
    const auto end = std::chrono::steady_clock::now() + 40s;
    // Where a host's own name is unknown MPI takes seconds to begin, and under a sanitizer half a
    // second of a processor; whoever has taken a second of it plays.
    const auto do_play = [&] {
      return ranks.size() == 4 &&
             std::ranges::all_of(ranks, [](pid_t rank) { return ticks_of(rank) >= 100; });
    };
    while (!do_play() && std::chrono::steady_clock::now() < end)
      launcher_->attend(10ms), ranks = children_of(launcher_->id());
    return do_play() ? ranks[2] : 0;
  }

  test::TemporaryFolder folder_{"ranks"};
  std::string output_;
  std::unique_ptr<Process> launcher_;
};

TEST_F(RanksOfMpi, FourOnTwoProcessorsEndInTheHashOfOneEngineWithOneCollectiveForEachAgreement) {
  Game one(load_scene("arena"));
  one.advance(2.0);
  run({{4, peer({"--until", "2"})}});
  ASSERT_TRUE(ends());
  ASSERT_EQ(launcher_->ending()->exit_status, 0) << launcher_->stderr_tail();
  const nlohmann::json all = report();
  ASSERT_EQ(all["ranks"].size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(all["ranks"][k]["peer"], k);
    EXPECT_EQ(all["ranks"][k]["hash"], text_of(one.hash()));
    // The words at the start are one more; a window that is repeated is agreed upon again.
    EXPECT_EQ(all["collectives"],
              1 + all["ranks"][k]["windows"].get<int>() + all["ranks"][k]["repeats"].get<int>());
  }
}

TEST_F(RanksOfMpi, PlayRecordedKeysToTheHashOfTheirLogAndOneRankPlaysAlone) {
  const Scene scene = load_scene("arena");
  Playing playing(scene, {"chaser", "random"}, 7, 2.0);
  playing.advance(2.0);
  KeyLog log = key_log_for(scene);
  log.events = playing.keys();
  const std::string file = (folder_ / "game.keys").string();
  write_key_log(std::filesystem::path(file), log);
  for (const int count : {1, 3}) {
    run({{count, peer({"--until", "2", "--keys", file, "--window", "0.07"})}});
    ASSERT_TRUE(ends());
    EXPECT_EQ(report()["hash"], text_of(playing.game().hash())) << launcher_->stderr_tail();
  }
}

TEST_F(RanksOfMpi, WhoHaveAnotherSceneOrOtherTermsAreNamedAndNobodyPlays) {
  run({{2, peer({"--until", "1"})},
       {1, peer({"--until", "1", "--seed", "9"})},
       {1, peer({"--until", "2"})}});
  ASSERT_TRUE(ends());
  EXPECT_EQ(launcher_->ending()->exit_status, static_cast<int>(ExitStatus::not_admitted));
  EXPECT_THAT(
      launcher_->stderr_tail(),
      AllOf(HasSubstr("rank 2 cannot play with rank 0: it has another scene: its fingerprint is"),
            HasSubstr("rank 3 cannot play with rank 0: it is to play 2 s in windows of 0.02 s, "
                      "here it is 1 s in windows of 0.02 s")));
  EXPECT_EQ(test::text_of(output_), "");
}

TEST_F(RanksOfMpi, OneOfAnotherVersionIsNamed) {
  run({{3, peer({"--until", "1"})}, {1, {test::binary_folder() + "/bin/rank-of-another-version"}}});
  ASSERT_TRUE(ends());
  EXPECT_EQ(launcher_->ending()->exit_status, static_cast<int>(ExitStatus::wrong_version));
  EXPECT_THAT(launcher_->stderr_tail(),
              HasSubstr("rank 3 cannot play with rank 0: it speaks version " +
                        std::to_string(peer_protocol_version + 1)));
}

TEST_F(RanksOfMpi, OneThatIsKilledEndsAllWithinFiveSeconds) {
  run({{4, peer({"--until", "80000"})}});
  const pid_t rank = one_of_four_that_play();
  ASSERT_NE(rank, 0) << launcher_->stderr_tail();
  ASSERT_EQ(kill(rank, SIGKILL), 0);
  ASSERT_TRUE(ends(5s));
  EXPECT_NE(launcher_->ending()->exit_status, 0);
  EXPECT_THAT(launcher_->stderr_tail(), HasSubstr("signal 9"));
}

TEST_F(RanksOfMpi, OneThatFallsSilentIsWaitedForWithPatienceThenAllEnd) {
  run({{4, peer({"--until", "80000", "--patience", "1"})}});
  const pid_t rank = one_of_four_that_play();
  ASSERT_NE(rank, 0) << launcher_->stderr_tail();
  ASSERT_EQ(kill(rank, SIGSTOP), 0);
  ASSERT_TRUE(ends(15s));
  EXPECT_EQ(launcher_->ending()->exit_status, static_cast<int>(ExitStatus::connection_lost));
  EXPECT_THAT(launcher_->stderr_tail(), HasSubstr("for 1 s"));
  for (const pid_t other : children_of(launcher_->id())) EXPECT_NE(kill(other, 0), 0);
}

TEST(RankWords, DamagedOnesAreRefusedWhateverIsDamaged) {
  RankWords words;
  words.session_fingerprint = {1, 2, 3}, words.until = 5.0, words.window = 0.02;
  const std::vector<std::uint8_t> good = spoken(words);
  std::vector<std::uint8_t> both = good;
  both.insert(both.end(), good.begin(), good.end());
  EXPECT_TRUE(refused_ranks(both).empty());
  for (std::size_t k = 0; k <= good[0]; ++k) {
    std::vector<std::uint8_t> damaged = both;
    damaged[rank_words + k] ^= 0x80;
    const auto refused = refused_ranks(damaged);
    ASSERT_EQ(refused.size(), 1u) << "byte " << k;
    EXPECT_EQ(refused[0].number, 1u);
  }
}

TEST(PeerWithoutALauncher, RefusesFlagsThatRanksDoNotHave) {
  for (const char* flag : {"--peers", "--join", "--listen"}) {
    Process peer(test::binary_folder() + "/bin/rink-peer",
                 {"--transport", "mpi", "--scene", "arena", flag,
                  std::string(flag) == "--peers" ? "3" : "127.0.0.1:0"},
                 {});
    while (!peer.ending()) peer.attend(10ms);
    EXPECT_EQ(peer.ending()->exit_status, 2);
    EXPECT_THAT(peer.stderr_tail(),
                HasSubstr("with --transport mpi the launcher says how many there are"));
  }
}

TEST(PeerWithoutMpi, SaysWhatToInstall) {
  if (rti::Ranks::is_built_in()) GTEST_SKIP() << "this build has MPI";
  Process peer(test::binary_folder() + "/bin/rink-peer", {"--transport", "mpi", "--scene", "arena"},
               {});
  while (!peer.ending()) peer.attend(10ms);
  EXPECT_EQ(peer.ending()->exit_status, 1);
  EXPECT_THAT(peer.stderr_tail(),
              HasSubstr("this build has no MPI: install libopenmpi-dev and openmpi-bin"));
}

}  // namespace
}  // namespace rink::game
