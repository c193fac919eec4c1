// What is to be seen and heard of a match, from the game itself.
#include "game/match/sight.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "game/control/game.h"
#include "game/match/noises.h"
#include "tests/match/match_scene.h"

namespace rink::game {
namespace {

std::ptrdiff_t pucks_in(const MatchSight& sight) {
  return std::ranges::count(sight.things, physics::BodyKind::puck, &Thing::kind);
}

/// One goal wins. The puck is on its way into the left goal.
Scene last_goal(std::uint32_t goals_to_win) {
  Scene scene = match_scene();
  scene.rules.goals_to_win = goals_to_win;
  scene.bodies.bats[0].body.position = {0.25, 1.0};
  scene.bodies.pucks[0].body.position = {0.3, 0.6};
  scene.bodies.pucks[0].body.velocity = {-2.0, 0.0};
  return scene;
}

TEST(ASight, LosesAPuckThatScoredUntilItsFaceOffButNotTheOneThatWon) {
  for (const std::uint32_t goals_to_win : {1u, 5u}) {
    Game game(last_goal(goals_to_win));
    MatchSight sight;
    GameSight shown;
    shown.show(game, sight);
    EXPECT_EQ(pucks_in(sight), 1);
    game.advance(0.5);
    ASSERT_EQ(game.score().right, 1u);
    shown.show(game, sight);
    EXPECT_EQ(pucks_in(sight), goals_to_win == 1 ? 1 : 0);
    if (goals_to_win == 1) continue;
    game.advance(2.0);
    shown.show(game, sight);
    EXPECT_EQ(pucks_in(sight), 1) << "it is back";
  }
}

/// A puck that turns round at `position`, in a field of 4 by 2 m.
Noise noise_of_an_impact(const Vector2& position, double change) {
  MatchSight sight;
  sight.field.length = 4.0, sight.field.width = 2.0;
  sight.phase = MatchPhase::playing;
  sight.things = {
      {.position = position, .velocity = {0.0, 0.5 * change}, .half_extent = {0.04, 0.04}}};
  NoiseDetector ears;
  ears.listen(sight);
  EXPECT_TRUE(sight.noises.empty());
  sight.things[0].velocity.y() *= -1.0;
  ears.listen(sight);
  EXPECT_EQ(sight.noises.size(), 1u);
  return sight.noises.empty() ? Noise{} : sight.noises.front();
}

TEST(ANoise, ComesFromWhereAlongTheFieldThePuckIsAndIsAsLoudAsItTurned) {
  for (const double x : {0.0, 1.0, 3.0, 4.0})
    for (const double y : {0.1, 1.9})
      EXPECT_EQ(noise_of_an_impact({x, y}, 2.0).place, x / 4.0) << y;
  EXPECT_NEAR(noise_of_an_impact({1.0, 1.0}, 1.5).strength, 0.5, 1e-15);
  EXPECT_EQ(noise_of_an_impact({1.0, 1.0}, 6.0).strength, 1.0);
}

TEST(ANoise, OfAGoalComesFromTheEndWhereItFell) {
  for (const bool is_lefts : {true, false}) {
    MatchSight sight;
    sight.phase = MatchPhase::playing;
    NoiseDetector ears;
    ears.listen(sight);
    (is_lefts ? sight.score.left : sight.score.right) = 1;
    ears.listen(sight);
    ASSERT_EQ(sight.noises.size(), 1u);
    EXPECT_EQ(sight.noises[0].kind, Noise::Kind::goal);
    EXPECT_EQ(sight.noises[0].place, is_lefts ? 1.0 : 0.0)
        << "the left team scores at the right end";
  }
}

}  // namespace
}  // namespace rink::game
