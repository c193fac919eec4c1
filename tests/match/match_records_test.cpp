// Records of matches: a file each, small, and a match that goes on where none can be written.
#include "game/control/match_records.h"

#include <gmock/gmock.h>

#include <fstream>

#include "game/control/key_log_file.h"
#include "game/control/replay.h"
#include "game/match/local_match.h"
#include "game/match/replay_match.h"
#include "loadgen/duel/duel.h"
#include "tests/match/match_scene.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

using testing::HasSubstr;

struct RecordsOfMatches : testing::Test {
  /// Two of `player` over a network for `seconds`.
  static KeyLog hosted_match(const std::string& player, double seconds) {
    loadgen::Duel duel(rink_fom(), match_scene(), match_text(),
                       {.delay_s = 0.02, .players = {player, player}});
    duel.connect(0), duel.connect(1);
    duel.run_until([&] { return duel.server().game().now() >= seconds; }, seconds + 10.0);
    duel.server().finish_record();
    return duel.server().hosted()->take_finished().at(0);
  }
  static KeyLog local_match(double seconds) {
    LocalMatch match(match_scene(), {.players = {"hand", "chaser"}, .scene_text = match_text()});
    for (int frame = 0; frame < static_cast<int>(60.0 * (seconds + 3.0)); ++frame) {
      if (frame % 7 == 0) match.press(0, Key::up, frame % 14 == 0);
      match.advance(100.0 + frame / 60.0);
    }
    match.finish();
    return match.take_finished().at(0);
  }
  static bool is_replayed(const KeyLog& log) {
    return replay(log, recorded_scene(log, "match.keys")) == *log.hash;
  }

  test::TemporaryFolder temporary{"records"};
  const std::filesystem::path folder = temporary / "matches";
};

TEST_F(RecordsOfMatches, OfFortySecondsTakeAFewKilobytesAndReplayToTheSameHash) {
  MatchRecords records(folder);
  for (const KeyLog& log :
       {hosted_match("waypoint", 40.0), hosted_match("chaser", 40.0), local_match(40.0)}) {
    const std::filesystem::path file = records.write(log);
    const auto keys = static_cast<double>(log.events.size());
    EXPECT_GT(keys, 100.0) << "or the test shows nothing";
    EXPECT_LE(static_cast<double>(std::filesystem::file_size(file)),
              200.0 + static_cast<double>(log.scene_text.size()) + 4.0 * keys);
    EXPECT_LE(std::filesystem::file_size(file), 7000u);
    const KeyLog read = read_key_log(file);
    EXPECT_TRUE(is_replayed(read));
    ReplayMatch match(file);
    match.seek(match.end());
    match.advance(1.0);
    EXPECT_EQ(match.sight().notice, "");
    EXPECT_EQ(match.sight().time, *log.until);
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "match-3.keys"));
}

TEST_F(RecordsOfMatches, ThatCannotBeWrittenAreComplainedOfOnceUntilTheyCanAgain) {
  std::ofstream(folder) << "this is a file";  // where the folder should be
  MatchRecords records(folder);
  const KeyLog log = local_match(1.0);
  EXPECT_THAT(records.keep(log).value_or(""),
              HasSubstr(folder.string() + ": this folder for records of matches cannot be made"));
  EXPECT_TRUE(records.is_failing());
  EXPECT_FALSE(records.keep(log)) << "it was said";
  EXPECT_TRUE(records.is_failing());
  std::filesystem::remove(folder);
  EXPECT_FALSE(records.keep(log));
  EXPECT_FALSE(records.is_failing());
  EXPECT_TRUE(std::filesystem::exists(folder / "match-1.keys"));
  std::filesystem::remove_all(folder);
  std::ofstream(folder) << "again";
  EXPECT_TRUE(records.keep(log));
}

TEST_F(RecordsOfMatches, ThatCannotBeWrittenAreMissedOnBothScreensBetweenMatches) {
  loadgen::Duel duel(rink_fom(), match_scene(), match_text(), {.times = {.patience_s = 1.0}});
  duel.connect(0), duel.connect(1);
  const auto is_shown = [&](MatchPhase phase) {
    return duel.run_until([&] { return duel.client(0).sight().phase == phase; }, 5.0);
  };
  ASSERT_TRUE(is_shown(MatchPhase::playing));
  duel.run(1.0);
  EXPECT_EQ(duel.client(0).sight().notice, "");
  duel.leave(1);
  ASSERT_TRUE(is_shown(MatchPhase::over));
  EXPECT_EQ(duel.server().hosted()->take_finished().size(), 1u);
  duel.server().hosted()->set_unrecorded(true);
  duel.run(0.2);
  EXPECT_THAT(duel.client(0).sight().notice, HasSubstr("could not record"));
  duel.connect(1);
  ASSERT_TRUE(is_shown(MatchPhase::playing));
  EXPECT_EQ(duel.client(0).sight().notice, "") << "who plays is not disturbed";
  EXPECT_EQ(duel.client(1).sight().phase, MatchPhase::playing);
}

}  // namespace
}  // namespace rink::game
