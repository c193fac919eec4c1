// How boldly windows are played after some that went wrong, were of no use or had no room.
#include "game/physics/slabs/pace.h"

#include <gtest/gtest.h>

namespace rink::physics::test {
namespace {

TEST(Pace, BlocksWiderAfterAWrongWindowAndGetsShorterAfterAnother) {
  Pace pace;
  pace.note(false, false);
  EXPECT_TRUE(pace.blocks_wider());
  EXPECT_EQ(pace.share(), 1.0);
  pace.note(false, false);
  EXPECT_LT(pace.share(), 1.0);
}

TEST(Pace, IsEverMorePatientWhileWindowsAreNotWorthIt) {
  Pace pace;
  int in_order_before = 0;
  for (int again = 0; again < 5; ++again) {
    pace.note(true, false);
    int in_order = 0;
    for (; pace.is_patient(); ++in_order) pace.note_in_order();
    EXPECT_GE(in_order, in_order_before);
    in_order_before = in_order;
  }
  EXPECT_GT(in_order_before, 4);
  EXPECT_FALSE(pace.blocks_wider());
}

/// A budget that is nearly spent tells nothing about tiles.
TEST(Pace, KeepsItsWindowsWhereABudgetHadNoRoomForThem) {
  Pace pace;
  for (int again = 0; again < 5; ++again) {
    pace.note_no_room();
    while (pace.is_patient()) pace.note_in_order();
  }
  EXPECT_FALSE(pace.blocks_wider());
  EXPECT_EQ(pace.share(), 1.0);
}

}  // namespace
}  // namespace rink::physics::test
