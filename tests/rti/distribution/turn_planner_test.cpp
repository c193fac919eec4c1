// Who of those in scope waits, by tiers and by a budget, against counting.
#include "rti/distribution/turn_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "tests/rti/distribution/parts.h"

namespace rink::rti {
namespace {

TEST(ATurnPlanner, LetsThoseOfAFartherTierWaitForTheirTurn) {
  Parts parts({.decides_tiers = true});
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, parts.view());
  parts.turns.begin_match();
  parts.match(
      {parts.change(im::Transition::entered, 0, 0), parts.change(im::Transition::entered, 1, 1)});
  FederateInterest& interest = parts.scopes.of(1);
  interest.needs_full_state.clear();
  std::size_t waited = 0;
  for (int match = 0; match < 4; ++match) {
    parts.turns.begin_match();
    parts.turns.plan_turns(interest);
    EXPECT_FALSE(interest.turns->waiting.contains(0)) << "it is in the nearest";
    waited += interest.turns->waiting.contains(1) ? 1u : 0u;
  }
  EXPECT_EQ(waited, 2u) << "tier 1 is told of every other match";
}

TEST(ATurnPlanner, LetsNobodyWaitWhoIsHeardOfWithoutTheFilter) {
  Parts parts({.decides_tiers = true});
  parts.subscriptions.subscribe(1, body_class, {parts.one, parts.one}, no_region);
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, parts.view());
  parts.match({parts.change(im::Transition::entered, 1, 3)});
  FederateInterest& interest = parts.scopes.of(1);
  interest.needs_full_state.clear();
  for (int match = 0; match < 8; ++match) {
    parts.turns.begin_match();
    parts.turns.plan_turns(interest);
    EXPECT_FALSE(interest.turns->waiting.contains(1));
  }
}

/// Whichever tier it is in, nobody is told of more seldom, nor more often: once in 2^k matches in a
/// row, tier 6 being the farthest there is.
TEST(ATurnPlanner, TellsOfTierKOnceInTwoToTheKMatches) {
  Parts parts({.decides_tiers = true});
  while (parts.objects.slot_count() < 300) parts.add_object(puck_class);
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, parts.view());
  const auto tier_of = [](ObjectSlot slot) { return static_cast<std::uint8_t>(slot % 9); };
  std::vector<im::Change> changes;
  for (ObjectSlot slot = 0; slot < 300; ++slot)
    changes.push_back(parts.change(im::Transition::entered, slot, tier_of(slot)));
  parts.match(changes);
  FederateInterest& interest = parts.scopes.of(1);
  interest.needs_full_state.clear();
  std::vector<int> told(300), last(300);
  for (int match = 1; match <= 256; ++match) {
    parts.turns.begin_match();
    parts.turns.plan_turns(interest);
    for (ObjectSlot slot = 0; slot < 300; ++slot) {
      if (interest.turns->waiting.contains(slot)) continue;
      const int period = 1 << std::min<int>(tier_of(slot), 6);
      if (told[slot]++ > 0) {
        EXPECT_EQ(match - last[slot], period) << slot;
      }
      last[slot] = match;
    }
  }
  for (ObjectSlot slot = 0; slot < 300; ++slot)
    EXPECT_EQ(told[slot], 256 >> std::min<int>(tier_of(slot), 6)) << slot;
}

TEST(ATurnPlanner, GoesByTheNearestOfTheTiersThatSubscriptionsHaveAnObjectIn) {
  Parts parts({.decides_tiers = true});
  const auto tier_of = [&](ObjectSlot slot) {
    std::uint32_t tier = 0;
    for (std::uint32_t k = 1; k <= Turns::tier_max; ++k)
      if (parts.told().turns->tiers[k - 1].contains(slot)) tier = k;
    return tier;
  };
  for (const RegionHandle view : {RegionHandle{0}, RegionHandle{1}})
    parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, parts.view(view));
  parts.match({parts.change(im::Transition::entered, 0, 2, 0),
               parts.change(im::Transition::entered, 1, 5, 0),
               parts.change(im::Transition::entered, 0, 4, 1)});
  EXPECT_EQ(tier_of(0), 2u);
  EXPECT_EQ(tier_of(1), 5u);
  parts.match({parts.change(im::Transition::left, 0, 0, 0)});
  EXPECT_EQ(tier_of(0), 4u);
  parts.match({parts.change(im::Transition::entered, 0, 0, 0)});
  EXPECT_EQ(tier_of(0), 0u) << "nearest of all";
}

