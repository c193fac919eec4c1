// Which body's event comes first, against a search through the events of all.
#include "game/physics/engine/next_events.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "game/physics/events/event_order.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

constexpr double no_time = std::numeric_limits<double>::infinity(), far_off = 1e9;

NextEvent impact_at(double time, Partner with) {
  NextEvent slot = NextEvents::no_event;
  slot.impact_time = time, slot.partner = with;
  return slot;
}

void put(NextEvents& events, std::uint32_t body, const NextEvent& slot) {
  events.slot(body) = slot;
  events.schedule(body);
}

class NextEventsOfEither : public testing::TestWithParam<QueuePolicy> {
 protected:
  NextEvents events{GetParam()};
  void add(int count) {
    for (int i = 0; i < count; ++i) events.add();
  }
};

TEST_P(NextEventsOfEither, ComeWhenTheImpactOrTheCrossingDoesWhicheverIsEarlier) {
  add(2);
  EXPECT_EQ(events.first(far_off), NextEvents::none);
  NextEvent slot = impact_at(2.0, partner::wall_top);
  slot.crossing_time = 3.0;
  put(events, 1, slot);
  EXPECT_EQ(events.first(2.0), 1u);
  EXPECT_EQ(events.time(1), 2.0);
  slot.crossing_time = 1.0;
  put(events, 1, slot);
  EXPECT_EQ(events.time(1), 1.0);
  EXPECT_EQ(events.first(std::nextafter(1.0, 0.0)), NextEvents::none);
  events.drop(1);
  EXPECT_EQ(events.first(far_off), NextEvents::none);
  EXPECT_EQ(events[1].partner, partner::none);
}

TEST_P(NextEventsOfEither, AreTheSameInAnotherQueue) {
  add(3);
  put(events, 0, impact_at(2.0, partner::wall_top));
  put(events, 1, impact_at(1.0, 2));
  for (const QueuePolicy policy : {QueuePolicy::windows, QueuePolicy::calendar, GetParam()}) {
    events.keep_by(policy);
    EXPECT_EQ(events.first(far_off), 1u);
    EXPECT_EQ(events.time(0), 2.0);
    EXPECT_EQ(events.time(2), no_time);
  }
  events.drop(1);
  EXPECT_EQ(events.first(far_off), 0u);
}

/// Two worlds that number bodies alike process events of one instant in the same order, however
/// they came to be: that of the pairs, the lower number first.
TEST_P(NextEventsOfEither, ComeInTheOrderOfThePairsAtOneInstant) {
  add(6);
  put(events, 5, impact_at(1.0, 1));
  put(events, 4, impact_at(1.0, 3));
  put(events, 2, impact_at(1.0, 1));
  for (const std::uint32_t body : {2, 5, 4}) {
    EXPECT_EQ(events.first(1.0), body);
    events.drop(body);
  }
}

TEST_P(NextEventsOfEither, AreForgottenByARestart) {
  add(3);
  put(events, 2, impact_at(1.0, 0));
  events.restart(3);
  EXPECT_EQ(events.first(far_off), NextEvents::none);
  put(events, 1, impact_at(0.5, 0));
  EXPECT_EQ(events.first(far_off), 1u);
}

/// Hidden behind the one that is known: then the slot of one of the two says so.
TEST_P(NextEventsOfEither, AreFollowedAtOnceWhereOneOfTheTwoIsTied) {
  for (const std::uint32_t tied : {0u, 1u, 2u}) {
    events.restart(3);
    NextEvent slot = impact_at(1.0, 1);
    slot.is_tied = tied == 0;
    put(events, 0, slot);
    events.slot(tied).is_tied = true;
    ASSERT_EQ(events.first(far_off), 0u);
    EXPECT_EQ(events.is_followed_at_once(0, 1), tied != 2);
    EXPECT_EQ(events.is_followed_at_once(0, partner::wall_left), tied == 0);
  }
}

/// Times lie on a coarse grid, and now and then within roundings of the instant (1e-9 s) beside it,
/// so that many are equal, and those that come at once lie in one bucket of a calendar as well as
/// in two neighbours. No follower may be missed; a calendar sometimes says yes without need.
TEST_P(NextEventsOfEither, AgreeWithASearchThroughAll) {
  constexpr std::uint64_t seed = 6;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  constexpr std::uint32_t count = 50;
  std::mt19937_64 random(seed);
  add(count);
  std::vector<EventOrder> all(count);
  double now = 0.0;
  int followed = 0, alone = 0, without_need = 0;
  const auto draw = [&](std::uint32_t body) {
    const auto with = static_cast<Partner>(random() % count);
    NextEvent slot =
        impact_at(1e-3 * (std::floor(1e3 * now) + 1.0 + static_cast<double>(random() % 300)), with);
    if (random() % 3 == 0) slot.impact_time += uniform(random, 0.0, 2e-9);
    slot.crossing_time = random() % 2 == 0 ? no_time : now + uniform(random, 0.0, 0.3);
    all[body] = {slot.impact_time, std::min(body, with), std::max(body, with)};
    if (slot.crossing_time < slot.impact_time) all[body] = {slot.crossing_time, body, body};
    put(events, body, slot);
  };
  for (std::uint32_t body = 0; body < count; ++body) draw(body);
  for (int step = 0; step < 20'000; ++step) {
    const EventOrder earliest = *std::min_element(all.begin(), all.end(), precedes);
    if (random() % 8 == 0) {
      ASSERT_EQ(events.first(std::nextafter(earliest.time, -1.0)), NextEvents::none);
    }
    const std::uint32_t body = events.first(far_off);
    ASSERT_LT(body, count);
    ASSERT_EQ(all[body], earliest);
    now = earliest.time;
    const bool is_followed = std::any_of(all.begin(), all.end(), [&](const EventOrder& other) {
      return other.time <= now + instant && other != earliest;
    });
    const bool answer = events.is_followed_at_once(body, partner::wall_left);
    ASSERT_TRUE(answer || !is_followed) << step;
    without_need += answer && !is_followed;
    ++(is_followed ? followed : alone);
    draw(body);
    draw(static_cast<std::uint32_t>(random() % count));
  }
  EXPECT_GT(followed, 500);
  EXPECT_GT(alone, 500);
  EXPECT_LT(without_need, 20);
}

INSTANTIATE_TEST_SUITE_P(Queue, NextEventsOfEither,
                         testing::Values(QueuePolicy::calendar, QueuePolicy::heap),
                         [](const auto& tested) {
                           return tested.param == QueuePolicy::heap ? "heap" : "calendar";
                         });

}  // namespace
}  // namespace rink::physics::test
