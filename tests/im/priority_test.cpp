// The stage `priority`: who is sent first, what is put off, and that nobody starves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "im/stages/priority_order.h"
#include "tests/im/cases.h"
#include "tests/im/layouts.h"
#include "tests/im/stage_counts.h"

namespace rink::im {
namespace {

TEST(Priority, SendsTheStateOfWhoEnteredFirstAndStarvesNobody) {
  const auto filter = make_filter("region with priority", hundred);
  filter->set_subscription_region(0, {0.0, 0.0, 20.0, 20.0});
  for (Entity entity = 0; entity < 20; ++entity)
    filter->set_update_region(entity, {10.0 + 0.5 * entity, 10.0, 10.0 + 0.5 * entity, 10.0});
  filter->match();
  PriorityOrder& order = *filter->priority();
  const auto bytes_of = [](const PriorityOrder::Item& item) {
    return std::size_t{item.is_state ? 40u : 10u};
  };
  const auto first = order.fill(0, 200, bytes_of);
  ASSERT_EQ(first.size(), 5u);
  for (Entity entity = 0; entity < 5; ++entity)
    EXPECT_EQ(first[entity].entity, entity) << "the nearest first";
  std::vector<int> sent(20);
  for (int i = 0; i < 400; ++i) {
    filter->match();
    std::size_t used = 0;
    for (const PriorityOrder::Item& item : order.fill(0, 50, bytes_of))
      ++sent[item.entity], used += bytes_of(item);
    EXPECT_LE(used, 50u);
  }
  EXPECT_GT(*std::min_element(sent.begin(), sent.end()), 60) << "nobody starves";
  EXPECT_NEAR(static_cast<double>(sent[0]) / sent[19], 1.95, 0.25)
      << "1 / (1 + d / r) of the middle against the edge";
  EXPECT_EQ(order.counts().states, 20u);
  EXPECT_EQ(order.counts().state_bytes, 800u);
  EXPECT_EQ(order.counts().update_bytes, 10u * order.counts().updates);
  filter->set_update_region(3, {90.0, 90.0, 90.0, 90.0});
  filter->match();
  for (const PriorityOrder::Item& item : order.order(0)) EXPECT_NE(item.entity, 3u);
  EXPECT_FALSE(make_filter("region", hundred)->priority());
}

/// What fits is what a whole sort would put in front, states and updates in turns, and what does
/// not is all the rest.
TEST(Priority, FillsWithTheMostUrgentAndPutsOffAllOthers) {
  const auto filter = make_filter("region with tiers(at=0.4) with priority", hundred);
  PriorityOrder& order = *filter->priority();
  Random random(8);
  constexpr std::size_t item_bytes = 10;
  for (int match = 1; match <= 60; ++match) {
    filter->set_subscription_region(0, around(50.0, 50.0, 20.0));
    for (Entity entity = 0; entity < 200; ++entity) {
      const double x = between(random, 20.0, 80.0);
      if (match == 1 || between(random, 0.0, 1.0) < 0.1)
        filter->set_update_region(entity, around(x, between(random, 20.0, 80.0), 0.1));
    }
    filter->match();
    std::vector<Entity> states, updates, expected, filled, put_off;
    for (const PriorityOrder::Item& item : order.order(0))
      (item.is_state ? states : updates).push_back(item.entity);
    std::size_t room = 25;
    for (const auto* list :
         {match % 2 == 0 ? &updates : &states, match % 2 == 0 ? &states : &updates})
      for (std::size_t i = 0; i < list->size() && room > 0; ++i, --room)
        expected.push_back((*list)[i]);
    for (const PriorityOrder::Item& item :
         order.fill(0, 25 * item_bytes, [=](const auto&) { return item_bytes; }))
      filled.push_back(item.entity);
    for (const PriorityOrder::Item& item : order.put_off()) put_off.push_back(item.entity);
    ASSERT_EQ(filled, expected) << "match " << match;
    std::vector<Entity> all(filled), there(states);
    all.insert(all.end(), put_off.begin(), put_off.end());
    there.insert(there.end(), updates.begin(), updates.end());
    ASSERT_THAT(all, testing::UnorderedElementsAreArray(there)) << "match " << match;
  }
}

/// (Matches since it was last sent) / ((1 + d / r) 2^tier), d in the plane; of a state the matches
/// since it entered, and one more.
TEST(Priority, OrdersByTheMatchesWaitedTheDistanceAndTheTier) {
  const auto filter = make_filter("region with tiers(at=0.4) with priority", hundred);
  PriorityOrder& order = *filter->priority();
  Random random(9);
  constexpr double half = 20.0;
  std::map<Entity, Region> places;
  std::map<Entity, int> since, tier;  // the match at which it was sent last, or entered
  std::map<Entity, bool> is_state;
  filter->set_subscription_region(0, around(50.0, 50.0, half));
  std::size_t compared = 0;
  for (int match = 1; match <= 40; ++match) {
    for (Entity entity = 0; entity < 150; ++entity) {
      const double x = between(random, 25.0, 75.0), y = between(random, 25.0, 75.0);
      if (match == 1 || between(random, 0.0, 1.0) < 0.1)
        filter->set_update_region(entity, places[entity] = around(x, y, 0.1));
    }
    for (const Change& change : filter->match()) {
      if (change.transition == Transition::left) since.erase(change.entity);
      if (change.transition == Transition::entered)
        since[change.entity] = match, is_state[change.entity] = true;
      if (change.transition != Transition::left) tier[change.entity] = change.tier;
    }
    const auto urgency = [&](Entity entity) {
      const Region& place = places[entity];
      const double d = std::hypot(0.5 * (place.low_x + place.high_x) - 50.0,
                                  0.5 * (place.low_y + place.high_y) - 50.0);
      return (match - since[entity] + (is_state[entity] ? 1 : 0)) /
             ((1.0 + d / half) * std::pow(2.0, tier[entity]));
    };
    for (const bool states : {true, false}) {
      double before = std::numeric_limits<double>::infinity();
      for (const PriorityOrder::Item& item : order.order(0)) {
        if (item.is_state != states) continue;
        ASSERT_EQ(item.is_state, is_state[item.entity]);
        ASSERT_LE(urgency(item.entity), before * (1.0 + 1e-5))
            << "match " << match << ", entity " << item.entity;
        before = urgency(item.entity), ++compared;
      }
    }
    for (const PriorityOrder::Item& item :
         order.fill(0, 120, [](const auto&) { return std::size_t{10}; }))
      since[item.entity] = match, is_state[item.entity] = false;
  }
  EXPECT_GT(compared, 1'000u);
}

TEST(Priority, TakesOneThatAloneExceedsTheBudget) {
  const auto filter = make_filter("region with tiers(at=0.5) with priority", hundred);
  filter->set_subscription_region(0, {0.0, 0.0, 20.0, 20.0});
  filter->set_update_region(0, {10.0, 10.0, 10.0, 10.0});
  filter->set_update_region(1, {19.0, 10.0, 19.0, 10.0});
  filter->match();
  const auto huge = [](const PriorityOrder::Item&) { return std::size_t{1000}; };
  EXPECT_EQ(filter->priority()->fill(0, 100, huge).size(), 1u);
  EXPECT_EQ(filter->priority()->fill(0, 100, huge).front().entity, 1u);
  EXPECT_EQ(count(*filter, "put off"), 2u);
}

}  // namespace
}  // namespace rink::im
