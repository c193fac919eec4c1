// What a filter is told of roles and headings, and of which it hears nothing.
#include "rti/distribution/filter_facts.h"

#include <gtest/gtest.h>

#include "tests/rti/distribution/told_filter.h"

namespace rink::rti {
namespace {

DistributedRegion shared_by(std::vector<ObjectSlot> objects) {
  DistributedRegion region;
  region.is_placed = region.is_committed = true;
  region.entity = 4;
  region.objects = std::move(objects);
  return region;
}

TEST(FilterFacts, SayOfARegionWhatItsObjectsAgreeIn) {
  ToldFilter filter({.uses_roles = true});
  FilterFacts facts(filter);
  facts.set_object_role(0, {.team = 1, .owner = 7});
  facts.set_object_role(1, {.team = 1, .owner = 8, .is_always_relevant = true});
  facts.inform_entity(shared_by({0}));
  EXPECT_EQ(filter.roles[4], (im::Role{.team = 1, .owner = 7}));
  facts.inform_entity(shared_by({0, 1}));
  EXPECT_EQ(filter.roles[4], (im::Role{.team = 1, .is_always_relevant = true}));
  facts.forget(1);
  facts.inform_entity(shared_by({1, 9}));
  EXPECT_EQ(filter.roles[4], im::Role{});
}

TEST(FilterFacts, SayNothingThatTheFilterMakesNothingOf) {
  ToldFilter filter;
  FilterFacts facts(filter);
  facts.add_federate(2);
  facts.set_federate_role(2, {.team = 1});
  facts.set_heading(2, {1.0, 0.0});
  facts.inform_subscriber(2, 0);
  facts.inform_entity(shared_by({0}));
  facts.set_flight(shared_by({0}), {});
  EXPECT_TRUE(filter.roles.empty() && filter.subscriber_roles.empty() && filter.headings.empty() &&
              filter.flights.empty());
}

TEST(FilterFacts, TellASubscriptionOfItsFederate) {
  ToldFilter filter({.uses_roles = true, .uses_headings = true});
  FilterFacts facts(filter);
  facts.add_federate(2);
  facts.set_federate_role(2, {.team = 1});
  EXPECT_TRUE(facts.set_heading(2, {0.0, 1.0}));
  EXPECT_FALSE(facts.set_heading(2, {0.0, 1.0})) << "it looks there already";
  facts.inform_subscriber(2, 5);
  EXPECT_EQ(filter.subscriber_roles[5].team, 1u);
  EXPECT_EQ(filter.headings[5], (im::Heading{0.0, 1.0}));
  facts.add_federate(2);
  EXPECT_EQ(facts.role_of(2), im::Role{}) << "another federate in the same slot";
}

TEST(FilterFacts, KnowWhatAFederateOwnsByNumber) {
  ToldFilter filter;
  FilterFacts facts(filter);
  facts.add_federate(0);
  facts.set_object_role(3, {.owner = 7});
  EXPECT_FALSE(facts.is_own(0, 3)) << "who has no number owns nothing";
  facts.set_federate_role(0, {.owner = 7});
  EXPECT_TRUE(facts.is_own(0, 3));
  EXPECT_FALSE(facts.is_own(0, 2));
  EXPECT_FALSE(facts.is_own(0, 99));
}

}  // namespace
}  // namespace rink::rti
