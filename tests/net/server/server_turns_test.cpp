// When a server may play the next tick, and what it asks the RTI and tells its players.
#include "game/net/server/players/server_turns.h"

#include <gtest/gtest.h>

namespace rink::game {
namespace {

TEST(ServerTurns, ComeWhenAllPlayersHaveTakenTheirs) {
  const ServerTurns turns({.is_synchronous = true});
  EXPECT_FALSE(turns.may_step(false, 1.0, 9.0));
  EXPECT_TRUE(turns.may_step(true, 1.0, 0.0));
}

TEST(ServerTurns, ComeInLogicalTimeHalfATickAfterTheLast) {
  const ServerTurns turns({.tick_s = 0.1, .is_time_managed = true});
  EXPECT_FALSE(turns.may_step(true, 1.0, 1.04));
  EXPECT_TRUE(turns.may_step(false, 1.0, 1.06));
}

TEST(ServerTurns, AskForLogicalTimeOnceTheStartIsPassed) {
  ServerTurns turns({.tick_s = 0.1, .is_time_managed = true});
  EXPECT_FALSE(turns.wanted(1.0, 0.0));
  turns.start();
  ASSERT_TRUE(turns.wanted(1.0, 0.0));
  EXPECT_DOUBLE_EQ(*turns.wanted(1.0, 0.0), 1.05);
  EXPECT_FALSE(turns.wanted(1.0, 1.06)) << "it was granted already";
  ServerTurns by_timer({.tick_s = 0.1});
  by_timer.start();
  EXPECT_FALSE(by_timer.wanted(1.0, 0.0));
}

TEST(ServerTurns, TellPlayersOfAStepOnceWhereNobodyElseDoes) {
  for (const bool is_synchronous : {false, true})
    for (const bool is_time_managed : {false, true}) {
      ServerTurns turns({.is_synchronous = is_synchronous, .is_time_managed = is_time_managed});
      EXPECT_FALSE(turns.take_step());
      turns.stepped(true);
      EXPECT_EQ(turns.take_step(), is_synchronous && !is_time_managed);
      EXPECT_FALSE(turns.take_step());
      EXPECT_EQ(turns.concerns_players(), is_synchronous || is_time_managed);
    }
}

TEST(ServerTurns, WaitForNobodyWithinATickOfLogicalTime) {
  for (const bool is_time_managed : {false, true}) {
    ServerTurns turns({.tick_s = 0.1, .is_synchronous = true, .is_time_managed = is_time_managed});
    turns.stepped(false);
    EXPECT_EQ(turns.is_within_tick(), is_time_managed);
    EXPECT_EQ(turns.may_step(false, 1.07, 1.06), is_time_managed);
    turns.stepped(true);
    EXPECT_FALSE(turns.is_within_tick());
    EXPECT_FALSE(turns.may_step(false, 1.1, 1.06));
  }
}

TEST(ServerTurns, TellWhoComesAfterTheCallThatHeIsLate) {
  ServerTurns turns({.tick_s = 0.05, .is_synchronous = true});
  EXPECT_EQ(turns.pace().is_late, 0);
  EXPECT_EQ(turns.pace().is_synchronous, 1);
  EXPECT_DOUBLE_EQ(turns.pace().ticks_per_second, 20.0);
  turns.call();
  EXPECT_EQ(turns.pace().is_late, 1);
}

}  // namespace
}  // namespace rink::game
