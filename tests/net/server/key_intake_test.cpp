// Key changes from the wire: which become events, when they are felt, and what is counted.
#include "game/net/server/players/key_intake.h"

#include <gtest/gtest.h>

#include <string_view>

#include "game/model/time_grid.h"

namespace rink::game {
namespace {

rti::Bytes bytes(std::string_view text) { return std::as_bytes(std::span(text)); }

TEST(KeyIntake, MakesAnEventOfAKeyAtTheInstantOfItsArrival) {
  KeyIntake keys(2, 0.0);
  const auto event = keys.accept(1, true, bytes("w"), {.simulated_s = 0.7});
  EXPECT_EQ(event, (InputEvent{0.7, 1, InputKind::key_down, Key::up}));
  EXPECT_EQ(keys.accept(1, false, bytes("w"), {.simulated_s = 0.8})->kind, InputKind::key_up);
  EXPECT_EQ(keys.counters().received, 2u);
}

TEST(KeyIntake, RefusesWhatIsNoKey) {
  KeyIntake keys(1, 0.0);
  for (const std::string_view message : {"", "x", "ww"})
    EXPECT_FALSE(keys.accept(0, true, bytes(message), {})) << '"' << message << '"';
  EXPECT_EQ(keys.counters().refused, 3u);
  keys.feel_until(1.0);
  EXPECT_EQ(keys.felt()[0], 0u);
}

TEST(KeyIntake, CountsAKeyAsFeltOnceItsInstantIsPlayed) {
  KeyIntake keys(2, 0.0);
  keys.accept(0, true, bytes("a"), {.simulated_s = 0.5});
  keys.accept(1, true, bytes("a"), {.simulated_s = 1.5});
  keys.feel_until(0.4);
  EXPECT_EQ(keys.felt()[0], 0u);
  keys.feel_until(0.5);
  EXPECT_EQ(keys.felt()[0], 1u);
  EXPECT_EQ(keys.felt()[1], 0u);
  EXPECT_EQ(keys.counters().applied, 1u);
}

TEST(KeyIntake, AcknowledgesKeysThatAreNotFeltOrOverTheLimit) {
  KeyIntake keys(1, 2.0);
  EXPECT_FALSE(keys.accept(0, true, bytes("a"), {.is_felt = false}));
  EXPECT_TRUE(keys.accept(0, true, bytes("a"), {}));
  EXPECT_FALSE(keys.accept(0, true, bytes("a"), {})) << "the second's worth of two is used up";
  EXPECT_EQ(keys.counters().over_limit, 1u);
  EXPECT_TRUE(keys.accept(0, true, bytes("a"), {.now_s = 0.5}));
  keys.feel_until(1.0);
  EXPECT_EQ(keys.felt()[0], 4u);
}

TEST(KeyIntake, OfASharedGameAcknowledgesKeysOverTheLimitInTheirTurn) {
  KeyIntake keys(2, 2.0);
  for (int key = 0; key < 4; ++key) keys.accept(0, true, bytes("a"), {});
  EXPECT_FALSE(keys.accept(1, true, bytes("a"), {.is_felt = false}));
  keys.feel_unsubmitted();
  EXPECT_EQ(keys.felt()[0], 0u) << "two that were submitted come before those over the limit";
  EXPECT_EQ(keys.felt()[1], 1u);
  keys.feel_next(0), keys.feel_unsubmitted();
  EXPECT_EQ(keys.felt()[0], 1u);
  keys.feel_next(0), keys.feel_unsubmitted();
  EXPECT_EQ(keys.felt()[0], 4u);
  keys.feel_next(0);
  EXPECT_EQ(keys.felt()[0], 4u) << "of a player before";
}

TEST(KeyIntake, StampsAMatchsKeyForTheWantedInstantOnTheGrid) {
  KeyIntake keys(1, 0.0);
  const auto time = [&](double now, double wanted) {
    return keys.accept(0, true, bytes("d"), {.simulated_s = now, .wanted_s = wanted})->time;
  };
  EXPECT_EQ(time(1.0, 1.1), next_on(key_grid, 1.1));
  EXPECT_EQ(time(1.0, 1.05), next_on(key_grid, 1.1)) << "not before the one before";
  EXPECT_EQ(time(2.0, 9.0), 2.25) << "a quarter of a second ahead at most";
  EXPECT_EQ(keys.counters().late, 0u);
  EXPECT_EQ(time(3.0, 2.9), 3.0);
  EXPECT_EQ(keys.counters().late, 1u);
}

TEST(KeyIntake, LetsGoOfWhatIsHeldNotBeforeTheLastKey) {
  KeyIntake keys(1, 0.0);
  keys.accept(0, true, bytes("a"), {.simulated_s = 1.0, .wanted_s = 1.0});
  keys.accept(0, true, bytes("w"), {.simulated_s = 1.0, .wanted_s = 1.125});
  keys.accept(0, false, bytes("a"), {.simulated_s = 1.0, .wanted_s = 1.125});
  const auto events = keys.release(0, 1.0);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0], (InputEvent{1.125, 0, InputKind::key_up, Key::up}));
  EXPECT_TRUE(keys.release(0, 2.0).empty());
}

TEST(KeyIntake, ForgetsOfOneWhoLeavesWhatIsOnItsWay) {
  KeyIntake keys(2, 0.0);
  keys.accept(0, true, bytes("a"), {.simulated_s = 1.0});
  keys.accept(1, true, bytes("a"), {.simulated_s = 1.0});
  keys.leave(0);
  keys.feel_until(2.0);
  EXPECT_EQ(keys.felt()[0], 0u);
  EXPECT_EQ(keys.felt()[1], 1u);
  keys.enter(1, 0.0);
  EXPECT_EQ(keys.felt()[1], 0u) << "the next one's keys count from 0";
}

TEST(KeyIntake, BeginsAnewWithNothingHeldAndAllAcknowledged) {
  KeyIntake keys(1, 0.0);
  keys.record(*keys.accept(0, true, bytes("a"), {.simulated_s = 9.0, .wanted_s = 9.0}));
  EXPECT_EQ(keys.recorded().size(), 1u);
  keys.begin();
  EXPECT_EQ(keys.felt()[0], 1u);
  EXPECT_TRUE(keys.recorded().empty());
  EXPECT_TRUE(keys.release(0, 0.0).empty());
  EXPECT_EQ(keys.accept(0, true, bytes("a"), {.simulated_s = 0.5, .wanted_s = 0.5})->time, 0.5)
      << "not after the last key of the game before";
}

}  // namespace
}  // namespace rink::game
