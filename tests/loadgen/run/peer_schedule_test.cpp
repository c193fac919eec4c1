// What a run among peers has to do, and when.
#include "loadgen/run/peers/peer_schedule.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rink::loadgen {
namespace {

TEST(APeerSchedule, GivesEverythingOnceWhenItIsDue) {
  PeerSchedule schedule;
  schedule.plan_keys({{.time = 1.0, .player = 3}, {.time = 2.0, .player = 4}});
  schedule.plan_samples({0.5, 1.5}, {1.25});
  EXPECT_EQ(schedule.next_s(), 0.5);
  EXPECT_EQ(schedule.take_decision(0.4), std::nullopt);
  EXPECT_EQ(schedule.take_decision(0.5), 0.5);
  EXPECT_EQ(schedule.take_key(10.0, 10.9), nullptr);
  const game::InputEvent* key = schedule.take_key(10.0, 11.0);
  ASSERT_NE(key, nullptr);
  EXPECT_EQ(key->player, 3u);
  EXPECT_EQ(schedule.take_key(10.0, 11.0), nullptr);
  EXPECT_EQ(schedule.take_sample(1.25), 1.25);
  EXPECT_EQ(schedule.take_sample(9.0), std::nullopt);
  EXPECT_EQ(schedule.next_s(), 1.5);
  EXPECT_EQ(schedule.take_decision(9.0), 1.5);
  EXPECT_NE(schedule.take_key(10.0, 12.0), nullptr);
  EXPECT_TRUE(std::isinf(schedule.next_s()));
}

}  // namespace
}  // namespace rink::loadgen
