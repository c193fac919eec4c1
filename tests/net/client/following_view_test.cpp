// The declared view: where it lies, and when a bat has left its middle.
#include "game/net/following_view.h"

#include <gtest/gtest.h>

#include "game/net/view.h"

namespace rink::game {
namespace {

TEST(AFollowingView, IsASquareOfTheWantedAreaAndAMargin) {
  FollowingView view(0.5);
  const im::Region& bounds = view.look_around({10.0, 4.0}, view_half_side(16.0, 0.05, 20.0, 10.0));
  EXPECT_EQ(bounds, (im::Region{7.5, 1.5, 12.5, 6.5}));
  EXPECT_EQ(view.bounds(), bounds);
}

TEST(AFollowingView, TakesAFractionOfTheFieldIfNoAreaIsWanted) {
  FollowingView view(0.0);
  EXPECT_EQ(view.look_around({0.0, 0.0}, view_half_side(0.0, 0.02, 20.0, 10.0)),
            (im::Region{-1.0, -1.0, 1.0, 1.0}));
}

TEST(AFollowingView, IsLeftByHalfTheMarginInEitherDirection) {
  FollowingView view(1.0);
  view.look_around({5.0, 5.0}, 1.0);
  EXPECT_FALSE(view.is_left_by({5.25, 5.25}));
  EXPECT_TRUE(view.is_left_by({5.5, 5.0}));
  EXPECT_TRUE(view.is_left_by({5.0, 4.0}));
}

TEST(AFollowingView, WithoutAMarginIsLeftByAnyMotion) {
  FollowingView view(0.0);
  view.look_around({5.0, 5.0}, 1.0);
  EXPECT_FALSE(view.is_left_by({5.0, 5.0}));
  EXPECT_TRUE(view.is_left_by({5.0, 5.0001}));
}

}  // namespace
}  // namespace rink::game
