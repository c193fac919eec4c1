// A match at one keyboard from countdown to rematch, on real time that the test hands in.
#include "game/match/local_match.h"

#include <gmock/gmock.h>

#include "game/model/scene_file.h"
#include "tests/places.h"

namespace rink::game {
namespace {

constexpr double frame = 1.0 / 60.0;

Scene match_scene() { return load_scene(test::source_folder() + "/scenes/paper.toml"); }

class LocalMatches : public ::testing::Test {
 protected:
  void frames(MatchSource& match, int count) {
    for (int i = 0; i < count; ++i) match.advance(now_ += frame);
  }
  template <class Condition>
  bool wait(MatchSource& match, double most_s, const Condition& condition) {
    for (double end = now_ + most_s; now_ < end && !condition();) frames(match, 1);
    return condition();
  }
  double now_ = 100.0;
};

TEST_F(LocalMatches, CountDownWhileTheGameStandsStill) {
  LocalMatch match(match_scene(), {});
  frames(match, 1);
  EXPECT_EQ(match.sight().phase, MatchPhase::countdown);
  EXPECT_EQ(match.sight().time, 0.0);
  frames(match, 170);
  EXPECT_EQ(match.sight().time, 0.0);
  frames(match, 30);
  EXPECT_EQ(match.sight().phase, MatchPhase::playing);
  EXPECT_GT(match.sight().time, 0.0);
}

TEST_F(LocalMatches, MoveTheBatInTheFrameAfterTheKey) {
  LocalMatch match(match_scene(), {.times = {.countdown_s = 0.0}});
  frames(match, 3);
  const auto bat = [&] {
    return *std::ranges::find_if(match.sight().things, [](const Thing& thing) {
      return thing.kind == physics::BodyKind::bat && thing.team == Team::right;
    });
  };
  const double before = bat().position.y();
  match.press(1, Key::up, true);
  frames(match, 2);
  const double after_one_frame =
      0.5 * 8.0 * frame * frame;  // thrust of the scene; drag takes a few per cent
  EXPECT_NEAR(bat().position.y() - before, after_one_frame, 0.05 * after_one_frame);
}

TEST_F(LocalMatches, TakeNoSimulatedTimeForAPauseAndCountDownAfterIt) {
  LocalMatch match(match_scene(), {.times = {.countdown_s = 0.5}});
  frames(match, 60);
  match.pause(true);
  frames(match, 1);
  const double stopped = match.sight().time;
  frames(match, 600);
  EXPECT_EQ(match.sight().phase, MatchPhase::paused);
  EXPECT_EQ(match.sight().time, stopped);
  match.pause(false);
  frames(match, 10);
  EXPECT_EQ(match.sight().phase, MatchPhase::countdown);
  frames(match, 40);
  EXPECT_EQ(match.sight().phase, MatchPhase::playing);
  EXPECT_LT(match.sight().time, stopped + 40 * frame);
}

TEST_F(LocalMatches, AreWonByTheFifthGoalAndPlayedAgainWhenAsked) {
  LocalMatch match(match_scene(), {.players = {"chaser-expert", "chaser-beginner"},
                                   .times = {.countdown_s = 0.0}});
  ASSERT_TRUE(wait(match, 900.0, [&] { return match.sight().phase == MatchPhase::over; }));
  const Score score = match.sight().score;
  EXPECT_EQ(std::max(score.left, score.right), 5u);
  EXPECT_EQ(match.sight().winner, score.left == 5 ? Team::left : Team::right);
  match.rematch();
  frames(match, 2);
  EXPECT_EQ(match.sight().phase, MatchPhase::playing);
  EXPECT_EQ(match.sight().score, (Score{0, 0}));
  EXPECT_LT(match.sight().time, 0.1);
}

/// What hands pressed is in the keys, so that a log of them is the match.
TEST_F(LocalMatches, CanBePlayedAgainFromTheirKeys) {
  LocalMatch match(match_scene(),
                   {.players = {Playing::hand, "chaser"}, .times = {.countdown_s = 0.0}});
  frames(match, 2);
  for (int i = 0; i < 40; ++i) {
    match.press(0, static_cast<Key>(i % 4), i % 3 != 0);
    frames(match, 7);
  }
  Game again(match_scene());
  for (const InputEvent& event : match.playing().keys()) again.submit(event);
  again.advance(match.playing().game().now());
  EXPECT_EQ(again.hash(), match.playing().game().hash());
}

TEST_F(LocalMatches, GoOnAfterAFrameThatTookLongWithoutAJump) {
  LocalMatch match(match_scene(), {.times = {.countdown_s = 0.0}});
  frames(match, 10);
  const double before = match.sight().time;
  match.advance(now_ += 20.0);
  EXPECT_LE(match.sight().time, before + LocalMatch::frame_max_s + 1e-9);
}

}  // namespace
}  // namespace rink::game
