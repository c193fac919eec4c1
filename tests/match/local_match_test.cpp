// A match at one keyboard, its record, and what is seen of the record.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

#include "game/control/key_log_file.h"
#include "game/control/replay.h"
#include "game/match/local_match.h"
#include "game/match/replay_match.h"
#include "tests/match/match_scene.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

void play(MatchSource& match, double& now_s, double seconds) {
  for (const double until = now_s + seconds; now_s < until;) match.advance(now_s += 1.0 / 60.0);
}

/// A match between two bots, played to its end once for all tests.
const KeyLog& played_match() {
  static const KeyLog log = [] {
    LocalMatch match(match_scene(),
                     {.players = {"chaser", "chaser-expert"}, .scene_text = match_text()});
    double now_s = 100.0;
    while (match.sight().phase != MatchPhase::over && now_s < 1000.0) play(match, now_s, 1.0);
    EXPECT_TRUE(match.sight().winner);
    std::vector<KeyLog> records = match.take_finished();
    EXPECT_EQ(records.size(), 1u);
    return records.at(0);
  }();
  return log;
}

std::string text_of(const KeyLog& log) {
  std::ostringstream stream;
  write_key_log(stream, log);
  return stream.str();
}

/// A file match.keys that holds `text`.
struct KeyFile {
  explicit KeyFile(const std::string& text) { std::ofstream(path) << text; }
  test::TemporaryFolder folder{"match"};
  std::string path = (folder / "match.keys").string();
};

std::string complaint_about(const std::string& text) {
  try {
    const KeyFile file(text);
    ReplayMatch replay(file.path);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(ALocalMatch, IsCountedDownPlayedByTwoHandsAndPaused) {
  LocalMatch match(match_scene(), {.scene_text = match_text()});
  double now_s = 5.0;
  EXPECT_EQ(match.hand_count(), 2u);
  play(match, now_s, 2.0);
  EXPECT_EQ(match.sight().phase, MatchPhase::countdown);
  EXPECT_EQ(match.sight().time, 0.0);
  play(match, now_s, 2.0);
  EXPECT_EQ(match.sight().phase, MatchPhase::playing);
  const auto right_bat = [&] {
    return std::ranges::find_if(match.sight().things,
                                [](const Thing& thing) {
                                  return thing.kind == physics::BodyKind::bat &&
                                         thing.team == Team::right;
                                })
        ->position;
  };
  const Vector2 before = right_bat();
  match.press(1, Key::up, true);
  play(match, now_s, 0.2);
  EXPECT_GT(right_bat().y(), before.y() + 0.1);
  match.pause(true);
  play(match, now_s, 0.1);
  const double time = match.sight().time;
  play(match, now_s, 3.0);
  EXPECT_EQ(match.sight().phase, MatchPhase::paused);
  EXPECT_EQ(match.sight().time, time);
}

TEST(ALocalMatch, IsRecordedInAFewKilobytesAndReplaysToTheSameHash) {
  const KeyLog& log = played_match();
  EXPECT_LT(text_of(log).size(), 3'000u + 40u * log.events.size())
      << "bots press fourteen keys a second between them; people far fewer";
  EXPECT_EQ(replay(log, match_scene()), *log.hash);
}

TEST(ALocalMatch, MakesItsNoises) {
  LocalMatch match(match_scene(), {.players = {"chaser", "chaser"}, .scene_text = match_text()});
  std::array<int, 8> heard{};
  double now_s = 0.0;
  for (int frame = 0; frame < 60 * 60; ++frame) {
    match.advance(now_s += 1.0 / 60.0);
    for (const Noise& noise : match.sight().noises) ++heard[static_cast<std::size_t>(noise.kind)];
  }
  EXPECT_GE(heard[static_cast<std::size_t>(Noise::Kind::count)], 2);
  EXPECT_EQ(heard[static_cast<std::size_t>(Noise::Kind::face_off)], 1);
  EXPECT_GT(heard[static_cast<std::size_t>(Noise::Kind::puck_on_wall)], 5);
  EXPECT_GT(heard[static_cast<std::size_t>(Noise::Kind::puck_on_bat)], 2);
  EXPECT_EQ(heard[static_cast<std::size_t>(Noise::Kind::goal)],
            static_cast<int>(match.sight().score.left + match.sight().score.right));
}

TEST(ARecordedMatch, IsTheSameHoweverOneGetsToAnInstant) {
  const KeyLog& log = played_match();
  Replay replay(log, match_scene());
  std::vector<std::uint64_t> hashes;
  for (int k = 0; 1.7 * k < replay.end(); ++k) {
    replay.seek(1.7 * k);
    hashes.push_back(replay.game().hash());
  }
  replay.seek(replay.end());
  EXPECT_EQ(replay.is_as_recorded(), true);
  for (std::size_t k = hashes.size(); k-- > 0;) {
    replay.seek(1.7 * static_cast<double>(k));
    EXPECT_EQ(replay.game().hash(), hashes[k]) << k;
  }
  replay.seek(3.3), replay.seek(1e9);
  EXPECT_EQ(replay.game().hash(), *log.hash);
}

TEST(ARecordedMatch, IsWatchedSlowlyStoppedAndSoughtIn) {
  const KeyFile file(text_of(played_match()));
  ReplayMatch match(file.path);
  double now_s = 50.0;
  match.advance(now_s);
  play(match, now_s, 2.0);
  EXPECT_NEAR(match.sight().time, 2.0, 0.02);
  match.set_speed(0.25);
  play(match, now_s, 2.0);
  EXPECT_NEAR(match.sight().time, 2.5, 0.03);
  match.pause(true);
  play(match, now_s, 2.0);
  EXPECT_NEAR(match.sight().time, 2.5, 0.03);
  EXPECT_EQ(match.sight().phase, MatchPhase::playing)
      << "nothing is laid over what was stopped to be looked at";
  match.pause(false);
  match.seek(1.0);
  match.advance(now_s += 0.01);
  EXPECT_EQ(match.sight().time, 1.0);
  match.seek(match.end());
  match.advance(now_s += 0.01);
  EXPECT_EQ(match.sight().phase, MatchPhase::over);
  EXPECT_TRUE(match.sight().winner);
  EXPECT_TRUE(match.sight().notice.empty());
}

TEST(ARecordedMatch, ThatWasTruncatedAlteredOrIsOfAnotherVersionIsRefusedWithTheReason) {
  const std::string text = text_of(played_match());
  EXPECT_NE(complaint_about(text.substr(0, text.size() / 2)).find("match.keys"), std::string::npos);
  EXPECT_NE(complaint_about(text.substr(0, text.rfind("end"))).find("cut off"), std::string::npos);
  std::string altered = text;
  altered.replace(altered.find(" 1 down"), 7, " 0 down");
  EXPECT_NE(complaint_about(altered).find("altered"), std::string::npos);
  EXPECT_NE(complaint_about("rink-keys 9" + text.substr(text.find('\n'))).find("rink-keys 1"),
            std::string::npos);
  EXPECT_NE(complaint_about("").find("expected"), std::string::npos);
}

}  // namespace
}  // namespace rink::game