/// What is late of it must not wait for the turn of a farther tier.
TEST(ATurnPlanner, TellsAtOnceOfWhoChangesTiers) {
  Parts parts({.decides_tiers = true});
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, parts.view());
  parts.match({parts.change(im::Transition::entered, 1, 6)});
  FederateInterest& interest = parts.scopes.of(1);
  interest.needs_full_state.clear();
  const auto is_waiting = [&] {
    parts.turns.begin_match();
    parts.turns.plan_turns(interest);
    return interest.turns->waiting.contains(1);
  };
  EXPECT_TRUE(is_waiting());
  parts.match({parts.change(im::Transition::tier_changed, 1, 5)});
  EXPECT_FALSE(is_waiting());
  EXPECT_TRUE(is_waiting());
}

/// Ten bytes each, of which three fit: three are told of in each match, all in any four. At first
/// states on entry and updates take turns, which doubles the wait.
TEST(ATurnPlanner, SharesABudgetOutSoThatNobodyStarves) {
  Parts parts({}, 35);
  while (parts.objects.slot_count() < 10) parts.add_object(puck_class);
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, parts.view());
  std::vector<im::Change> changes;
  for (ObjectSlot slot = 0; slot < 10; ++slot)
    changes.push_back(parts.change(im::Transition::entered, slot));
  FederateInterest& interest = parts.scopes.of(1);
  std::vector<int> last(10, 0);
  for (int match = 1; match <= 40; ++match) {
    parts.turns.begin_match();
    parts.match(std::exchange(changes, {}));
    parts.turns.plan_turns(interest);
    parts.turns.share_out(interest, [](ObjectSlot) { return std::size_t{10}; });
    int told = 0;
    for (ObjectSlot slot = 0; slot < 10; ++slot) {
      if (interest.turns->waiting.contains(slot)) continue;
      EXPECT_LE(match - last[slot], match <= 12 ? 8 : 4) << slot;
      last[slot] = match, ++told;
    }
    EXPECT_EQ(told, 3);
  }
}

TEST(ATurnPlanner, SharesABudgetOutOnceForEachMatch) {
  Parts parts({}, 1000);
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, parts.view());
  parts.turns.begin_match();
  parts.match({parts.change(im::Transition::entered, 0), parts.change(im::Transition::entered, 1)});
  FederateInterest& interest = parts.scopes.of(1);
  const auto waiting = [&] {
    parts.turns.plan_turns(interest);
    parts.turns.share_out(interest, [](ObjectSlot) { return std::size_t{10}; });
    return int{interest.turns->waiting.contains(0)} + int{interest.turns->waiting.contains(1)};
  };
  EXPECT_EQ(waiting(), 0);
  EXPECT_EQ(waiting(), 2) << "what comes between two matches waits for the next";
  parts.turns.begin_match();
  EXPECT_EQ(waiting(), 0);
}

/// What is heard of everywhere as well costs nothing of it, however large.
TEST(ATurnPlanner, SpendsNoBudgetOnWhatNeverWaits) {
  Parts parts({}, 10);
  parts.subscriptions.subscribe(1, puck_class, {parts.one, parts.one}, no_region);
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, parts.view());
  FederateInterest& interest = parts.scopes.of(1);
  parts.turns.begin_match();
  parts.match({parts.change(im::Transition::entered, 0), parts.change(im::Transition::entered, 1)});
  parts.turns.plan_turns(interest);
  parts.turns.share_out(interest, [](ObjectSlot slot) { return slot == 0 ? 10u : 1'000'000u; });
  EXPECT_FALSE(interest.turns->waiting.contains(0));
  EXPECT_FALSE(interest.turns->waiting.contains(1));
}

}  // namespace
}  // namespace rink::rti
