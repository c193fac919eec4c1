// Simulated time of a crowd, by the clock and by turns.
#include "loadgen/run/bots/crowd_clock.h"

#include <gtest/gtest.h>

namespace rink::loadgen {
namespace {

TEST(ACrowdClock, CountsFromTheInstantOfSimulatedZero) {
  CrowdClock clock;
  EXPECT_FALSE(clock.has_started());
  EXPECT_FALSE(clock.runs());
  clock.start(100.0);
  EXPECT_TRUE(clock.runs());
  EXPECT_EQ(clock.due_s(2.5), 102.5);
  EXPECT_EQ(clock.simulated_s(103.0), 3.0);
  EXPECT_FALSE(clock.has_come(2.5, 102.25));
  EXPECT_TRUE(clock.has_come(2.5, 102.5));
}

TEST(ACrowdClock, StandsAtTheNewestTurnWhereTheServerWaits) {
  CrowdClock clock;
  clock.take_turn(0.5);
  clock.start(100.0);
  EXPECT_FALSE(clock.runs()) << "nothing comes due by the clock";
  clock.take_turn(0.25);
  EXPECT_EQ(clock.simulated_s(200.0), 0.5);
  EXPECT_TRUE(clock.has_come(0.5, 0.0));
  EXPECT_FALSE(clock.has_come(0.75, 200.0));
}

}  // namespace
}  // namespace rink::loadgen
