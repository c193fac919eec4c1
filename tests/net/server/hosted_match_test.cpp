// A hosted match from the first player to the record of the last goal, without a federation.
#include "game/net/server/hosted_match.h"

#include <gtest/gtest.h>

#include "game/model/scene_file.h"
#include "game/model/time_grid.h"
#include "tests/places.h"

namespace rink::game {
namespace {

struct Evening {
  std::string text = scene_text(test::source_folder() + "/scenes/match.toml");
  Scene scene = parse_scene(text, "match.toml");
  HostedMatch match{{.times = {.countdown_s = 3.0, .patience_s = 5.0}, .scene_text = text}, scene};
  Game game{scene};

  /// Both are there at 1 s, so the match is on from 4 s.
  Evening() {
    match.enter(0, 0.5);
    match.enter(1, 1.0);
  }
  void follow(double now_s) {
    if (match.advance(now_s)) game = match.begin(game);
    game.advance(match.goal(now_s, game.now()));
    match.judge(game);
  }
};

TEST(AHostedMatch, StandsStillUntilItsCountdownIsOver) {
  Evening evening;
  evening.follow(2.0);
  EXPECT_EQ(evening.match.state().phase, MatchPhase::countdown);
  EXPECT_EQ(evening.match.state().number, 1u);
  EXPECT_EQ(evening.game.now(), 0.0);
  EXPECT_EQ(evening.match.simulated(4.5), 0.5) << "the end is foreseen";
  evening.follow(4.7501);
  EXPECT_EQ(evening.match.state().phase, MatchPhase::playing);
  EXPECT_EQ(evening.game.now(), last_on(tick_grid, 0.7501));
}

TEST(AHostedMatch, GoesOnFromWhereAGameThatHasTooMuchToDoHasCome) {
  Evening evening;
  evening.follow(4.75);
  evening.match.fall_behind(5.0, evening.game.now());
  EXPECT_EQ(evening.match.simulated(5.0), evening.game.now());
  EXPECT_EQ(evening.match.simulated(5.5), evening.game.now() + 0.5);
  evening.follow(5.5);
  EXPECT_EQ(evening.game.now(), last_on(tick_grid, 1.25));
}

TEST(AHostedMatch, LeavesOutTheTimeInWhichItsHostStoodStill) {
  Evening evening;
  evening.match.pass(4.75);
  evening.follow(4.75);
  const double played = evening.game.now();
  evening.match.pass(14.75);  // nothing was done for ten seconds
  EXPECT_EQ(evening.match.simulated(14.75), 0.75) << "also of a key that comes first";
  evening.follow(14.75);
  EXPECT_EQ(evening.match.state().phase, MatchPhase::countdown);
  EXPECT_EQ(evening.game.now(), played);
  for (double now_s = 15.0; now_s <= 18.75; now_s += 0.25) {
    evening.match.pass(now_s);
    evening.follow(now_s);
  }
  EXPECT_EQ(evening.game.now(), last_on(tick_grid, 1.75));
}

TEST(AHostedMatch, PlaysOnThroughASecondInWhichNothingWasDone) {
  Evening evening;
  evening.match.pass(4.75);
  evening.follow(4.75);
  evening.match.pass(4.75 + HostedMatch::stood_still_s);
  evening.follow(4.75 + HostedMatch::stood_still_s);
  EXPECT_EQ(evening.match.state().phase, MatchPhase::playing);
  EXPECT_EQ(evening.game.now(), last_on(tick_grid, 1.75));
}

TEST(AHostedMatch, FeelsKeysFromTheCountdownOn) {
  const Evening evening;
  EXPECT_TRUE(evening.match.are_keys_felt());
  HostedMatch waiting({}, evening.scene);
  EXPECT_FALSE(waiting.are_keys_felt());
}

TEST(AHostedMatch, IsRecordedOnceWhenItIsGivenUp) {
  Evening evening;
  evening.follow(2.0);
  EXPECT_FALSE(evening.match.record_so_far(evening.game, {})) << "nothing was played yet";
  evening.follow(5.0);
  ASSERT_TRUE(evening.match.record_so_far(evening.game, {}));
  evening.match.finish(evening.game, {});
  evening.match.finish(evening.game, {});
  EXPECT_FALSE(evening.match.record_so_far(evening.game, {}));
  const std::vector<KeyLog> records = evening.match.take_finished();
  ASSERT_EQ(records.size(), 1u);
  EXPECT_EQ(records[0].hash, evening.game.hash());
  EXPECT_EQ(records[0].scene_text, evening.text);
  EXPECT_TRUE(evening.match.take_finished().empty());
}

TEST(AHostedMatch, CountsTheTimeOfTheMatchesBeforeIt) {
  Evening evening;
  evening.follow(2.0);
  evening.follow(6.0);
  const double played = evening.game.now();
  ASSERT_GT(played, 0.0);
  EXPECT_EQ(evening.match.earlier_s(), 0.0);
  evening.match.leave(1, 6.0);
  evening.follow(12.0);  // patience is over, so who comes next begins another match
  evening.match.enter(1, 13.0);
  evening.follow(13.5);
  EXPECT_EQ(evening.match.state().number, 2u);
  EXPECT_EQ(evening.match.earlier_s(), played);
  EXPECT_EQ(evening.game.now(), 0.0);
}

TEST(AHostedMatch, TellsThatItCouldNotBeRecorded) {
  Evening evening;
  EXPECT_FALSE(evening.match.state().is_unrecorded);
  evening.match.set_unrecorded(true);
  EXPECT_TRUE(evening.match.state().is_unrecorded);
}

}  // namespace
}  // namespace rink::game
