// Whose keys a bat feels, and when: of a player who stamps them ahead, and of one who has left.
#include <gtest/gtest.h>

#include <algorithm>

#include "game/model/time_grid.h"
#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"

namespace rink::game {
namespace {

/// A hosted match whose clock is that of the test, and which runs from the start.
LockstepSettings hosted(double patience_s = 30.0) {
  Hosting hosting{.times = {.countdown_s = 0.0, .patience_s = patience_s},
                  .scene_text = scene_text(test::source_folder() + "/scenes/match.toml")};
  return {.clients = 2,
          .rate_hz = 60.0,
          .view_fraction = 1.0,
          .server = {.tick_s = 1.0 / 60.0, .replay = std::nullopt, .hosting = std::move(hosting)}};
}

struct PlayerKeys : testing::Test {
  PlayerKeys() : rink(match(), hosted()) {
    rink.start();
    rink.server().follow_match(0.0);
    for (int tick = 0; tick < 6; ++tick) rink.tick();
  }
  const std::vector<InputEvent>& felt() { return rink.server().keys().recorded(); }
  LockstepRink rink;
};

TEST_F(PlayerKeys, AreFeltWhenTheirPlayerSaysButAtMostAQuarterOfASecondAhead) {
  ASSERT_EQ(rink.client(0).state(), Client::State::playing);
  const double now = rink.now;
  for (const auto& [ahead_s, expected_s] : {std::pair{-3.0, 0.0},
                                            {0.0, 0.0},
                                            {0.1, 0.1},
                                            {0.25, 0.25},
                                            {0.3, 0.25},
                                            {60.0, 0.25},
                                            {1e300, 0.25}}) {
    const std::size_t before = felt().size();
    rink.client(0).press(Key::up, now + ahead_s);
    rink.settle();
    ASSERT_EQ(felt().size(), before + 1);
    EXPECT_NEAR(felt().back().time, now + expected_s, 1e-3 + 1.0 / 1024.0) << ahead_s << " s ahead";
    EXPECT_LE(felt().back().time, next_on(key_grid, now + 0.25)) << ahead_s << " s ahead";
  }
}

TEST_F(PlayerKeys, AreFeltInTheOrderInWhichTheyWerePressed) {
  rink.client(0).press(Key::up, rink.now + 0.2);
  rink.client(0).release(Key::up, rink.now + 0.1);
  rink.client(1).press(Key::left, rink.now + 0.1);
  rink.settle();
  ASSERT_EQ(felt().size(), 3u);
  EXPECT_GE(felt()[1].time, felt()[0].time);
  EXPECT_LT(felt()[2].time, felt()[0].time) << "one player's keys do not hold up the other's";
}

TEST_F(PlayerKeys, OfOneWhoLeftAreNotHeldForTheNextOnTheSeatNorCounted) {
  rink.client(1).press(Key::left);
  rink.tick();
  ASSERT_EQ(rink.client(1).bat()->input.count, 1u);
  rink.client(1).press(Key::up, rink.now + 0.2);
  rink.leave(1);
  rink.settle();
  rink.settle();
  Client& next = rink.add_client("next");
  rink.server().follow_match(rink.now);
  for (int tick = 0; tick < 60; ++tick) rink.tick();
  EXPECT_EQ(rink.server().game().keys_held(1), KeysHeld{});
  ASSERT_NE(next.bat(), nullptr);
  EXPECT_EQ(next.bat()->input.count, 0u) << "keys that the next player did not press";
  EXPECT_EQ(next.bat()->input.held, 0u);
}

TEST(PlayerKeysOfARematch, AreNotHeldUpByThoseOfTheMatchBefore) {
  LockstepRink rink(match(), hosted(0.25));
  rink.start();
  const auto tick_until = [&](double until) {
    for (; rink.now < until; rink.tick()) rink.server().hosted()->pass(rink.now);
    rink.server().follow_match(rink.now);
  };
  tick_until(3.0);
  rink.client(0).press(Key::up, rink.now);
  rink.settle();
  ASSERT_GE(rink.server().keys().recorded().back().time, 2.9);
  rink.leave(1);
  tick_until(4.0);
  ASSERT_EQ(rink.server().hosted()->state().phase, MatchPhase::over);
  rink.add_client("next");
  rink.settle();
  rink.settle();
  rink.server().follow_match(rink.now);
  ASSERT_EQ(rink.server().hosted()->state().number, 2u);
  rink.client(0).press(Key::down);
  rink.settle();
  ASSERT_EQ(rink.server().keys().recorded().size(), 1u);
  EXPECT_LT(rink.server().keys().recorded().back().time, 0.5);
}

/// In a crowd the bat goes with its player, and the next one has another.
TEST(PlayerKeysOfACrowd, OfOneWhoLeftAreNotFeltByTheNextOnTheSeat) {
  LockstepRink rink(small_crowd(), {.clients = 2});
  rink.start();
  rink.client(1).press(Key::down);
  rink.run(0.2);
  ASSERT_EQ(rink.client(1).bat()->input.count, 1u);
  for (int i = 0; i < 5; ++i) rink.client(1).press(Key::left), rink.client(1).press(Key::up);
  rink.settle();
  rink.leave(1);
  rink.settle();
  Client& next = rink.add_client("bat-1");
  rink.settle();
  rink.run(0.3);
  ASSERT_NE(next.bat(), nullptr);
  EXPECT_EQ(next.bat()->object, rink.server().publisher().object(*rink.server().game().bat(1)));
  EXPECT_EQ(next.bat()->input.count, 0u);
  EXPECT_EQ(next.bat()->input.held, 0u);
  EXPECT_EQ(rink.server().game().keys_held(1), KeysHeld{});
}

}  // namespace
}  // namespace rink::game
