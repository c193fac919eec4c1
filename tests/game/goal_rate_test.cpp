// How many goals a match has in a minute: enough for people to keep watching, whoever plays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "game/control/goal_rate.h"
#include "game/control/playing.h"
#include "tests/game/rink_scenes.h"

namespace rink::game {
namespace {

constexpr const char *expert = "chaser-expert", *club = "chaser", *beginner = "chaser-beginner",
                     *nobody = Playing::nobody;

GoalRate rate_of(const char* scene, const char* left, const char* right, std::uint32_t games = 30) {
  return goal_rate(preset(scene), {.players = {left, right}, .games = games});
}

TEST(GoalRate, OfAMatchBetweenEqualsIsFourToTwelveAMinute) {
  for (const char* player : {expert, club, beginner}) {
    const GoalRate rate = rate_of("match", player, player);
    const double goals = rate.left_per_min + rate.right_per_min;
    EXPECT_GT(goals - rate.error_per_min, 4.0) << player;
    EXPECT_LT(goals + rate.error_per_min, 12.0) << player;
    EXPECT_LT(rate.serves_per_min, 0.5) << player << ": bots shoot before their time is over";
  }
}

TEST(GoalRate, OfAMatchAgainstNobodyIsNotNone) {
  for (const char* player : {expert, beginner}) {
    const GoalRate rate = rate_of("match", player, nobody);
    EXPECT_GT(rate.left_per_min, 1.0) << player;
    EXPECT_GT(rate.serves_per_min, 0.5) << player << ": the puck comes back from where nobody is";
  }
  const GoalRate slow = rate_of("paper", expert, nobody);
  EXPECT_LT(slow.left_per_min, 1.0);
  EXPECT_EQ(slow.serves_per_min, 0.0);
}

TEST(GoalRate, TellsAnExpertFromABeginner) {
  const GoalRate rate = rate_of("match", expert, beginner);
  EXPECT_GT(rate.left_per_min, 2.0 * rate.right_per_min);
  const GoalRate turned = rate_of("match", beginner, expert);
  EXPECT_GT(turned.right_per_min, 2.0 * turned.left_per_min);
}

TEST(GoalRate, IsThatOfItsSeed) {
  const GoalRatePlan plan{.players = {club, beginner}, .games = 3, .seconds = 20.0, .seed = 5};
  GoalRatePlan other = plan;
  other.seed = 6;
  const Scene scene = preset("match");
  EXPECT_EQ(goal_rate(scene, plan).hash, goal_rate(scene, plan).hash);
  EXPECT_NE(goal_rate(scene, plan).hash, goal_rate(scene, other).hash);
}

}  // namespace
}  // namespace rink::game
