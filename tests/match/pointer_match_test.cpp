// Matches by pointer: over a modelled network with delay and loss as on one machine, predicted and
// replayed as those by keys.
#include <gtest/gtest.h>

#include "game/control/replay.h"
#include "game/match/local_match.h"
#include "game/match/predicted_rink.h"
#include "loadgen/duel/feel.h"
#include "tests/match/match_scene.h"

namespace rink::game {
namespace {

using loadgen::Duel;
using loadgen::DuelSettings;
using loadgen::Feel;
using loadgen::MatchBot;

constexpr std::array<const char*, 2> by_pointer{MatchBot::pointer, MatchBot::pointer};

DuelSettings pointers(double delay_s, std::uint64_t seed = 1) {
  return {.delay_s = delay_s, .seed = seed, .players = {by_pointer[0], by_pointer[1]}};
}

Feel feel_of_match(const DuelSettings& settings, double seconds) {
  return loadgen::feel_of(rink_fom(), match_scene(), match_text(), settings, seconds);
}

TEST(APointerMatch, IsReplayedToItsHashAtAnyDelayAndWithLoss) {
  for (const double delay_s : {0.0, 0.05, 0.1, 0.2})
    for (const double loss : {0.0, 0.02}) {
      SCOPED_TRACE(testing::Message() << delay_s << " s, loss " << loss);
      DuelSettings settings = pointers(delay_s);
      settings.loss = loss, settings.jitter_s = loss > 0.0 ? 0.005 : 0.0;
      const Feel feel = feel_of_match(settings, 20.0);
      EXPECT_TRUE(feel.is_replayed);
      EXPECT_GT(feel.pushes, 400u) << "or the test shows nothing";
      if (loss > 0.0) continue;
      EXPECT_EQ(feel.late_keys, 0u);
      EXPECT_LE(feel.own.p50, 0.5e-3);
    }
}

/// The bar of keys: means over ten matches at 100 ms each way.
TEST(APointerMatchLong, ShowsTheOwnBatAsItIsAtAHundredMillisecondsEachWay) {
  constexpr int matches = 10;
  double p50 = 0.0, p99 = 0.0, received = 0.0, sent = 0.0;
  for (std::uint64_t seed = 1; seed <= matches; ++seed) {
    const Feel feel = feel_of_match(pointers(0.1, seed), 60.0);
    EXPECT_TRUE(feel.is_replayed);
    p50 += feel.own.p50 / matches, p99 += feel.own.p99 / matches;
    received += feel.payload_bytes_per_s / matches, sent += feel.sent_bytes_per_s / matches;
  }
  std::printf("own bat: p50 %.3f mm, p99 %.2f mm; down %.0f B/s, up %.0f B/s\n", 1e3 * p50,
              1e3 * p99, received, sent);
  EXPECT_LE(p50, 0.5e-3);
  EXPECT_LE(p99, 40e-3);
}

TEST(APointerMatch, CostsAPlayerAtMostAKilobytePerSecond) {
  const Feel feel = feel_of_match(pointers(0.05), 30.0);
  std::printf("down %.0f B/s, up %.0f B/s, %.1f pushes/s and player\n", feel.payload_bytes_per_s,
              feel.sent_bytes_per_s, static_cast<double>(feel.pushes) / 2.0 / feel.played_s);
  EXPECT_LE(feel.sent_bytes_per_s, 1000.0);
  EXPECT_LE(feel.payload_bytes_per_s, 1000.0);
}

TEST(APointerMatch, AnswersTheHandInTheNextFrameAtAnyDelay) {
  for (const double delay_s : {0.0, 0.05, 0.1, 0.2}) {
    Duel duel(rink_fom(), match_scene(), match_text(), {.delay_s = delay_s});
    duel.connect(0), duel.connect(1);
    ASSERT_TRUE(
        duel.run_until([&] { return duel.client(0).sight().phase == MatchPhase::playing; }, 10.0));
    duel.run(0.5);
    const Vector2 before = duel.client(0).sight().things[0].position;
    duel.client(0).reach(0, before + Vector2(0.0, 0.3));
    duel.run(2.0 / 60.0 + 1e-3);  // one frame to push in, one in which it has had time to move
    const double moved = duel.client(0).sight().things[0].position.y() - before.y();
    EXPECT_NEAR(moved, 0.5 * 8.0 / 3600.0, 0.3 * 0.5 * 8.0 / 3600.0)
        << "half the thrust times a frame squared; delay " << delay_s << " s";
  }
}

TEST(APointerMatch, IsPredictedAsTheServerPlaysIt) {
  Game game(match_scene());
  PredictedRink rink(match_scene(), 0);
  const auto received = [&] {
    ReceivedRink news{.time = game.now(), .bats = {}, .pucks = {}};
    for (const Entity& entity : game.entities()) {
      const ReceivedBody body{
          .position = game.position(entity.id), .velocity = game.velocity(entity.id), .held = {}};
      if (entity.kind == physics::BodyKind::bat) news.bats.push_back(body);
      if (entity.kind == physics::BodyKind::puck) news.pucks.push_back(body);
    }
    news.own_felt = game.input_count(0);
    return news;
  };
  rink.receive(received());
  rink.advance(0.0, 0.0);
  // Into the wall, where nothing of the push along it shows in the motion, and off it.
  const std::pair<double, Push> pushes[] = {{0.1, {0, 127}}, {1.5, {60, 100}}, {1.75, {-80, -64}}};
  for (const auto& [time, push] : pushes) {
    rink.advance(time, 0.1);
    rink.push(push, time);
    game.submit({.time = time, .player = 0, .kind = InputKind::push, .push = push});
    if (time == 1.75) {
      game.advance(1.7);
      rink.receive(received());
      EXPECT_EQ(rink.keys_waiting(), 1u);
    }
  }
  rink.advance(2.5, 0.1);
  game.advance(2.5);
  EXPECT_LT((rink.bats()[0].position - game.position(*game.bat(0))).norm(), 1e-12);
}

TEST(APointerMatch, OnOneMachineIsRecordedAndReplayed) {
  LocalMatch match(match_scene(),
                   {.players = {Playing::hand, "chaser"}, .scene_text = match_text()});
  loadgen::PointerHand hand(3);
  double now_s = 10.0;
  for (int frame = 0; frame < 20 * 60; ++frame) {
    match.reach(0, hand.place(match.sight(), now_s));
    match.advance(now_s += 1.0 / 60.0);
  }
  EXPECT_TRUE(match.why_keys_alone().empty());
  match.finish();
  const std::vector<KeyLog> records = match.take_finished();
  ASSERT_EQ(records.size(), 1u);
  EXPECT_TRUE(has_pushes(records[0]));
  EXPECT_EQ(replay(records[0], match_scene()), *records[0].hash);
}

/// A push of the very instant at which a record ends is not in it, nor is a key.
TEST(APointerMatch, HasARecordAtAnyFrameThatLeadsToItsHash) {
  LocalMatch match(match_scene(), {.times = {.countdown_s = 0.0}, .scene_text = match_text()});
  double now_s = 1.0;
  for (int frame = 0; frame < 200; ++frame) {
    match.reach(0, Vector2(0.4 + 0.002 * (frame % 60), 0.5));
    match.press(1, Key::up, frame % 2 == 0);
    match.advance(now_s += 1.0 / 60.0);
    const auto record = match.record_so_far();
    if (!record) continue;
    ASSERT_EQ(replay(*record, match_scene()), *record->hash) << frame;
  }
}

TEST(APointerMatch, LetsGoOfTheBatWhenTheHandIsGone) {
  LocalMatch match(match_scene(), {.times = {.countdown_s = 0.0}});
  double now_s = 1.0;
  const auto run = [&](int frames) {
    for (int frame = 0; frame < frames; ++frame) match.advance(now_s += 1.0 / 60.0);
  };
  run(2);
  match.reach(0, Vector2(0.4, 0.2));
  run(5);
  EXPECT_NE(pushed(match.playing().game(), 0), Push{});
  match.reach(0, std::nullopt);
  run(2);
  EXPECT_EQ(pushed(match.playing().game(), 0), Push{});
}

/// What a client of another make may send at any time.
TEST(APointerMatch, RefusesAndCountsWhatIsNoPush) {
  const auto duel = std::make_unique<Duel>(rink_fom(), match_scene(), match_text(),
                                           DuelSettings{.delay_s = 0.01});
  duel->connect(0), duel->connect(1);
  ASSERT_TRUE(
      duel->run_until([&] { return duel->client(0).sight().phase == MatchPhase::playing; }, 10.0));
  const ObjectModel model(rink_fom());
  auto& ambassador = const_cast<rti::Ambassador&>(duel->client(0).client().ambassador());
  for (const std::byte octet : {std::byte{255}, std::byte{254}}) {
    const std::array bytes{octet, octet};
    ambassador.send_interaction(model.push, bytes, {.time = 1e300, .tag = 0});
  }
  duel->run(1.0);
  const KeyCounters& counters = duel->server().keys().counters();
  EXPECT_EQ(counters.pushes, 2u);
  EXPECT_EQ(counters.refused, 1u);
  EXPECT_EQ(pushed(duel->server().game(), 0), (Push{127, 127})) << "a quarter of a second later";
}

}  // namespace
}  // namespace rink::game
