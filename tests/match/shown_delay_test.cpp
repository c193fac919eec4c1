// How far behind the others are shown, and how much a connection carries.
#include "game/match/shown_delay.h"

#include <gtest/gtest.h>

#include "game/match/traffic_rate.h"

namespace rink::game {
namespace {

TEST(AShownDelay, ChangesNoFasterThanTimeMayBend) {
  ShownDelay delay;
  delay.move(1.0, 0.2);
  EXPECT_EQ(delay.seconds(), 0.2 * ShownDelay::time_bend);
  delay.move(0.0, 10.0);
  EXPECT_EQ(delay.seconds(), 0.0);
  EXPECT_EQ(delay.measured_or(0.3), 0.3) << "nothing was heard yet";
}

TEST(ATrafficRate, IsThatOfTheLastWholeSecond) {
  TrafficRate rate;
  EXPECT_EQ(rate.measure(1000, 10.0), 0.0);
  EXPECT_EQ(rate.measure(1500, 10.5), 0.0) << "no second has passed";
  EXPECT_EQ(rate.measure(3000, 12.0), 1000.0);
  EXPECT_EQ(rate.measure(9000, 12.9), 1000.0);
}

}  // namespace
}  // namespace rink::game
