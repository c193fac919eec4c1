// A client's turns: by the server's word, in logical time, and when it falls behind.
#include "game/net/client/turn_taker.h"

#include <gtest/gtest.h>

#include <limits>

namespace rink::game {
namespace {

constexpr double rate_hz = 10.0;
constexpr Pace by_turns{.ticks_per_second = rate_hz, .is_synchronous = 1};
constexpr Pace by_time{.ticks_per_second = rate_hz, .is_time_managed = 1};
constexpr Pace by_both{.ticks_per_second = rate_hz, .is_synchronous = 1, .is_time_managed = 1};

TEST(TurnTaker, IsIdleUntilItHearsThePace) {
  const TurnTaker turns;
  EXPECT_FALSE(turns.has_turn() || turns.is_synchronous() || turns.is_time_managed());
  EXPECT_TRUE(turns.is_time_kept(false, false));
}

TEST(TurnTaker, HasTheTurnAfterEachTickItIsToldOf) {
  TurnTaker turns;
  EXPECT_TRUE(turns.receive(by_turns, 0.3));
  EXPECT_TRUE(turns.has_turn());
  EXPECT_EQ(turns.turn_s(), 0.3);
  turns.end_turn();
  EXPECT_FALSE(turns.has_turn());
  EXPECT_FALSE(turns.receive(by_turns, 0.4)) << "the pace it knows already";
  EXPECT_TRUE(turns.has_turn());
  EXPECT_EQ(turns.turn_s(), 0.4);
}

TEST(TurnTaker, KeepsLogicalTimeOnceItIsConstrainedAndIfItSpeaksRegulating) {
  TurnTaker hearing, speaking;
  hearing.receive(by_time, 0.0);
  speaking.receive(by_both, 0.0);
  EXPECT_FALSE(hearing.is_time_kept(false, true));
  EXPECT_TRUE(hearing.is_time_kept(true, false));
  EXPECT_FALSE(speaking.is_time_kept(true, false));
  EXPECT_TRUE(speaking.is_time_kept(true, true));
}

TEST(TurnTaker, BeginsWithItsOwnTurnUnlessItIsLate) {
  TurnTaker turns;
  turns.receive(by_both, 0.0);
  EXPECT_FALSE(turns.has_turn()) << "logical time has not begun";
  EXPECT_FALSE(turns.begin());
  EXPECT_TRUE(turns.has_turn());
  TurnTaker late;
  Pace pace = by_both;
  pace.is_late = 1;
  late.receive(pace, 0.0);
  EXPECT_TRUE(late.is_late());
  EXPECT_TRUE(late.begin());
  EXPECT_FALSE(late.has_turn());
}

TEST(TurnTaker, AsksForOneTickAfterTheOtherWhereAllWaitForEachOther) {
  TurnTaker turns;
  turns.receive(by_both, 0.0);
  const TickGrid grid{rate_hz};
  for (std::uint64_t tick = 1; tick < 20; ++tick) {
    const TurnTaker::Request request = turns.next(grid.received(tick - 1));
    EXPECT_EQ(request.time, grid.received(tick));
    EXPECT_FALSE(request.asks_bounds);
    EXPECT_FALSE(turns.grant(request.time));
    EXPECT_TRUE(turns.has_turn());
    EXPECT_DOUBLE_EQ(turns.turn_s(), static_cast<double>(tick) / rate_hz);
    turns.end_turn();
  }
}

TEST(TurnTaker, AsksNowAndThenHowFarTheServerIsAndCatchesUp) {
  TurnTaker turns;
  turns.receive(by_time, 0.0);
  const TickGrid grid{rate_hz};
  EXPECT_TRUE(turns.next(0.0).asks_bounds);
  EXPECT_FALSE(turns.grant(grid.received(1))) << "the answer comes first";
  EXPECT_FALSE(turns.has_turn());
  EXPECT_TRUE(turns.receive_bounds(grid.received(30)));
  EXPECT_FALSE(turns.receive_bounds(grid.received(40))) << "nobody asked";
  const TurnTaker::Request request = turns.next(grid.received(1));
  EXPECT_EQ(request.time, grid.received(30));
  EXPECT_FALSE(request.asks_bounds);
  EXPECT_TRUE(turns.grant(request.time));
}

TEST(TurnTaker, GoesOnTickByTickWhereNobodyBoundsTheTime) {
  TurnTaker turns;
  turns.receive(by_time, 0.0);
  turns.next(0.0);
  EXPECT_TRUE(turns.receive_bounds(std::numeric_limits<double>::infinity()));
  const TickGrid grid{rate_hz};
  EXPECT_EQ(turns.next(grid.received(4)).time, grid.received(5));
}

}  // namespace
}  // namespace rink::game
