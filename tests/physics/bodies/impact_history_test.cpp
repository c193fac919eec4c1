// From how many impacts on, and how dense ones, bodies are pressed or have no room: each number of
// docs/physics.md ("Degenerate contact") from both sides.
#include "game/physics/bodies/impact_history.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/physics/bodies/loose_bodies.h"

namespace rink::physics::test {
namespace {

// s; the rink's own, and the speed [m/s] below which an impact is slow.
constexpr double tau = 5e-4, slow_speed = 0.5 * 20.0 * tau, fast_speed = 1.0;

/// Two pucks that meet, and a post.
struct MetPucks : LooseBodies {
  std::uint32_t one, two, post;
  Contact contact, at_post;

  MetPucks()
      : LooseBodies(rink_of(4, 4)),
        one(add_puck({1.0, 1.0})),
        two(add_puck({1.0625, 1.0})),
        post(add_post({2.0, 1.0})),
        contact{one, two, {}},
        at_post{one, post, {}} {}

  bool is_pressed(double approach, double time) const {
    return history.is_pressed_hard(contact, approach, time);
  }
  void impact(std::uint32_t body, int times, double time) {
    for (int i = 0; i < times; ++i) history.note_impact(body, time);
  }
};

TEST(ImpactHistory, TakesEightSlowImpactsWithinTheContactTimeForPressure) {
  for (const bool is_partner : {false, true}) {
    MetPucks pucks;
    pucks.impact(is_partner ? pucks.two : pucks.one, 7, 1.0);
    EXPECT_FALSE(pucks.is_pressed(slow_speed, 1.0));
    pucks.impact(is_partner ? pucks.two : pucks.one, 1, 1.0 + 0.9 * tau);
    EXPECT_TRUE(pucks.is_pressed(slow_speed, 1.0 + 0.9 * tau));
    EXPECT_FALSE(pucks.is_pressed(fast_speed, 1.0 + 0.9 * tau));
  }
}

TEST(ImpactHistory, TakesTwentyFourImpactsAtAnySpeedForPressure) {
  MetPucks pucks;
  pucks.impact(pucks.one, 23, 1.0);
  EXPECT_FALSE(pucks.is_pressed(fast_speed, 1.0));
  pucks.impact(pucks.one, 1, 1.0);
  EXPECT_TRUE(pucks.is_pressed(fast_speed, 1.0));
}

TEST(ImpactHistory, BeginsToCountAnewAfterAContactTime) {
  MetPucks pucks;
  pucks.impact(pucks.one, 7, 1.0);
  pucks.impact(pucks.one, 7, 1.0 + 1.1 * tau);
  EXPECT_FALSE(pucks.is_pressed(slow_speed, 1.0 + 1.1 * tau));
  pucks.impact(pucks.one, 1, 1.0 + 1.1 * tau);
  EXPECT_TRUE(pucks.is_pressed(slow_speed, 1.0 + 1.1 * tau));
}

/// What cannot move has no rhythm of its own.
TEST(ImpactHistory, AsksNothingOfWhatIsFixed) {
  MetPucks pucks;
  pucks.impact(pucks.post, 100, 1.0);
  EXPECT_FALSE(pucks.history.is_pressed_hard(pucks.at_post, slow_speed, 1.0));
  const Contact wall{pucks.one, partner::wall_left, {}};
  EXPECT_FALSE(pucks.history.is_pressed_hard(wall, slow_speed, 1.0));
}

TEST(ImpactHistory, TakesASlowImpactSoonAfterAHopForPressure) {
  MetPucks pucks;
  pucks.history.note_hop(std::vector{pucks.one}, 1.0);
  EXPECT_TRUE(pucks.is_pressed(slow_speed, 1.0 + 3.9 * tau));
  EXPECT_FALSE(pucks.is_pressed(fast_speed, 1.0 + 3.9 * tau));
  EXPECT_FALSE(pucks.is_pressed(slow_speed, 1.0 + 4.1 * tau));
}

TEST(ImpactHistory, CountsHopsAsASeriesWhileTheyFollowWithinEightContactTimes) {
  MetPucks pucks;
  double time = 1.0;
  for (std::uint32_t hop = 1; hop <= 5; ++hop, time += 7.9 * tau) {
    pucks.history.note_hop(std::vector{pucks.one, pucks.two}, time);
    EXPECT_EQ(pucks.history.hops(pucks.one), hop);
    EXPECT_EQ(pucks.history.hops(pucks.two), hop);
  }
  pucks.history.note_hop(std::vector{pucks.one}, time + 0.2 * tau);
  EXPECT_EQ(pucks.history.hops(pucks.one), 1u);
  EXPECT_EQ(pucks.history.hops(pucks.two), 5u);
  pucks.history.forget_hops(pucks.two);
  EXPECT_EQ(pucks.history.hops(pucks.two), 0u);
}

/// An elastic series between unequal masses ends before that.
TEST(ImpactHistory, GivesUpRoomAfterTenThousandMeetingsAtOneInstantAndHopeAfterTwice) {
  MetPucks pucks;
  const Contact other_way{pucks.two, partner::wall_top, {}};
  for (int meeting = 1; meeting <= 20'001; ++meeting) {
    pucks.history.count_meeting(pucks.contact, 1.0);
    ASSERT_EQ(pucks.history.is_jammed(other_way), meeting > 10'000) << meeting;
    ASSERT_EQ(pucks.history.is_stalled(pucks.contact), meeting > 20'000) << meeting;
  }
  pucks.history.count_meeting(pucks.contact, 2.0);
  EXPECT_FALSE(pucks.history.is_jammed(pucks.contact));
}

/// Where bodies may start in overlap. Both are counted, also when one has had its fill already.
TEST(ImpactHistory, FindsABodyStuckAfterAHundredImpactsAtOneInstant) {
  MetPucks pucks;
  for (int impact = 1; impact <= 100; ++impact)
    ASSERT_FALSE(pucks.history.is_stuck(pucks.at_post, 1.0)) << impact;
  for (int impact = 1; impact <= 101; ++impact)
    ASSERT_TRUE(pucks.history.is_stuck(pucks.contact, 1.0)) << impact;
  const Contact alone{pucks.two, partner::wall_top, {}};
  EXPECT_TRUE(pucks.history.is_stuck(alone, 1.0));
  EXPECT_FALSE(pucks.history.is_stuck(alone, 1.0 + 1e-15));
}

TEST(ImpactHistory, LetsABodyTryToRestEightTimesAtOneInstant) {
  MetPucks pucks;
  for (int attempt = 1; attempt <= 8; ++attempt)
    EXPECT_FALSE(pucks.history.has_rested_enough(pucks.one, 1.0));
  EXPECT_TRUE(pucks.history.has_rested_enough(pucks.one, 1.0));
  EXPECT_FALSE(pucks.history.has_rested_enough(pucks.two, 1.0));
  EXPECT_FALSE(pucks.history.has_rested_enough(pucks.one, 2.0));
}

TEST(ImpactHistory, GoesOnInAnotherWorldWhereItWas) {
  MetPucks here, there;
  here.impact(here.one, 7, 1.0);
  here.history.note_hop(std::vector{here.one}, 1.0);
  for (int i = 0; i < 100; ++i) here.history.is_stuck(here.at_post, 1.0);
  BodyState state;
  here.history.read(here.one, state);
  there.history.write(there.one, state);
  EXPECT_EQ(there.history.hops(there.one), 1u);
  EXPECT_TRUE(there.is_pressed(slow_speed, 1.0 + 3.9 * tau));
  EXPECT_FALSE(there.is_pressed(slow_speed, 1.0 + 4.1 * tau));
  there.impact(there.one, 1, 1.0 + 0.9 * tau);
  EXPECT_TRUE(there.is_pressed(slow_speed, 1.0 + 4.1 * tau));
  EXPECT_TRUE(there.history.is_stuck(there.at_post, 1.0));
}

}  // namespace
}  // namespace rink::physics::test
