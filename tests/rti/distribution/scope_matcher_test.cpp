// Subscriptions and the scope that follows from them, with a filter that lets through what the test
// says.
#include "rti/distribution/scope_matcher.h"

#include <gtest/gtest.h>

#include "tests/rti/distribution/parts.h"

namespace rink::rti {
namespace {

TEST(Subscriptions, ToAClassAreToItsSubclassesToo) {
  Parts parts;
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.one}, no_region);
  EXPECT_EQ(parts.subscriptions.subscribed(1, body_class, no_region),
            (Subscription{parts.both, parts.one}));
  EXPECT_EQ(parts.subscriptions.subscribed(1, puck_class, no_region), Subscription{});
  EXPECT_EQ(parts.subscriptions.subscribed_anywhere(1, puck_class),
            (Subscription{parts.both, parts.one}));
}

TEST(Subscriptions, WithARegionAreOneSubscriberOfTheFilterUntilTheLastEnds) {
  Parts parts;
  const RegionSlot view = parts.view();
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, view);
  parts.subscriptions.subscribe(1, puck_class, {parts.one, parts.one}, view);
  ASSERT_EQ(parts.filter.subscribers.size(), 1u);
  EXPECT_EQ(parts.filter.subscribers.begin()->second, (im::Region{0, 0, 9, 9}));
  EXPECT_EQ(parts.regions[view].subscription_count, 1u);
  parts.subscriptions.subscribe(1, body_class, {}, view);
  EXPECT_EQ(parts.filter.subscribers.size(), 1u);
  parts.subscriptions.subscribe(1, puck_class, {}, view);
  EXPECT_TRUE(parts.filter.subscribers.empty());
  EXPECT_EQ(parts.regions[view].subscription_count, 0u);
}

TEST(Subscriptions, ToAnInteractionNameItsRegions) {
  Parts parts;
  const RegionSlot view = parts.view();
  parts.subscriptions.subscribe_interaction(1, 0, view, Listening::passive);
  EXPECT_EQ(parts.subscriptions.subscribes_interaction(1, 1), Listening::passive);
  parts.subscriptions.subscribe_interaction(1, 1, view, Listening::active);
  EXPECT_EQ(parts.subscriptions.subscribes_interaction(1, 1), Listening::active);
  EXPECT_EQ(parts.subscriptions.subscribes_interaction(1, 0), Listening::passive);
  std::size_t asked = 0;
  EXPECT_FALSE(parts.subscriptions.any_region_of_interaction(
      1, 1, [&](RegionSlot region) { return ++asked, region != view; }));
  EXPECT_EQ(asked, 2u);
  parts.subscriptions.drop(1, view);
  EXPECT_EQ(parts.subscriptions.subscribes_interaction(1, 1), Listening::none);
}

TEST(AScopeMatcher, PutsEverythingIntoTheScopeOfOneWhoSubscribesEverywhere) {
  Parts parts;
  parts.subscriptions.subscribe(1, body_class, {parts.one, parts.one}, no_region);
  parts.match();
  EXPECT_EQ(parts.told().attributes_in_scope(0, body_class), parts.one);
  EXPECT_EQ(parts.told().attributes_in_scope(1, puck_class), parts.one);
  EXPECT_TRUE(parts.told().needs_any_full_state);
  ASSERT_EQ(parts.told().events.size(), 2u);
  EXPECT_EQ(parts.told().events[0].slot, 0u);
  EXPECT_EQ(parts.counters.entries, 2u);
  EXPECT_TRUE(parts.scopes.of(0).events.empty()) << "nobody hears of what is his own";
  EXPECT_TRUE(parts.changed.empty());
}

TEST(AScopeMatcher, FollowsTheFilterWithinARegion) {
  Parts parts;
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, parts.view());
  parts.match();
  EXPECT_TRUE(parts.told().events.empty());
  parts.match({parts.change(im::Transition::entered, 1)});
  EXPECT_EQ(parts.told().attributes_in_scope(1, puck_class), parts.both);
  EXPECT_TRUE(parts.told().attributes_in_scope(0, body_class).is_empty());
  parts.match({parts.change(im::Transition::left, 1)});
  EXPECT_TRUE(parts.told().attributes_in_scope(1, puck_class).is_empty());
  EXPECT_EQ(parts.told().events.size(), 2u);
  EXPECT_EQ(parts.counters.exits, 1u);
}

TEST(AScopeMatcher, LetsAFederateHearOfWhatItOwnsByNumberWhateverTheFilterSays) {
  Parts parts;
  parts.facts.set_object_role(0, {.owner = 7});
  parts.facts.set_federate_role(1, {.owner = 7});
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, parts.view());
  parts.match();
  EXPECT_EQ(parts.told().attributes_in_scope(0, body_class), parts.both);
  EXPECT_TRUE(parts.told().attributes_in_scope(1, puck_class).is_empty());
}

TEST(AScopeMatcher, TakesOnlyTheAttributesWhoseRegionsOverlap) {
  Parts parts;
  const RegionSlot far = (parts.regions.create(0, {2}, {}), parts.regions.slot_of(0, {2}));
  parts.regions.modify(0, {2}, im::Region{50, 50, 51, 51});
  parts.regions.associate(0, parts.regions.slot_of(0, {0}), parts.both);
  parts.regions.disassociate(0, parts.regions.slot_of(0, {0}), parts.one);
  parts.regions.associate(0, far, parts.one);
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, parts.view());
  const im::Entity near = parts.regions[parts.regions.slot_of(0, {0})].entity;
  parts.match({{.subscriber = parts.subscriptions.of(1).regionals[0].subscriber,
                .entity = near,
                .transition = im::Transition::entered}});
  EXPECT_EQ(parts.told().attributes_in_scope(0, body_class), parts.both.without(parts.one));
  EXPECT_FALSE(parts.told().is_uniform);
}

TEST(AScopeMatcher, ListsTouchedObjectsWhileItIsWatched) {
  Parts parts;
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.both}, parts.view());
  parts.match();
  parts.match({parts.change(im::Transition::entered, 0)});
  EXPECT_TRUE(parts.scopes.touched().empty());
  parts.scopes.watch(true);
  parts.match({parts.change(im::Transition::entered, 1)});
  EXPECT_EQ(parts.scopes.touched(), std::vector<ObjectSlot>{1});
}

TEST(AScopeMatcher, KnowsWhatIsHeardActively) {
  Parts parts;
  parts.subscriptions.subscribe(1, body_class, {parts.both, parts.one}, no_region);
  parts.match();
  EXPECT_EQ(parts.told().attributes_in_scope(0, body_class), parts.both);
  EXPECT_EQ(parts.matcher.actively_in_scope(1, 0), parts.one);
}

}  // namespace
}  // namespace rink::rti
