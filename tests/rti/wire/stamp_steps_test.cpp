// Stamps that travel as steps from the one before: short at every tick, and exact at any.
#include "rti/wire/stamp_steps.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace rink::rti::testing {
namespace {

constexpr std::size_t first_two = 2;

/// Both ends of a connection.
struct SteppedStamps {
  StampSteps sender, receiver;
  /// The bytes of the message that leads to `stamp`.
  std::size_t size_of_step_to(const Stamp& stamp) {
    StampStepMessage message = steps_to(sender, stamp).value_or(step_to(sender, stamp));
    Stamp reached, heard;
    EXPECT_TRUE(follow(sender, message, reached));
    EXPECT_TRUE(follow(receiver, message, heard));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(heard.time), std::bit_cast<std::uint64_t>(stamp.time));
    EXPECT_EQ(heard.tag, stamp.tag);
    EXPECT_EQ(reached, stamp);
    return measure(message);
  }
};

TEST(StampSteps, OfATickTakeTwoBytesAlsoWhereTheTimesExponentChanges) {
  for (const double rate_hz : {20.0, 30.0, 60.0, 1000.0}) {
    SteppedStamps pair;
    for (std::uint64_t k = 1; k <= 20'000; ++k) {
      const std::size_t size = pair.size_of_step_to({static_cast<double>(k) / rate_hz, 9 * k});
      if (k > first_two) {
        ASSERT_EQ(size, 2u) << "tick " << k << " at " << rate_hz << " Hz";
      }
    }
  }
}

TEST(StampSteps, OfSeveralTicksAtOnceAreCounted) {
  SteppedStamps pair;
  std::uint64_t tick = 0;
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const std::uint64_t count = i < 3 ? 1 : 1 + random() % 64;
    tick += count;
    const std::size_t size = pair.size_of_step_to({static_cast<double>(tick) / 20.0, 0});
    if (i >= 3) {
      EXPECT_LE(size, count == 1 ? 2u : 5u) << "tick " << tick;
    }
  }
}

TEST(StampSteps, LeadToAnyStampExactly) {
  SteppedStamps pair;
  std::mt19937_64 random(2);
  for (int i = 0; i < 100'000; ++i) {
    double time = std::bit_cast<double>(random());
    if (i % 3 == 0) time = static_cast<double>(random() % 1000) / 64.0;
    if (i % 7 == 0) time = i % 2 == 0 ? -0.0 : 0.0;
    if (i % 1001 == 0) time = std::numeric_limits<double>::max() * (i % 2 == 0 ? 1.0 : -1.0);
    if (!std::isfinite(time)) continue;
    pair.size_of_step_to({time, random() >> random() % 64});
  }
}

TEST(StampSteps, ToNoTimeAreRefused) {
  StampSteps steps;
  Stamp stamp;
  EXPECT_FALSE(follow(steps, {0, zigzag(0x7ff0000000000000), 0}, stamp)) << "an infinite time";
  EXPECT_FALSE(follow(steps, {0, zigzag(0x7ff8000000000000), 0}, stamp)) << "no number";
  const double most = std::numeric_limits<double>::max();
  ASSERT_TRUE(follow(steps, {0, zigzag(std::bit_cast<std::int64_t>(most)), 0}, stamp));
  EXPECT_EQ(stamp.time, most);
  EXPECT_FALSE(follow(steps, {1, 0, 0}, stamp)) << "twice the greatest";
}

}  // namespace
}  // namespace rink::rti::testing
