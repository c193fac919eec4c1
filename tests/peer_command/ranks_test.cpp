// Peers as ranks of MPI, started by mpirun on this machine with more ranks than processors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "game/control/game.h"
#include "game/control/key_log_file.h"
#include "game/control/playing.h"
#include "game/model/scene_file.h"
#include "game/net/exit_status.h"
#include "game/net/peer/ranks/rank_words.h"
#include "tests/peer_command/rank_processes.h"
#include "tests/peer_command/uneven_scene.h"

namespace rink::game {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string text_of(std::uint64_t hash) {
  char text[32];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

class RanksOfMpi : public RankProcesses {
 protected:
  static Words peer(Words arguments) {
    return with_program(std::move(arguments), "rink-peer", {"--scene", "arena"});
  }
  nlohmann::json report() const {
    return nlohmann::json::parse(test::text_of(output_), nullptr, false);
  }
  pid_t one_of_four_that_play() { return RankProcesses::one_of_four_that_play("rink-peer"); }
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

TEST_F(RanksOfMpi, ShiftZonesTowardEqualLoad) {
  const std::string file = (folder_ / "uneven.toml").string();
  std::ofstream(file) << uneven_scene();
  Game one(load_scene(file));
  one.advance(2.0);
  run({{3, with_program({"--until", "2"}, "rink-peer", {"--scene", file})}});
  ASSERT_TRUE(ends());
  EXPECT_EQ(report()["hash"], text_of(one.hash())) << launcher_->stderr_tail();
  EXPECT_GT(report()["ranks"][0]["shifts"], 0);
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
  for (const pid_t other : children_of(launcher_->id(), "rink-peer")) EXPECT_NE(kill(other, 0), 0);
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
