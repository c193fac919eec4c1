// Key changes from the wire: which become events, when they are felt, and what is counted.
#include "game/net/server/players/key_intake.h"

#include <gtest/gtest.h>

#include <string_view>

#include "game/model/time_grid.h"
#include "game/net/server/server.h"

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

TEST(KeyIntake, MakesAnEventOfAPushAsOfAKey) {
  KeyIntake keys(2, 0.0);
  keys.enter(1, 0.0);
  const auto event =
      keys.accept_push(1, bytes({"\x00\xfe", 2}), {.simulated_s = 1.0, .wanted_s = 1.1});
  EXPECT_EQ(event, (InputEvent{.time = next_on(key_grid, 1.1),
                               .player = 1,
                               .kind = InputKind::push,
                               .push = {-127, 127}}));
  EXPECT_EQ(keys.accept(1, true, bytes("a"), {.simulated_s = 1.0, .wanted_s = 1.05})->time,
            event->time)
      << "keys and pushes keep their order";
  keys.feel_until(1.2);
  EXPECT_EQ(keys.felt()[1], 2u);
  EXPECT_EQ(keys.counters().pushes, 1u);
}

TEST(KeyIntake, CountsAPushThatCameTooLateAndFeelsItAtOnce) {
  KeyIntake keys(1, 0.0);
  EXPECT_EQ(keys.accept_push(0, bytes("~~"), {.simulated_s = 2.0, .wanted_s = 1.9})->time, 2.0);
  EXPECT_EQ(keys.accept_push(0, bytes("~~"), {.simulated_s = 2.0, .wanted_s = 9.0})->time, 2.25);
  EXPECT_EQ(keys.counters().late, 1u);
}

TEST(KeyIntake, RefusesWhatIsNoPush) {
  KeyIntake keys(1, 0.0);
  for (const std::string_view message : {"", "a", "aaa", "a\xff",
                                         "\xff"
                                         "a"})
    EXPECT_FALSE(keys.accept_push(0, bytes(message), {})) << '"' << message << '"';
  EXPECT_EQ(keys.counters().refused, 5u);
  EXPECT_EQ(keys.counters().pushes, 5u);
  keys.feel_until(1.0);
  EXPECT_EQ(keys.felt()[0], 0u);
}

/// Neither takes of the other's allowance.
TEST(KeyIntake, LimitsKeysAndPushesEachByABucketOfItsOwn) {
  KeyIntake keys(1, match_key_limit_default);
  const auto count = [&](bool is_push, double from_s) {
    int felt = 0;
    for (int k = 0; k < 1000; ++k) {
      const KeyArrival arrival{.now_s = from_s + k * 1e-3};
      felt += (is_push ? keys.accept_push(0, bytes("aa"), arrival)
                       : keys.accept(0, true, bytes("a"), arrival))
                  ? 1
                  : 0;
    }
    return felt;
  };
  EXPECT_NEAR(count(false, 0.0), 240, 2) << "a second's worth of 120 at once, and 120 more in it";
  EXPECT_FALSE(keys.counters().is_push_over_limit);
  EXPECT_NEAR(count(true, 1.0), 480, 2) << "240 and 240";
  EXPECT_TRUE(keys.counters().is_push_over_limit);
  EXPECT_NEAR(static_cast<double>(keys.counters().over_limit), 2000.0 - 720.0, 4.0);
  keys.feel_until(10.0);
  EXPECT_EQ(keys.felt()[0], 2000u) << "nobody waits for what is not felt";
}

TEST(KeyIntake, FeelsTheEndOfAPushWhateverTheLimit) {
  KeyIntake keys(1, match_key_limit_default);
  const KeyArrival arrival{.now_s = 1.0};
  while (keys.accept_push(0, bytes("aa"), arrival)) continue;
  const auto none = bytes({"\x7f\x7f", 2});
  const auto end = keys.accept_push(0, none, arrival);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->push, Push());
  EXPECT_FALSE(keys.accept_push(0, none, arrival)) << "there is nothing left to end";
}

TEST(KeyIntake, EndsThePushOfOneWhoLeavesItsHand) {
  KeyIntake keys(1, 0.0);
  keys.accept_push(0, bytes("aa"), {.simulated_s = 1.0, .wanted_s = 1.0});
  const auto events = keys.release(0, 1.5);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0], (InputEvent{.time = 1.5, .kind = InputKind::push}));
  EXPECT_TRUE(keys.release(0, 2.0).empty());
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
