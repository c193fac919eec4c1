// What counts as the silence of the other side of a connection, and what does not.
#include "rti/wire/silence.h"

#include <gtest/gtest.h>

namespace rink::rti {
namespace {

constexpr double lost_after_s = 5.0;

TEST(ASilence, LastsAsLongAsNothingIsSaid) {
  Silence silence;
  for (int step = 0; step < 12; ++step) silence.advance(0.25, false, lost_after_s);
  EXPECT_EQ(silence.lasted_s(), 3.0);
}

TEST(ASilence, BeginsAgainAtTheAdvanceAfterAWord) {
  Silence silence;
  silence.advance(2.0, false, lost_after_s);
  silence.broken();
  EXPECT_EQ(silence.lasted_s(), 2.0);
  silence.advance(1.0, false, lost_after_s);
  EXPECT_EQ(silence.lasted_s(), 0.0);
  silence.advance(1.0, false, lost_after_s);
  EXPECT_EQ(silence.lasted_s(), 1.0);
}

TEST(ASilence, CountsAPauseOfTheListenerOnceAtMost) {
  Silence silence;
  silence.advance(3600.0, false, lost_after_s);
  EXPECT_EQ(silence.lasted_s(), lost_after_s);
  silence.advance(0.5, false, lost_after_s);
  EXPECT_EQ(silence.lasted_s(), 5.5);
}

TEST(ASilence, IsExcusedWhileWordsMayWaitUnreadForFourTimesThePatience) {
  Silence silence;
  for (int second = 0; second < 20; ++second) silence.advance(1.0, true, lost_after_s);
  EXPECT_EQ(silence.lasted_s(), 0.0);
  for (int second = 0; second < 5; ++second) silence.advance(1.0, true, lost_after_s);
  EXPECT_EQ(silence.lasted_s(), 5.0);
}

TEST(ASilence, IsExcusedAnewAfterAWordThatCameWhileTheListenerWasBehind) {
  Silence silence;
  for (int second = 0; second < 20; ++second) silence.advance(1.0, true, lost_after_s);
  silence.broken();
  silence.advance(1.0, true, lost_after_s);
  for (int second = 0; second < 20; ++second) silence.advance(1.0, true, lost_after_s);
  EXPECT_EQ(silence.lasted_s(), 0.0);
}

}  // namespace
}  // namespace rink::rti
