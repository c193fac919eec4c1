// Games under a limit to their events: they stop in the middle of an instant if need be, and go on
// to the same game.
#include <gtest/gtest.h>

#include "game/control/game.h"
#include "game/control/game_state.h"
#include "game/control/playing.h"
#include "game/control/replay.h"
#include "tests/game/rink_scenes.h"

namespace rink::game {
namespace {

/// Goes to `until` however often it is stopped; how often that was.
template <class Played>
int advance_in_parts(Played& played, double until, physics::EventBudget& budget) {
  int stops = 0;
  for (; !played.advance(until, budget); ++stops) budget.grant(2);
  return stops;
}

TEST(GameBudget, KeysGoalsAndFaceOffsComeAsIfItHadNotStopped) {
  Scene scene = preset("match");
  scene.keys = {{0.2, 0, InputKind::key_down, Key::right},
                {0.2, 1, InputKind::key_down, Key::left},
                {1.5, 0, InputKind::key_up, Key::right}};
  Game with(scene), without(scene);
  physics::EventBudget budget(1);
  EXPECT_GT(advance_in_parts(with, 20.0, budget), 3);
  without.advance(20.0);
  EXPECT_EQ(with.hash(), without.hash());
  EXPECT_EQ(with.score(), without.score());
}

TEST(GameBudget, PlayersDecideOnTheSameSights) {
  const Scene scene = small_crowd(6, 3);
  Playing with(scene, {"chaser", "random"}, 7, 4.0), without(scene, {"chaser", "random"}, 7, 4.0);
  physics::EventBudget budget(5);
  with.record_events(true);
  EXPECT_GT(advance_in_parts(with, 4.0, budget), 10);
  without.advance(4.0);
  EXPECT_EQ(with.game().hash(), without.game().hash());
  EXPECT_EQ(with.keys(), without.keys());
}

TEST(GameBudget, AGameThatWasCutShortIsSavedAndGoesOn) {
  const Scene scene = small_crowd(6, 3);
  Game game(scene), without(scene);
  physics::EventBudget budget(50);
  ASSERT_FALSE(game.advance(4.0, budget));
  EXPECT_TRUE(game.is_cut_short());
  EXPECT_FALSE(log_of(game, scene, "", {}).hash) << "a replay plays instants to their end";
  GameState::Restored restored = GameState::restore(GameState::save(game, scene), scene);
  ASSERT_TRUE(restored.game) << restored.error;
  restored.game->advance(4.0);
  game.advance(4.0);
  without.advance(4.0);
  EXPECT_FALSE(game.is_cut_short());
  EXPECT_EQ(game.hash(), without.hash());
  EXPECT_EQ(restored.game->hash(), without.hash());
}

}  // namespace
}  // namespace rink::game
