// What the game's parts assert of each other: a wrong argument ends the program, with the condition
// that it broke.
#include <gtest/gtest.h>

#include "game/control/bat_controller.h"
#include "game/control/game.h"
#include "game/control/match_flow.h"
#include "game/model/time_grid.h"
#include "game/players/steering.h"
#include "tests/game/rink_scenes.h"

namespace rink::game {
namespace {

#ifndef NDEBUG

TEST(GameDeathTest, NamesWhatIsWrongWithInstantsAndPlayers) {
  Game game(small_scene("[[bat]]\nposition = [1.0, 1.0]\nhalf_extent = [0.05, 0.1]\n"));
  game.advance(1.0);
  EXPECT_DEATH(game.submit({0.5, 0, InputKind::key_down, Key::right}), "event.time >= now");
  EXPECT_DEATH(game.advance(0.5), "until >= now");
  EXPECT_DEATH(game.keys_held(1), "player < player_count");
}

TEST(GameDeathTest, NamesWhatIsWrongWithTheFlowOfMatches) {
  MatchFlow flow;
  EXPECT_DEATH(flow.win(Team::left, 1.0), "MatchPhase::playing");
  EXPECT_DEATH(flow.is_here(2), "player < is_here_.size");
  EXPECT_DEATH(MatchFlow({.countdown_s = -1.0}), "times.countdown_s >= 0.0");
}

TEST(GameDeathTest, NamesWhatIsWrongWithHandsAndGrids) {
  EXPECT_DEATH(Hands(Hands::delay_max + 1), "delay <= delay_max");
  EXPECT_DEATH(Hands().wished(0), "age >= 1");
  EXPECT_DEATH(pushed_along(2, 0.0, 1.0, 0.0), "held <= 1");
  EXPECT_DEATH(BatController(-1.0), "thrust >= 0.0");
  EXPECT_DEATH(next_on(0.0, 1.0), "grid > 0.0");
}

#endif

}  // namespace
}  // namespace rink::game
