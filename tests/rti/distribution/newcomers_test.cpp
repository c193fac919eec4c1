// How many new subscriptions a match takes in, and that what a federate sees is right whether it
// waits or not.
#include "rti/distribution/newcomers.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/rti/distribution/parts.h"

namespace rink::rti {
namespace {

/// Admits waiting federates, which have `pairs` pairs each, and ends the match.
std::vector<std::uint32_t> match_of(Newcomers& newcomers, std::size_t pairs) {
  std::vector<std::uint32_t> taken_in;
  newcomers.admit_waiting([pairs](std::uint32_t) { return pairs; },
                          [&](std::uint32_t federate) { taken_in.push_back(federate); });
  newcomers.end_match(0.0, 0);
  return taken_in;
}

TEST(Newcomers, DoNotWaitWhileThereIsRoom) {
  Newcomers newcomers(100);
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(newcomers.admit(10));
  EXPECT_FALSE(newcomers.admit(1));
  newcomers.end_match(0.0, 0);
  EXPECT_TRUE(newcomers.admit(100));
}

TEST(Newcomers, AreTakenInByArrivalAndOneAtLeastInEachMatch) {
  Newcomers newcomers(100);
  EXPECT_TRUE(newcomers.admit(1000)) << "more than all the room, but it comes first";
  for (const std::uint32_t federate : {7u, 3u, 5u, 4u, 9u}) newcomers.wait(federate);
  EXPECT_FALSE(newcomers.admit(0)) << "others wait before it";
  EXPECT_EQ(match_of(newcomers, 40), std::vector<std::uint32_t>()) << "the room was used up";
  newcomers.forget(3);
  EXPECT_EQ(match_of(newcomers, 40), (std::vector<std::uint32_t>{7, 5}));
  EXPECT_EQ(match_of(newcomers, 1000), std::vector<std::uint32_t>{4});
  EXPECT_EQ(match_of(newcomers, 1000), std::vector<std::uint32_t>{9});
  EXPECT_EQ(newcomers.waiting_count(), 0u);
}

TEST(Newcomers, AreExpectedToSeeWhatThoseBeforeThemSaw) {
  Newcomers newcomers(100);
  EXPECT_EQ(newcomers.expected(4.0, 500), 500u) << "nothing is known yet";
  newcomers.end_match(8.0, 400);
  EXPECT_EQ(newcomers.expected(4.0, 500), 201u);
  EXPECT_EQ(newcomers.expected(1e300, 500), 500u);
  newcomers.end_match(0.0, 0);
  EXPECT_EQ(newcomers.expected(4.0, 500), 201u) << "a match without newcomers shows nothing";
  newcomers.end_match(1e300, 1);
  EXPECT_EQ(newcomers.expected(4.0, 500), 101u) << "halved, however wide a region looks";
  newcomers.end_match(8.0, 0);
  EXPECT_EQ(newcomers.expected(4.0, 500), 101u) << "a view of nothing shows nothing";
}

/// Parts whose matches have room for one pair.
struct NarrowParts : Parts {
  NarrowParts() : Parts({}, 0, 1) { match(); }
  void match(std::vector<im::Change> changes = {}) {
    subscriptions.admit_waiting();
    Parts::match(std::move(changes));
    subscriptions.end_match();
  }
};

TEST(ASubscriptionThatWaits, ChangesNothingOfWhatTheFederateSeesUntilItIsTakenIn) {
  NarrowParts parts;
  parts.subscriptions.subscribe(1, puck_class, {parts.one, parts.one}, no_region);
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, parts.view());
  EXPECT_TRUE(parts.filter.subscribers.empty());
  EXPECT_EQ(parts.subscriptions.waiting_count(), 1u);
  EXPECT_EQ(parts.subscriptions.subscribed_anywhere(1, body_class).subscribed, parts.both)
      << "publishers hear of it at once";
  parts.match();
  EXPECT_EQ(parts.told().attributes_in_scope(1, puck_class), parts.one);
  EXPECT_TRUE(parts.told().attributes_in_scope(0, body_class).is_empty());
  parts.subscriptions.admit_waiting();
  ASSERT_EQ(parts.filter.subscribers.size(), 1u);
  EXPECT_EQ(parts.filter.subscribers.begin()->second, (im::Region{0, 0, 9, 9}));
  parts.match({parts.change(im::Transition::entered, 0)});
  EXPECT_EQ(parts.told().attributes_in_scope(0, body_class), parts.both);
  EXPECT_EQ(parts.told().events.size(), 2u);
}

TEST(ASubscriptionThatWaits, IsTakenInAtOnceWhenItsFederateWantsLess) {
  NarrowParts parts;
  parts.subscriptions.subscribe(1, puck_class, {parts.both, parts.both}, no_region);
  parts.match();
  parts.subscriptions.subscribe(1, puck_class, {parts.one, parts.one}, no_region);
  parts.match();
  EXPECT_EQ(parts.told().attributes_in_scope(1, puck_class), parts.one)
      << "wanting less needs no room";
  parts.subscriptions.subscribe(1, puck_class, {parts.both, parts.both}, no_region);
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, no_region);
  ASSERT_EQ(parts.subscriptions.waiting_count(), 1u);
  parts.subscriptions.subscribe(1, puck_class, {}, no_region);
  EXPECT_EQ(parts.subscriptions.waiting_count(), 0u);
  parts.match();
  EXPECT_EQ(parts.told().attributes_in_scope(1, puck_class), parts.both)
      << "as a body, to which it is subscribed";
}

TEST(ASubscriptionThatWaits, UsesItsRegionAsItIsWhenItIsTakenIn) {
  NarrowParts parts;
  parts.regions.create(1, {0}, {});
  const RegionSlot view = parts.regions.slot_of(1, {0});
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, view);
  parts.regions.modify(1, {0}, im::Region{0, 0, 9, 9});
  parts.subscriptions.follow(view);
  EXPECT_TRUE(parts.filter.subscribers.empty()) << "the first commit makes it wait";
  parts.regions.modify(1, {0}, im::Region{0, 0, 5, 5});
  parts.subscriptions.follow(view);
  EXPECT_TRUE(parts.filter.subscribers.empty());
  parts.match();
  parts.match();
  ASSERT_EQ(parts.filter.subscribers.size(), 1u);
  EXPECT_EQ(parts.filter.subscribers.begin()->second, (im::Region{0, 0, 5, 5}));
  parts.regions.modify(1, {0}, im::Region{1, 1, 5, 5});
  parts.subscriptions.follow(view);
  EXPECT_EQ(parts.filter.subscribers.begin()->second, (im::Region{1, 1, 5, 5}));
}

TEST(ASubscriptionThatWaits, IsGoneWithItsRegionOrItsFederate) {
  NarrowParts parts;
  const RegionSlot view = parts.view();
  parts.subscriptions.subscribe(1, puck_class, {parts.one, parts.one}, no_region);
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, view);
  parts.subscriptions.drop(1, view);
  parts.match();
  parts.match();
  EXPECT_TRUE(parts.filter.subscribers.empty());
  EXPECT_EQ(parts.subscriptions.waiting_count(), 0u);
  parts.subscriptions.subscribe(1, puck_class, {parts.both, parts.both}, no_region);
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, no_region);
  EXPECT_EQ(parts.subscriptions.waiting_count(), 1u);
  parts.subscriptions.remove_federate(1);
  EXPECT_EQ(parts.subscriptions.waiting_count(), 0u);
}

}  // namespace
}  // namespace rink::rti
