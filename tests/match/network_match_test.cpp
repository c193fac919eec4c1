// Two players on a server: from the countdown to the rematch, and what each is shown of it.
#include <gtest/gtest.h>

#include "game/control/replay.h"
#include "loadgen/duel/feel.h"
#include "tests/match/match_scene.h"

namespace rink::game {
namespace {

using loadgen::Duel;
using loadgen::DuelSettings;
using loadgen::Feel;

struct ANetworkMatch : testing::Test {
  static MatchPhase phase_shown(Duel& duel, std::size_t k) { return duel.client(k).sight().phase; }
  static bool is_shown_to_both(Duel& duel, MatchPhase phase, double patience_s) {
    return duel.run_until(
        [&] { return phase_shown(duel, 0) == phase && phase_shown(duel, 1) == phase; }, patience_s);
  }
  static std::unique_ptr<Duel> started(const DuelSettings& settings) {
    auto duel = std::make_unique<Duel>(rink_fom(), match_scene(), match_text(), settings);
    duel->connect(0), duel->connect(1);
    EXPECT_TRUE(is_shown_to_both(*duel, MatchPhase::playing, 10.0));
    return duel;
  }
};

TEST_F(ANetworkMatch, IsCountedDownAndBegunAtTheSameInstantOnBothScreens) {
  Duel duel(rink_fom(), match_scene(), match_text(), {.delay_s = 0.05});
  duel.connect(0);
  duel.run(1.0);
  EXPECT_EQ(phase_shown(duel, 0), MatchPhase::waiting);
  duel.connect(1);
  ASSERT_TRUE(is_shown_to_both(duel, MatchPhase::countdown, 2.0));
  EXPECT_EQ(duel.client(0).sight().own_team, Team::left);
  EXPECT_EQ(duel.client(1).sight().own_team, Team::right);
  EXPECT_EQ(duel.client(0).sight().time, 0.0);
  ASSERT_TRUE(is_shown_to_both(duel, MatchPhase::playing, 4.0));
  EXPECT_NEAR(duel.client(0).sight().time, duel.client(1).sight().time, 0.02);
}

TEST_F(ANetworkMatch, AnswersAKeyInTheSameFrameAtAnyDelay) {
  for (const double delay_s : {0.0, 0.05, 0.2}) {
    const auto duel = started({.delay_s = delay_s});
    duel->run(0.5);
    const Vector2 before = duel->client(0).sight().things[0].position;
    duel->client(0).press(0, Key::up, true);
    duel->run(2.0 / 60.0 +
              1e-3);  // one frame to press it in, one to see a bat that has had time to move
    const double moved = duel->client(0).sight().things[0].position.y() - before.y();
    EXPECT_NEAR(moved, 0.5 * 8.0 / 3600.0, 0.3 * 0.5 * 8.0 / 3600.0)
        << "half the thrust times a frame squared; delay " << delay_s << " s";
  }
}

TEST_F(ANetworkMatch, IsStoppedAndResumedByEitherPlayer) {
  const auto duel = started({.delay_s = 0.05});
  duel->run(1.0);
  duel->client(1).pause(true);
  ASSERT_TRUE(is_shown_to_both(*duel, MatchPhase::paused, 1.0));
  duel->run(0.2);
  const double time = duel->client(0).sight().time;
  duel->run(5.0);
  EXPECT_EQ(duel->client(0).sight().time, time);
  EXPECT_EQ(duel->client(1).sight().time, time);
  EXPECT_NEAR(duel->server().game().now(), time, 1e-9);
  duel->client(0).pause(false);
  ASSERT_TRUE(is_shown_to_both(*duel, MatchPhase::countdown, 1.0));
  ASSERT_TRUE(is_shown_to_both(*duel, MatchPhase::playing, 4.0));
}

TEST_F(ANetworkMatch, WaitsForWhoVanishedAndGoesOnWhenSomebodyTakesTheSeat) {
  const auto duel = started({.delay_s = 0.02});
  duel->run(1.0);
  duel->client(1).press(0, Key::left, true);
  duel->run(0.5);
  duel->kill(1);
  ASSERT_TRUE(duel->run_until([&] { return phase_shown(*duel, 0) == MatchPhase::away; }, 10.0))
      << "it is noticed";
  duel->run(0.2);
  const double time = duel->server().game().now();
  duel->connect(1);
  ASSERT_TRUE(is_shown_to_both(*duel, MatchPhase::playing, 6.0));
  EXPECT_NEAR(duel->server().game().now(), time, 0.2);
  EXPECT_EQ(duel->server().game().keys_held(1).bits(), 0) << "nobody holds its keys";
  EXPECT_EQ(duel->server().hosted()->state().number, 1u);
}

TEST_F(ANetworkMatch, IsSeenByAWatcherWhoCanDoNothing) {
  const auto duel = started({.delay_s = 0.05, .players = {"chaser", "chaser"}});
  duel->run(2.0);
  duel->connect(Duel::watcher);
  duel->run(3.0);
  NetworkMatch& watcher = duel->client(Duel::watcher);
  EXPECT_EQ(watcher.hand_count(), 0u);
  EXPECT_EQ(watcher.sight().phase, MatchPhase::playing);
  EXPECT_FALSE(watcher.sight().own_team);
  EXPECT_EQ(watcher.sight().things.size(), duel->client(0).sight().things.size());
  EXPECT_NEAR(watcher.sight().time, duel->server().game().now(), 0.1);
  watcher.pause(true), watcher.rematch(), watcher.press(0, Key::up, true);
  duel->run(1.0);
  EXPECT_EQ(watcher.sight().phase, MatchPhase::playing);
  EXPECT_TRUE(watcher.sight().notice.empty());
}

TEST_F(ANetworkMatch, GoesOnWithTheSameScoreIfWhoVanishedIsBackWithinHalfAMinute) {
  const auto duel = started({.players = {"chaser-expert", "chaser-beginner"}});
  const auto goals = [&] {
    return duel->server().game().score().left + duel->server().game().score().right;
  };
  ASSERT_TRUE(duel->run_until([&] { return goals() >= 2; }, 300.0));
  duel->run(0.5);
  duel->kill(1);
  ASSERT_TRUE(duel->run_until([&] { return phase_shown(*duel, 0) == MatchPhase::away; }, 10.0));
  EXPECT_NEAR(duel->client(0).sight().remaining_s, 30.0, 0.1);
  const Score score = duel->server().game().score();
  const double time = duel->server().game().now();
  duel->run(29.0);
  ASSERT_EQ(phase_shown(*duel, 0), MatchPhase::away);
  EXPECT_EQ(duel->server().game().now(), time);
  duel->connect(1);
  ASSERT_TRUE(is_shown_to_both(*duel, MatchPhase::playing, 6.0));
  EXPECT_EQ(duel->client(1).sight().own_team, Team::right);
  EXPECT_EQ(duel->client(0).sight().score, score);
  EXPECT_EQ(duel->client(1).sight().score, score);
  EXPECT_EQ(duel->server().hosted()->state().number, 1u);
}

TEST_F(ANetworkMatch, IsWonAfterHalfAMinuteByWhoStaysAndAnotherMayTakeTheSeat) {
  const auto duel = started({});
  duel->run(1.0);
  duel->kill(0);
  ASSERT_TRUE(duel->run_until([&] { return phase_shown(*duel, 1) == MatchPhase::away; }, 10.0));
  const double from_s = duel->now_s();
  ASSERT_TRUE(duel->run_until([&] { return phase_shown(*duel, 1) == MatchPhase::over; }, 40.0));
  EXPECT_NEAR(duel->now_s() - from_s, 30.0, 0.1);
  EXPECT_EQ(duel->client(1).sight().winner, Team::right);
  duel->connect(0);
  ASSERT_TRUE(is_shown_to_both(*duel, MatchPhase::playing, 6.0));
  EXPECT_EQ(duel->server().hosted()->state().number, 2u);
}

TEST_F(ANetworkMatch, IsWonByWhoStays) {
  const auto duel = started({.times = {.patience_s = 5.0}});
  duel->run(1.0);
  duel->leave(0);
  ASSERT_TRUE(duel->run_until([&] { return phase_shown(*duel, 1) == MatchPhase::over; }, 8.0));
  EXPECT_EQ(duel->client(1).sight().winner, Team::right);
}

TEST_F(ANetworkMatch, GoesFromFaceOffToWinToRematchAndIsRecorded) {
  Duel duel(rink_fom(), match_scene(), match_text(),
            {.delay_s = 0.05, .seed = 2, .players = {"chaser-expert", "chaser-beginner"}});
  duel.connect(0), duel.connect(1);
  ASSERT_TRUE(is_shown_to_both(duel, MatchPhase::over, 600.0)) << "first to five";
  const MatchSight& sight = duel.client(0).sight();
  EXPECT_EQ(std::max(sight.score.left, sight.score.right), 5u);
  EXPECT_EQ(sight.winner, sight.score.left == 5 ? Team::left : Team::right);
  EXPECT_TRUE(sight.notice.empty()) << sight.notice;
  duel.client(0).rematch();
  duel.run(1.0);
  EXPECT_TRUE(duel.client(0).sight().wants_rematch);
  EXPECT_TRUE(duel.client(1).sight().other_wants_rematch);
  duel.client(1).rematch();
  ASSERT_TRUE(is_shown_to_both(duel, MatchPhase::countdown, 1.0));
  ASSERT_TRUE(is_shown_to_both(duel, MatchPhase::playing, 4.0));
  EXPECT_EQ(duel.client(1).sight().score, Score{});
  duel.run(20.0);
  EXPECT_TRUE(duel.client(0).sight().notice.empty()) << duel.client(0).sight().notice;
  duel.server().finish_record();
  const std::vector<KeyLog> records = duel.server().hosted()->take_finished();
  ASSERT_EQ(records.size(), 2u);
  for (const KeyLog& record : records) EXPECT_EQ(replay(record, match_scene()), *record.hash);
}

/// Means of matches, for a single one's error depends on when its players meet.
TEST_F(ANetworkMatch, IsShownAsItIsAtAnyDelay) {
  constexpr std::uint64_t matches = 4;
  for (const double delay_s : {0.0, 0.05, 0.1, 0.2}) {
    double own_p90 = 0.0, own_p99 = 0.0;
    for (std::uint64_t seed = 1; seed <= matches; ++seed) {
      const Feel feel = loadgen::feel_of(
          rink_fom(), match_scene(), match_text(),
          {.delay_s = delay_s, .seed = seed, .players = {"chaser", "chaser"}}, 60.0);
      EXPECT_TRUE(feel.is_replayed);
      EXPECT_GT(feel.keys, 50u) << "or the test shows nothing";
      EXPECT_EQ(feel.late_keys, 0u);
      EXPECT_LE(feel.own.p50, 0.5e-3)
          << "received states are rounded, and the keys are felt when their player counted on it";
      EXPECT_LE(feel.other.p50, 0.5e-3);
      EXPECT_LE(feel.puck.p50, 0.5e-3);
      own_p90 += feel.own.p90 / matches;
      own_p99 += feel.own.p99 / matches;
    }
    EXPECT_LE(own_p90, delay_s <= 0.1 ? 1e-3 : 0.1)
        << "the rest is the other's keys of the last round trip, which a shared puck passes on";
    EXPECT_LE(own_p99, delay_s == 0.0 ? 1e-3 : 0.25);
  }
}

/// A person presses and releases less than five keys a second over a match, as waypoint bots do;
/// chasers at the puck press more than twice as many.
TEST_F(ANetworkMatch, CostsAPlayerAtMostSixHundredBytesPerSecond) {
  for (const auto& [player, keys_per_s] : {std::pair("waypoint", 3.0), std::pair("chaser", 10.0)}) {
    const Feel feel = loadgen::feel_of(rink_fom(), match_scene(), match_text(),
                                       {.delay_s = 0.05, .players = {player, player}}, 60.0);
    EXPECT_GT(static_cast<double>(feel.keys) / 2.0 / feel.played_s, keys_per_s) << player;
    EXPECT_LE(feel.payload_bytes_per_s, 600.0) << player;
  }
}

/// What cannot be known is not shown: a tick, a way there and a way back, and some milliseconds
/// against jitter.
TEST_F(ANetworkMatch, ShowsTheOtherNoLaterThanItMust) {
  for (const double rate_hz : {60.0, 30.0})
    for (const double delay_s : {0.0, 0.05}) {
      const Feel feel = loadgen::feel_of(
          rink_fom(), match_scene(), match_text(),
          {.delay_s = delay_s, .rate_hz = rate_hz, .players = {"chaser", "chaser"}}, 30.0);
      const double least_s = 2.0 * delay_s + 1.0 / rate_hz;
      EXPECT_GE(feel.lead_s, 2.0 * delay_s);
      EXPECT_LE(feel.lead_s, least_s + 0.012) << rate_hz << " Hz, " << delay_s << " s";
      // Where it was within a tick in which it felt a key is not told, but foreseen from before:
      // half its thrust, 8 m/s^2, times the tick squared.
      EXPECT_LE(feel.other.p99, 0.5e-3 + 4.0 / (rate_hz * rate_hz)) << "and yet it is shown right";
    }
}

TEST_F(ANetworkMatch, IsShownAsItIsWhereDelaysVary) {
  const Feel feel =
      loadgen::feel_of(rink_fom(), match_scene(), match_text(),
                       {.delay_s = 0.05, .jitter_s = 0.01, .players = {"chaser", "chaser"}}, 60.0);
  EXPECT_LE(static_cast<double>(feel.late_keys), 0.1 * static_cast<double>(feel.keys));
  EXPECT_LE(feel.own.p50, 0.5e-3);
}

TEST_F(ANetworkMatch, EndsWithAReasonWhenTheServerVanishes) {
  rti::ConstantDelay link(0);
  rti::VirtualNetwork network(link);
  rti::VirtualEndpoint end(network);
  const ObjectModel model(rink_fom());
  NetworkMatch match(rink_fom(), model, end, end.connect("nobody"), {});
  network.advance_to(1'000'000);
  match.advance(1.0);
  match.advance(1.1);
  EXPECT_EQ(match.sight().phase, MatchPhase::lost);
  EXPECT_FALSE(match.sight().notice.empty());
}

}  // namespace
}  // namespace rink::game
