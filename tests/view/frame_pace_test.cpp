// How many pictures a window draws where the screen sets no pace.
#include "game/view/window/frame_pace.h"

#include <gtest/gtest.h>

namespace rink::view {
namespace {

TEST(AFramePace, DrawsNoMoreThanItsLimit) {
  FramePace pace(120.0);
  pace.touched(1.0);
  EXPECT_DOUBLE_EQ(pace.due_s(false, 2.0), 2.0 + 1.0 / 120.0);
  EXPECT_DOUBLE_EQ(pace.due_s(false, 100.0), 100.0 + 1.0 / 120.0) << "a match never rests";
}

TEST(AFramePace, RestsInAMenuThatNobodyTouches) {
  FramePace pace(120.0);
  pace.touched(1.0);
  EXPECT_DOUBLE_EQ(pace.due_s(true, 5.9), 5.9 + 1.0 / 120.0);
  EXPECT_FALSE(pace.rests(true, 5.9));
  EXPECT_TRUE(pace.rests(true, 6.0));
  EXPECT_DOUBLE_EQ(pace.due_s(true, 6.0), 7.0);
  pace.touched(6.5);
  EXPECT_FALSE(pace.rests(true, 6.5)) << "it is awake at once";
  EXPECT_FALSE(pace.rests(false, 60.0));
}

}  // namespace
}  // namespace rink::view
