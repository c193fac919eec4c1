// The declared view: where it lies, and when a bat has left its middle.
#include "game/net/client/following_view.h"

#include <gtest/gtest.h>

namespace rink::game {
namespace {

constexpr Extent field{20.0f, 10.0f};

TEST(AFollowingView, IsASquareOfTheWantedAreaAndAMargin) {
  FollowingView view({.area = 16.0, .margin = 0.5});
  const im::Region& bounds = view.look_around({10.0f, 4.0f}, field);
  EXPECT_EQ(bounds, (im::Region{7.5, 1.5, 12.5, 6.5}));
  EXPECT_EQ(view.bounds(), bounds);
}

TEST(AFollowingView, TakesAFractionOfTheFieldIfNoAreaIsWanted) {
  FollowingView view({.fraction = 0.02});
  EXPECT_EQ(view.look_around({0.0f, 0.0f}, field), (im::Region{-1.0, -1.0, 1.0, 1.0}));
}

TEST(AFollowingView, IsLeftByHalfTheMarginInEitherDirection) {
  FollowingView view({.area = 4.0, .margin = 1.0});
  view.look_around({5.0f, 5.0f}, field);
  EXPECT_FALSE(view.is_left_by({5.25f, 5.25f}));
  EXPECT_TRUE(view.is_left_by({5.5f, 5.0f}));
  EXPECT_TRUE(view.is_left_by({5.0f, 4.0f}));
}

TEST(AFollowingView, WithoutAMarginIsLeftByAnyMotion) {
  FollowingView view({.area = 4.0});
  view.look_around({5.0f, 5.0f}, field);
  EXPECT_FALSE(view.is_left_by({5.0f, 5.0f}));
  EXPECT_TRUE(view.is_left_by({5.0f, 5.0001f}));
}

}  // namespace
}  // namespace rink::game
