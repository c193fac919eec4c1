// The server's clock from questions and answers, with both ways as unequal as they like.
#include <gtest/gtest.h>

#include <cmath>

#include "game/match/server_clock.h"

namespace rink::game {
namespace {

/// Asks and answers for `seconds` over ways of `there_s` and `back_s`; the server's clock is ahead
/// by `ahead_s`.
void converse(ServerClock& clock, double& now_s, double seconds, double there_s, double back_s,
              double ahead_s) {
  for (const double until = now_s + seconds; now_s < until; now_s += 1.0 / 60.0) {
    clock.advance(now_s);
    if (const auto number = clock.ask(now_s)) {
      const double asked_s = now_s;
      now_s += there_s + back_s;
      clock.answered(*number, asked_s + there_s + ahead_s, now_s);
    }
  }
}

TEST(AServerClock, TellsWhenWhatIsSentArrivesHoweverTheRoundTripIsShared) {
  for (const auto& [there_s, back_s] :
       {std::pair(0.05, 0.05), std::pair(0.09, 0.01), std::pair(0.01, 0.09)}) {
    ServerClock clock;
    double now_s = 100.0;
    EXPECT_FALSE(clock.is_set());
    converse(clock, now_s, 5.0, there_s, back_s, 1234.5);
    ASSERT_TRUE(clock.is_set());
    EXPECT_NEAR(clock.arrival(now_s), now_s + there_s + 1234.5, 6e-3) << "and a little to spare";
    EXPECT_GE(clock.arrival(now_s), now_s + there_s + 1234.5);
    EXPECT_NEAR(clock.ping_s(), 0.1, 1e-9);
    EXPECT_NEAR(clock.delay(0.02), 0.1 + 0.02, 6e-3);
    EXPECT_EQ(clock.loss(), 0.0);
  }
}

TEST(AServerClock, NeitherJumpsNorStopsWhenTheDelayChanges) {
  ServerClock clock;
  double now_s = 0.0;
  converse(clock, now_s, 5.0, 0.02, 0.02, 0.0);
  double before = clock.arrival(now_s), before_s = now_s;
  for (int step = 0; step < 300; ++step) {
    converse(clock, now_s, 1.0 / 60.0, 0.08, 0.02, 0.0);
    const double passed = now_s - before_s, moved = clock.arrival(now_s) - before;
    EXPECT_GE(moved, 0.89 * passed);
    EXPECT_LE(moved, 1.11 * passed);
    before = clock.arrival(now_s), before_s = now_s;
  }
  EXPECT_GE(clock.arrival(now_s), now_s + 0.08);
}

TEST(AServerClock, DoesNotCountOnWhatWasHeldUp) {
  ServerClock clock;
  double now_s = 0.0;
  converse(clock, now_s, 0.2, 0.25, 0.15, 0.0);  // the window opens
  converse(clock, now_s, 3.0, 0.002, 0.002, 0.0);
  EXPECT_NEAR(clock.arrival(now_s), now_s + 0.002, 6e-3);
  converse(clock, now_s, 0.01, 1.9, 0.1, 0.0);  // the server is stopped for two seconds
  for (int second = 0; second < 20; ++second) {
    converse(clock, now_s, 1.0, 0.002, 0.002, 0.0);
    EXPECT_NEAR(clock.arrival(now_s), now_s + 0.002, 6e-3) << second;
  }
  converse(clock, now_s, 20.0, 0.3, 0.3, 0.0);  // the way has become longer
  EXPECT_NEAR(clock.arrival(now_s), now_s + 0.3, 6e-3);
}

TEST(AServerClock, CountsQuestionsWithoutAnswerAndIgnoresAnswersToNone) {
  ServerClock clock;
  clock.answered(7, 1.0, 1.0);
  EXPECT_FALSE(clock.is_set());
  for (double now_s = 0.0; now_s < 10.0; now_s += 0.05) {
    if (const auto number = clock.ask(now_s); number && *number % 2 == 0) {
      clock.answered(*number, std::nan(""), now_s);
      clock.answered(*number, now_s, now_s + 0.01);
      clock.answered(*number, 1e6, now_s + 0.02);
    }
    clock.advance(now_s + 0.03);
    clock.check();
  }
  EXPECT_NEAR(clock.loss(), 0.5, 0.1);
  EXPECT_NEAR(clock.arrival(10.0), 10.0, 0.01);
}

}  // namespace
}  // namespace rink::game
