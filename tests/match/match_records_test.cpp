// Records of matches: a file each, small, and a match that goes on where none can be written.
#include "game/control/match_records.h"

#include <gmock/gmock.h>

#include <atomic>
#include <fstream>
#include <set>
#include <thread>

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

/// Whoever is killed between two frames leaves what is in the folder then.
TEST_F(RecordsOfMatches, AreThereAsTheMatchGoesOnButForItsLastSecond) {
  LocalMatch match(match_scene(), {.players = {"chaser", "chaser"}, .scene_text = match_text()});
  MatchRecords records(folder);
  const std::filesystem::path file = folder / "match-1.keys";
  std::set<double> ends;
  for (int frame = 0; frame < 8 * 60; ++frame) {
    const double now_s = 100.0 + frame / 60.0;
    if (frame == 5 * 60 || frame == 7 * 60) match.pause(frame == 5 * 60);
    match.advance(now_s);
    ASSERT_FALSE(records.follow(now_s, [&] { return match.record_so_far(); }));
    const double played_s = match.playing().game().now();
    if (played_s < MatchRecords::period_s) continue;
    const KeyLog log = read_key_log(file);
    EXPECT_GE(*log.until, played_s - MatchRecords::period_s - 1e-9);
    if (ends.insert(*log.until).second) {
      EXPECT_TRUE(is_replayed(log)) << *log.until;
    }
  }
  EXPECT_THAT(ends.size(), testing::AllOf(testing::Ge(2u), testing::Le(8u)))
      << "once a second, and never in the pause";
  match.finish();
  EXPECT_FALSE(match.record_so_far());
  const KeyLog whole = match.take_finished().at(0);
  EXPECT_EQ(records.write(whole), file);
  EXPECT_EQ(read_key_log(file).hash, whole.hash);
  EXPECT_EQ(records.write(whole), folder / "match-2.keys") << "the next match's";
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    EXPECT_THAT(entry.path().filename().string(), testing::StartsWith("match-"));
}

TEST_F(RecordsOfMatches, OfManyWritersInOneFolderAreAllKept) {
  const KeyLog log = local_match(1.0);
  constexpr int writers = 4, matches = 30;
  std::vector<std::thread> threads;
  std::atomic<int> failures = 0;
  for (int i = 0; i < writers; ++i)
    threads.emplace_back([&] {
      MatchRecords records(folder);
      for (int match = 0; match < matches; ++match)
        for (double now_s = 10.0 * match; now_s < 10.0 * match + 3.0; ++now_s) {
          const auto so_far = [&] {
            KeyLog part = log;
            part.until = *log.until + now_s;  // something new
            return part;
          };
          failures += records.follow(now_s, so_far).has_value();
          if (now_s == 10.0 * match + 2.0) failures += records.keep(log).has_value();
        }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(failures, 0);
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    ++count;
    EXPECT_EQ(read_key_log(entry.path()).hash, log.hash) << entry.path();
  }
  EXPECT_EQ(count, writers * matches);
}

/// A reader beside the writer, as somebody who copies records while a server runs.
TEST_F(RecordsOfMatches, AreWholeWheneverTheyAreThere) {
  const KeyLog log = local_match(1.0);
  constexpr int count = 200;
  std::atomic<bool> is_written = false;
  std::thread writer([&] {
    MatchRecords records(folder);
    for (int number = 1; number <= count; ++number) records.write(log);
    is_written = true;
  });
  for (int number = 1; number <= count;) {
    const std::filesystem::path file = folder / ("match-" + std::to_string(number) + ".keys");
    const bool was_written = is_written;
    if (std::filesystem::exists(file)) {
      EXPECT_NO_THROW(EXPECT_EQ(read_key_log(file).hash, log.hash)) << file;
      ++number;
    } else if (was_written) {
      ADD_FAILURE() << file << " is not there";
      break;
    }
  }
  writer.join();
}

TEST_F(RecordsOfMatches, ThatGoOnInOneFolderNeverTakeEachOthersFile) {
  const KeyLog one = local_match(1.0), two = local_match(2.0);
  MatchRecords first(folder), second(folder);
  EXPECT_FALSE(first.follow(0.0, [&] { return one; }));
  EXPECT_FALSE(second.follow(0.0, [&] { return two; }));
  EXPECT_EQ(second.write(two), folder / "match-2.keys");
  EXPECT_EQ(first.write(one), folder / "match-1.keys");
  EXPECT_EQ(read_key_log(folder / "match-1.keys").hash, one.hash);
  EXPECT_EQ(read_key_log(folder / "match-2.keys").hash, two.hash);
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
