// The rules around a match, arrow by arrow.
#include <gtest/gtest.h>

#include "game/control/match_flow.h"
#include "tests/match/match_scene.h"

namespace rink::game {
namespace {

class AMatch : public testing::Test {
 protected:
  void TearDown() override { flow.check(); }
  MatchPhase phase() const { return flow.state().phase; }
  void start() {
    flow.enter(0, 10.0);
    flow.enter(1, 20.0);
    flow.advance(23.0);
  }
  MatchFlow flow;
};

TEST_F(AMatch, WaitsForBothAndBeginsAfterACountdown) {
  EXPECT_EQ(phase(), MatchPhase::waiting);
  flow.enter(0, 10.0);
  EXPECT_EQ(phase(), MatchPhase::waiting);
  flow.enter(1, 20.0);
  EXPECT_EQ(phase(), MatchPhase::countdown);
  EXPECT_EQ(flow.state().until_s, 23.0);
  flow.advance(22.999);
  EXPECT_FALSE(flow.runs());
  flow.advance(23.01);
  EXPECT_TRUE(flow.runs());
  EXPECT_EQ(flow.state().number, 1u);
}

TEST_F(AMatch, BeginsAtTheVeryEndOfItsCountdownHoweverLateThatIsNoticed) {
  flow.enter(0, 10.0), flow.enter(1, 20.0);
  EXPECT_EQ(simulated_at(flow.state(), 23.25), 0.25) << "it is foreseen";
  flow.advance(23.7);
  EXPECT_EQ(simulated_at(flow.state(), 23.25), 0.25);
}

TEST_F(AMatch, StandsStillWhilePausedAndGoesOnAfterACountdown) {
  start();
  flow.pause(true, 25.0);
  EXPECT_EQ(phase(), MatchPhase::paused);
  EXPECT_EQ(simulated_at(flow.state(), 99.0), 2.0);
  flow.pause(false, 100.0);
  EXPECT_EQ(phase(), MatchPhase::countdown);
  flow.advance(103.5);
  EXPECT_EQ(simulated_at(flow.state(), 103.5), 2.5);
  EXPECT_EQ(flow.state().number, 1u);
}

TEST_F(AMatch, GivesWhoLeftThirtySecondsToComeBack) {
  start();
  flow.leave(1, 30.0);
  EXPECT_EQ(phase(), MatchPhase::away);
  EXPECT_EQ(simulated_at(flow.state(), 45.0), 7.0) << "the match stands still at where it was left";
  flow.advance(59.9);
  EXPECT_EQ(phase(), MatchPhase::away);
  flow.advance(59.9);
  EXPECT_EQ(phase(), MatchPhase::away);
  flow.enter(1, 59.95);
  EXPECT_EQ(phase(), MatchPhase::countdown);
  flow.advance(63.0);
  EXPECT_TRUE(flow.runs());
  EXPECT_EQ(flow.state().number, 1u) << "it is the same match";
  EXPECT_NEAR(simulated_at(flow.state(), 63.0), 7.0 + (63.0 - (59.95 + 3.0)), 1e-12)
      << "and goes on there";
}

TEST_F(AMatch, IsWonByWhoStaysIfTheOtherDoesNotComeBack) {
  start();
  flow.leave(0, 30.0);
  flow.advance(60.0);
  EXPECT_EQ(phase(), MatchPhase::over);
  EXPECT_EQ(flow.state().winner, Team::right);
  flow.enter(0, 70.0);
  EXPECT_EQ(phase(), MatchPhase::countdown) << "somebody new plays anew";
  EXPECT_EQ(flow.state().number, 2u);
}

TEST_F(AMatch, IsFollowedByAnotherOnlyIfBothAsk) {
  start();
  flow.win(Team::left, 40.0);
  EXPECT_EQ(phase(), MatchPhase::over);
  flow.ask_rematch(0, 41.0), flow.ask_rematch(0, 42.0);
  EXPECT_EQ(phase(), MatchPhase::over);
  EXPECT_TRUE(flow.state().wants_rematch[0]);
  flow.ask_rematch(1, 43.0);
  EXPECT_EQ(phase(), MatchPhase::countdown);
  EXPECT_EQ(flow.state().number, 2u);
  EXPECT_EQ(simulated_at(flow.state(), 44.0), 0.0);
  EXPECT_FALSE(flow.state().winner || flow.state().wants_rematch[0] ||
               flow.state().wants_rematch[1]);
}

TEST_F(AMatch, CannotBeRematchedPausedOrResumedWhenThatMeansNothing) {
  flow.ask_rematch(0, 1.0), flow.pause(true, 2.0), flow.pause(false, 3.0);
  EXPECT_EQ(phase(), MatchPhase::waiting);
  start();
  flow.ask_rematch(0, 24.0), flow.ask_rematch(1, 24.0), flow.pause(false, 24.0);
  EXPECT_TRUE(flow.runs());
  flow.win(Team::left, 40.0);
  flow.pause(true, 41.0);
  EXPECT_EQ(phase(), MatchPhase::over);
}

TEST_F(AMatch, GoesOnAfterACountdownFromWhereItsHostStoodStill) {
  start();
  const double began_s = flow.state().clock_real_s;
  flow.stand_still(began_s + 2.0, began_s + 12.0);
  EXPECT_EQ(phase(), MatchPhase::countdown);
  EXPECT_EQ(flow.state().until_s, began_s + 15.0);
  EXPECT_EQ(simulated_at(flow.state(), began_s + 14.9), 2.0);
  flow.advance(began_s + 16.0);
  EXPECT_TRUE(flow.runs());
  EXPECT_EQ(simulated_at(flow.state(), began_s + 16.0), 3.0) << "ten seconds and a countdown later";
}

TEST_F(AMatch, GivesAnAbsentPlayerTheTimeInWhichItsHostStoodStill) {
  start();
  flow.leave(0, 30.0);
  const double until_s = flow.state().until_s;
  flow.stand_still(31.0, 61.0);
  flow.advance(until_s + 29.0);
  EXPECT_EQ(phase(), MatchPhase::away);
  flow.advance(until_s + 30.0);
  EXPECT_EQ(phase(), MatchPhase::over);
}

TEST_F(AMatch, CountsItsCountdownAnewAfterItsHostStoodStill) {
  flow.enter(0, 1.0), flow.enter(1, 2.0);
  flow.stand_still(3.0, 20.0);
  EXPECT_EQ(phase(), MatchPhase::countdown);
  EXPECT_EQ(flow.state().until_s, 23.0);
}

TEST_F(AMatch, WaitsAgainWhenAllHaveLeftOrOneLeavesAfterTheEnd) {
  start();
  flow.leave(0, 30.0), flow.leave(1, 31.0);
  EXPECT_EQ(phase(), MatchPhase::waiting);
  flow.enter(1, 40.0), flow.enter(0, 41.0);
  EXPECT_EQ(flow.state().number, 2u);
  flow.win(Team::left, 50.0);
  flow.leave(1, 51.0);
  EXPECT_EQ(phase(), MatchPhase::waiting);
}

TEST(AScene, IsOneForAMatchOrSaysWhyNot) {
  Scene scene = match_scene();
  EXPECT_FALSE(match_objection(scene));
  scene.rules.goals_to_win.reset();
  EXPECT_NE(match_objection(scene)->find("goals_to_win"), std::string::npos);
  scene = match_scene();
  std::swap(scene.bodies.bats[0], scene.bodies.bats[1]);
  EXPECT_NE(match_objection(scene)->find("two bats"), std::string::npos);
}

}  // namespace
}  // namespace rink::game
