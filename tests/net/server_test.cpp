// The server federate: seats, stamped keys, replays, and the same game whatever carries it.
#include "game/net/server/server.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "game/players/player.h"
#include "tests/net/lockstep_rink.h"
#include "tests/net/scenes.h"

namespace rink::game {
namespace {

/// Plays `seconds` of `scene` with the keys of `log` and returns the final state's hash.
std::uint64_t hash_after(const Scene& scene, const std::vector<InputEvent>& log,
                         const std::string& scheme, double rate_hz, double seconds) {
  LockstepRink rink(
      scene, {.scheme = scheme, .clients = 3, .rate_hz = rate_hz, .server = {.replay = log}});
  rink.start();
  rink.run(seconds);
  EXPECT_DOUBLE_EQ(rink.server().game().now(), seconds);
  return rink.server().game().hash();
}

TEST(Server, EndsInTheSameStateUnderEveryFilterAndOutputRate) {
  const Scene scene = small_crowd();
  const std::vector<InputEvent> log = keys_for(scene, 11, 2.0);
  Game alone(scene);
  for (const InputEvent& event : log) alone.submit(event);
  alone.advance(2.0);
  for (const char* scheme : {"none", "grid", "region"})
    for (const double rate_hz : {20.0, 60.0})
      EXPECT_EQ(hash_after(scene, log, scheme, rate_hz, 2.0), alone.hash())
          << scheme << " at " << rate_hz << " Hz";
}

TEST(Server, RecordsALogThatReplaysLiveKeysToTheSameState) {
  const Scene scene = small_crowd();
  LockstepRink live(scene, {.clients = 4});
  live.start();
  for (int tick = 0; tick < 60; ++tick) {
    live.now += 0.0071;  // keys arrive between two ticks
    Client& client = live.client(static_cast<std::size_t>(tick % 4));
    tick / 4 % 2 == 0 ? client.press(Key::right) : client.release(Key::right);
    live.tick();
  }
  EXPECT_EQ(live.server().keys().counters().received, 60u);
  EXPECT_EQ(live.server().keys().counters().applied, 60u);
  EXPECT_EQ(hash_after(scene, live.server().keys().recorded(), "none", 30.0, 2.0),
            live.server().game().hash());
}

TEST(Server, StampsAKeyWithTheInstantOfItsArrival) {
  LockstepRink rink(match(), {.clients = 1});
  rink.start();
  rink.tick();
  rink.now += 0.013;
  rink.client(0).press(Key::up);
  const double arrival = rink.now;
  rink.tick();
  ASSERT_EQ(rink.server().keys().recorded().size(), 1u);
  EXPECT_EQ(
      rink.server().keys().recorded()[0],
      (InputEvent{.time = arrival, .player = 0, .kind = InputKind::key_down, .key = Key::up}));
}

TEST(Server, GivesABatToTheFederateThatBearsItsNameAndTheFirstFreeOneToOthers) {
  LockstepRink rink(small_crowd(), {.clients = 0});
  Client& named = rink.add_client("bat-5");
  Client& stranger = rink.add_client("Ada");
  rink.start();
  const Game& game = rink.server().game();
  ASSERT_NE(named.bat(), nullptr);
  ASSERT_NE(stranger.bat(), nullptr);
  EXPECT_EQ(named.bat()->object, rink.server().publisher().object(*game.bat(5)));
  EXPECT_EQ(stranger.bat()->object, rink.server().publisher().object(*game.bat(0)));
}

TEST(Server, TellsAPlayerTooManyThatNoBatIsFree) {
  LockstepRink rink(match(), {.clients = 2});
  Client& third = rink.add_client("third");
  rink.start();
  EXPECT_EQ(third.state(), Client::State::refused);
  EXPECT_EQ(third.joining().error(), "no bat is free");
  EXPECT_EQ(rink.client(1).state(), Client::State::playing);
}

TEST(Server, RemovesTheBatOfAKilledClientEverywhereAndGivesItBackToTheNext) {
  LockstepRink rink(match(), {.clients = 2, .view_fraction = 1.0});
  rink.start();
  rink.run(0.2);
  const rti::ObjectHandle bat = rink.client(1).bat()->object;
  ASSERT_NE(rink.client(0).replicas().find(bat), nullptr);
  rink.kill(1);
  rink.tick();
  rink.tick();
  EXPECT_FALSE(rink.server().game().bat(1));
  EXPECT_EQ(rink.client(0).replicas().find(bat), nullptr);
  EXPECT_EQ(rink.server().counters().federates_lost, 1u);
  Client& next = rink.add_client("next");
  rink.run(0.3);
  EXPECT_TRUE(rink.server().game().bat(1));
  EXPECT_EQ(next.state(), Client::State::playing);
}

TEST(Server, StepsInSynchronousModeWhenAllPlayersHaveSaidUpdate) {
  LockstepRink rink(match(), {.clients = 2});
  rink.start();
  EXPECT_FALSE(rink.server().seats().are_all_turns_done());
  rink.client(0).end_turn();
  rink.client(0).end_turn();
  rink.settle();
  EXPECT_FALSE(rink.server().seats().are_all_turns_done());
  rink.client(1).end_turn();
  rink.settle();
  EXPECT_TRUE(rink.server().seats().are_all_turns_done());
  rink.tick();
  EXPECT_FALSE(rink.server().seats().are_all_turns_done());
}

TEST(Server, WaitsForTheOthersTurnsWhereOneLeavesWhoseTurnIsDone) {
  LockstepRink rink(small_crowd(), {.clients = 3});
  rink.start();
  rink.client(0).end_turn();
  rink.client(1).end_turn();
  rink.settle();
  rink.leave(1);
  rink.settle();
  EXPECT_FALSE(rink.server().seats().are_all_turns_done()) << "the last one has not had its turn";
  rink.client(2).end_turn();
  rink.settle();
  EXPECT_TRUE(rink.server().seats().are_all_turns_done());
}

/// Whoever predicts must know which of its keys are in the state that it is sent.
TEST(Server, CountsAKeyAsFeltInTheTickThatAppliesIt) {
  constexpr double tick_s = 1.0 / 32.0;
  for (const double part : {0.5, 1.0}) {
    LockstepRink rink(match(), {.clients = 1,
                                .rate_hz = 1.0 / tick_s,
                                .server = {.tick_s = tick_s, .replay = std::nullopt}});
    rink.start();
    rink.tick();
    rink.now += part * tick_s;
    rink.client(0).press(Key::up);
    rink.settle();
    ASSERT_EQ(rink.server().keys().recorded().size(), 1u);
    rink.tick();
    EXPECT_GE(rink.server().game().now(), rink.server().keys().recorded()[0].time);
    EXPECT_EQ(rink.client(0).bat()->input.count, 1u) << part;
    EXPECT_EQ(rink.client(0).bat()->input.held, rink.server().game().keys_held(0).bits()) << part;
  }
}

/// 9,600 key changes a second, as a program sends them: a full second's worth is felt at once, and
/// of each later tick its share.
TEST(Server, FeelsNoMoreKeysOfAPlayerThanItsLimitAndAllOfTheOther) {
  LockstepRink rink(match(), {.clients = 2, .rate_hz = 30.0});
  rink.start();
  constexpr int ticks = 60, flood = 320;
  for (int tick = 0; tick < ticks; ++tick) {
    for (int i = 0; i < flood / 2; ++i)
      rink.client(0).press(Key::up), rink.client(0).release(Key::up);
    tick % 2 == 0 ? rink.client(1).press(Key::down) : rink.client(1).release(Key::down);
    rink.tick();
  }
  rink.tick();
  const auto felt = static_cast<double>(
      std::ranges::count(rink.server().keys().recorded(), 0u, &InputEvent::player));
  EXPECT_NEAR(felt, key_limit_default * (1.0 + (ticks - 1) / 30.0), 1.0);
  EXPECT_EQ(rink.server().keys().counters().over_limit,
            ticks * flood - static_cast<std::uint64_t>(felt));
  EXPECT_EQ(rink.server().keys().counters().player_over_limit, 0u);
  EXPECT_EQ(std::ranges::count(rink.server().keys().recorded(), 1u, &InputEvent::player), ticks);
  EXPECT_EQ(rink.client(0).bat()->input.count, static_cast<std::uint32_t>(ticks * flood))
      << "nobody waits for a key that is not felt";
  EXPECT_EQ(rink.client(1).bat()->input.count, static_cast<std::uint32_t>(ticks));
}

TEST(Server, FeelsEveryKeyWithoutALimit) {
  LockstepRink rink(match(),
                    {.clients = 1, .server = {.replay = std::nullopt, .key_limit_per_s = 0.0}});
  rink.start();
  for (int i = 0; i < 1000; ++i) rink.client(0).press(Key::up), rink.client(0).release(Key::up);
  rink.tick();
  EXPECT_EQ(rink.server().keys().recorded().size(), 2000u);
  EXPECT_EQ(rink.server().keys().counters().over_limit, 0u);
}

/// No bot decides more often than every decision_period, nor has more keys than four; one whose
/// link stood still for two seconds has as many more to send at once.
TEST(Server, FeelsEveryKeyOfABotThatChangesAllItsKeysAtEachDecision) {
  static_assert(all_keys.size() / decision_period <= key_limit_default / 3.0);
  LockstepRink rink(match(), {.clients = 1, .rate_hz = 1.0 / decision_period});
  rink.start();
  std::uint64_t sent = 0;
  const auto decide = [&](bool is_down) {
    for (const Key key : all_keys)
      is_down ? rink.client(0).press(key) : rink.client(0).release(key), ++sent;
  };
  for (int tick = 0; tick < 200; ++tick) {
    const bool stood_still = tick > 140 && tick <= 180;
    if (!stood_still) decide(tick % 2 == 0);
    for (int missed = 0; tick == 181 && missed < 40; ++missed) decide(missed % 2 == 0);
    rink.tick();
  }
  EXPECT_EQ(rink.server().keys().recorded().size(), sent);
  EXPECT_EQ(rink.server().keys().counters().over_limit, 0u);
}

TEST(Server, CountsAKeyThatDoesNotExistAndPlaysOn) {
  LockstepRink rink(match(), {.clients = 1});
  rink.start();
  const std::byte nonsense[] = {std::byte{'?'}};
  const ObjectModel model(rink.client(0).ambassador().fom());
  rink.client(0).ambassador().send_interaction(model.key_down, nonsense, {});
  rink.tick();
  EXPECT_EQ(rink.server().keys().counters().refused, 1u);
  EXPECT_TRUE(rink.server().keys().recorded().empty());
  EXPECT_EQ(rink.client(0).state(), Client::State::playing);
}

}  // namespace
}  // namespace rink::game
