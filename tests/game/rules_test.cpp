// The rules at their edges: the end of a match, a spot without room, and what two games that differ
// in nothing else still differ in.
#include <gtest/gtest.h>

#include <algorithm>

#include "game/control/game.h"
#include "tests/game/rink_scenes.h"

namespace rink::game {
namespace {

std::ptrdiff_t pucks_in_play(const Game& game) {
  return std::ranges::count_if(game.entities(), [&](const Entity& each) {
    return each.kind == physics::BodyKind::puck && game.world().is_in_play(each.id);
  });
}

/// Of five pucks the third wins: neither the two before it nor the two after it come back.
TEST(Match, HasNoFaceOffOnceItIsOver) {
  const std::string rules = "[match]\nface_off_delay = 0.5\n";
  Game over(pucks_into_left_goal(5, rules + "goals_to_win = 3\n"));
  over.advance(0.25 + 0.15 * 2 + 0.01);
  ASSERT_TRUE(over.is_over());
  EXPECT_EQ(pucks_in_play(over), 2) << "still on their way";
  const std::uint64_t hash_at_end = over.hash();
  over.advance(20.0);
  EXPECT_EQ(pucks_in_play(over), 0);
  EXPECT_EQ(over.score(), (Score{0, 3}));
  EXPECT_NE(over.hash(), hash_at_end) << "though what is in play moves on";

  Game endless(pucks_into_left_goal(5, rules));
  endless.advance(20.0);
  EXPECT_EQ(pucks_in_play(endless), 5) << "where nobody wins, they all come back";
  EXPECT_EQ(endless.score(), (Score{0, 5}));
}

/// A bat nearly as large as the field leaves 0.16 m on its left, where a puck of 0.06 m lies until
/// it has scored. Then the bat moves to the middle, by an acceleration a for tau seconds and its
/// opposite for as long, which is a tau^2 = 0.08 m: what is left on each side, 0.08 m, is no place
/// for the puck.
Scene puck_without_room() {
  return small_scene(
      "[match]\nface_off_delay = 1.0\n"
      "[[puck]]\nposition = [0.08, 1.0]\nvelocity = [-2.0, 0.0]\nradius = 0.06\n"
      "[[bat]]\nposition = [2.08, 1.0]\nhalf_extent = [1.92, 0.96]\nthrust = 8.0\n");
}

TEST(Match, PutsAPuckBackAsSoonAsThereIsRoomForIt) {
  Game game(puck_without_room());
  const double tau = 0.1, leaves = 3.21, goal = 0.04, retry = Game::placement_retry;
  game.submit({0.1, 0, InputKind::key_down, Key::left});
  game.submit({0.1 + tau, 0, InputKind::key_up, Key::left});
  game.submit({0.1 + tau, 0, InputKind::key_down, Key::right});
  game.submit({0.1 + 2 * tau, 0, InputKind::key_up, Key::right});
  game.submit({leaves, 0, InputKind::leave});
  game.advance(1.0);
  ASSERT_NEAR(game.position(*game.bat(0)).x(), 2.0, 1e-9);
  ASSERT_EQ(game.score(), (Score{0, 1}));
  for (double now = 1.01; now < leaves; now += 0.05) {
    game.advance(now);
    ASSERT_EQ(pucks_in_play(game), 0) << "at " << now;
  }
  const double first_with_room = goal + 1.0 + retry * std::ceil((leaves - goal - 1.0) / retry);
  game.advance(first_with_room - 1e-6);
  EXPECT_EQ(pucks_in_play(game), 0);
  game.advance(first_with_room + 1e-6);
  EXPECT_EQ(pucks_in_play(game), 1);
}

/// Two games with the same bodies, keys and score: in one the puck comes back a second later.
TEST(Game, DiffersInItsHashIfAFaceOffIsDueAtAnotherTime) {
  const auto hash_of = [](const char* delay) {
    Game game(pucks_into_left_goal(1, std::string("[match]\nface_off_delay = ") + delay + "\n"));
    game.advance(0.6);
    EXPECT_EQ(game.score(), (Score{0, 1}));
    return game.hash();
  };
  EXPECT_EQ(hash_of("1.0"), hash_of("1.0"));
  EXPECT_NE(hash_of("1.0"), hash_of("2.0"));
}

TEST(Game, DiffersInItsHashIfAFaceOffIsDueAtAllOrForAnotherPuck) {
  const auto begun = [](const std::string& rules, double until) {
    Game game(pucks_into_left_goal(2, rules));
    game.advance(until);
    return game;
  };
  // At the end of a match nothing is due any more.
  const Game won = begun("[match]\ngoals_to_win = 1\nface_off_delay = 1.0\n", 0.26),
             going_on = begun("[match]\nface_off_delay = 1.0\n", 0.26);
  EXPECT_EQ(won.world().hash(), going_on.world().hash());
  EXPECT_NE(won.hash(), going_on.hash());
}

/// Each part for itself: what one of them is changed to shows.
TEST(Game, HasAHashOfEveryPartOfIt) {
  const Entity puck{.id = EntityId{3}, .player = std::nullopt},
      other{.id = EntityId{4}, .player = std::nullopt};
  BatController idle(1.0), holding(1.0), tapped(1.0);
  holding.press(Key::up, true);
  tapped.press(Key::up, true), tapped.press(Key::up, false);
  const auto hash_of = [](std::uint64_t world, const Entity& entity, const BatController& player,
                          const Score& score) {
    const BatController* players[] = {&player};
    return begun_game_hash(world, std::span(&entity, 1), players, score).value();
  };
  const std::uint64_t hash = hash_of(1, puck, idle, {2, 3});
  EXPECT_EQ(hash_of(1, puck, idle, {2, 3}), hash);
  EXPECT_NE(hash_of(2, puck, idle, {2, 3}), hash);
  EXPECT_NE(hash_of(1, other, idle, {2, 3}), hash);
  EXPECT_NE(hash_of(1, puck, holding, {2, 3}), hash);
  EXPECT_NE(hash_of(1, puck, tapped, {2, 3}), hash) << "no key is held, but one was felt";
  EXPECT_NE(hash_of(1, puck, idle, {3, 3}), hash);
  EXPECT_NE(hash_of(1, puck, idle, {2, 4}), hash);
  EXPECT_NE(hash_of(1, puck, idle, {3, 2}), hash);
}

}  // namespace
}  // namespace rink::game
