// What a predicted rink is made of: pending keys, a track, and blends.
#include <gtest/gtest.h>

#include <cmath>

#include "game/match/jump_blends.h"
#include "game/match/pending_keys.h"
#include "game/match/rink_track.h"

namespace rink::game {
namespace {

TEST(PendingKeys, AreAppliedInOrderAndAgainUntilTheyAreFelt) {
  PendingKeys keys;
  keys.press(Key::up, true, 1.0);
  keys.press(Key::up, false, 0.5);  // not before the last one
  EXPECT_EQ(keys.take_until(0.9), nullptr);
  EXPECT_EQ(keys.next_instant(), 1.0);
  ASSERT_NE(keys.take_until(1.0), nullptr);
  const PendingKeys::PressedKey* second = keys.take_until(1.0);
  ASSERT_NE(second, nullptr);
  EXPECT_FALSE(second->is_down);
  EXPECT_TRUE(std::isinf(keys.next_instant()));
  keys.felt(1);
  EXPECT_EQ(keys.count(), 1u);
  ASSERT_NE(keys.take_until(1.0), nullptr) << "the one that is not felt";
  EXPECT_EQ(keys.take_until(1.0), nullptr);
  keys.apply_again();
  EXPECT_NE(keys.take_until(1.0), nullptr);
}

TEST(PendingKeys, OfEarlierMatchesAreOfNoAccount) {
  PendingKeys keys;
  keys.count_from(7);
  keys.press(Key::left, true, 0.0);
  keys.felt(7);
  EXPECT_EQ(keys.count(), 1u);
  keys.felt(8);
  EXPECT_EQ(keys.count(), 0u);
}

RinkSample at_x(double time, double x) { return {time, {Vector2(x, 0.0)}, {Vector2(1.0, 0.0)}}; }

TEST(ARinkTrack, LiesOnChordsBetweenItsSamples) {
  RinkTrack track;
  track.add(at_x(0.0, 0.0));
  track.add(at_x(1.0, 0.2));
  EXPECT_NEAR(track.at(0, 0.25).position.x(), 0.05, 1e-15);
  EXPECT_EQ(track.at(0, -1.0).position.x(), 0.0);
  EXPECT_EQ(track.at(0, 9.0).position.x(), 0.2);
}

TEST(ARinkTrack, DoesNotCarryWhatWasPutElsewhereAcrossTheField) {
  RinkTrack track;
  track.add(at_x(0.0, 0.0));
  track.add(at_x(1.0, 1.1 * blended_furthest));
  EXPECT_EQ(track.at(0, 0.999).position.x(), 0.0);
}

TEST(ARinkTrack, DropsTheFutureAndForgetsThePast) {
  RinkTrack track;
  for (int k = 0; k < 5; ++k) track.add(at_x(k, 0.1 * k));
  track.drop_from(3.0);
  EXPECT_EQ(track.end(), 2.0);
  track.forget_before(1.5);
  EXPECT_NEAR(track.at(0, 1.5).position.x(), 0.15, 1e-15);
  EXPECT_EQ(track.at(0, 0.0).position.x(), 0.1) << "from 1 s on";
}

TEST(JumpBlends, CountJumpsByWhoseTheyAreAndBlendThemAway) {
  JumpBlends blends(2, 1, 0);
  blends.jump(0, {0.01, 0.0}, 1.0);
  blends.jump(1, {0.02, 0.0}, 1.0);
  EXPECT_EQ(blends.of_own_bat().visible_count, 1u);
  EXPECT_EQ(blends.of_other_bats().greatest, 0.02);
  EXPECT_EQ(blends.at(0, 1.0), physics::Vector2(0.01, 0.0));
  EXPECT_EQ(blends.at(0, 1.0 + Blend::duration), physics::Vector2(0.0, 0.0));
  blends.jump(2, {2.0 * blended_furthest, 0.0}, 1.0);
  EXPECT_EQ(blends.of_pucks().visible_count, 0u) << "a puck that was put on a spot";
  EXPECT_EQ(blends.at(2, 1.0), physics::Vector2(0.0, 0.0));
}

}  // namespace
}  // namespace rink::game
