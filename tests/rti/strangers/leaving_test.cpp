// What a federate leaves behind when it goes, and what goes with it: whoever comes next, into its
// very place, begins anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/rti/scenes/airspace.h"
#include "tests/rti/time/timed_federation.h"

namespace rink::rti::testing {
namespace {

/// In both ways that a federate can go.
class Leaving : public ::testing::TestWithParam<bool> {
 protected:
  static RegionHandle region_at(Pilot& pilot, double low, double high) {
    const RegionHandle region = pilot.ambassador.create_region();
    move(pilot, region, low, high);
    return region;
  }
  static void move(Pilot& pilot, RegionHandle region, double low, double high) {
    pilot.ambassador.set_region(region, {low, low, high, high});
    pilot.ambassador.commit_region_modifications(region);
  }
  void leave(std::size_t index) {
    Pilot& pilot = flights.pilots()[index];
    flights.resigned += GetParam() ? 1 : 0;
    if (GetParam()) pilot.ambassador.resign();
    else flights.execution().disconnect(static_cast<ConnectionId>(index), "killed");
    flights.tick();
  }
  /// Takes the place of the one who left last.
  Pilot& arrive(const std::string& name = "newcomer") {
    const auto connection = static_cast<ConnectionId>(flights.pilots().size());
    Pilot& pilot = flights.pilots().emplace_back();
    flights.execution().connect(connection);
    pilot.ambassador.join("rink", name, "test");
    flights.tick();
    return pilot;
  }
  ObjectHandle add(Pilot& owner, RegionHandle region) {
    const ObjectHandle object = owner.ambassador.register_object_instance(aircraft);
    owner.ambassador.associate_regions_for_updates(object, region);
    update(owner, object);
    return object;
  }
  void update(Pilot& owner, ObjectHandle object) {
    owner.ambassador.update_attribute_values(object, AttributeSet{where}, values_of(1.5), {});
  }

  Flights<> flights{3};
  Pilot &owner = flights.pilots()[0], &reader = flights.pilots()[1], &witness = flights.pilots()[2];
};

TEST_P(Leaving, TakesTheRegionsWithItInWhichItSubscribed) {
  const RegionHandle place = region_at(owner, 8.0, 9.0), view = region_at(reader, 0.0, 2.0),
                     other_view = region_at(witness, 0.0, 2.0);
  reader.ambassador.subscribe_object_class_attributes(aircraft, AttributeSet{where}, view);
  witness.ambassador.subscribe_object_class_attributes(aircraft, AttributeSet{where}, other_view);
  const ObjectHandle object = add(owner, place);
  flights.tick();
  leave(1);
  Pilot& newcomer = arrive();
  std::vector<SubscribedRegion> regions;
  flights.execution().list_subscribed_regions(regions);
  ASSERT_EQ(regions.size(), 1u);
  EXPECT_EQ(regions[0].federate, witness.ambassador.federate());
  for (const double low : {0.5, 8.0, 1.0}) {
    move(owner, place, low, low + 0.5);
    update(owner, object);
    flights.tick();
    EXPECT_TRUE(newcomer.heard.objects.empty()) << "it subscribed to nothing";
    EXPECT_EQ(flights.execution().is_in_scope(witness.ambassador.federate(), object), low < 2.0);
  }
  // Its own view elsewhere is not mixed up with what was there.
  const RegionHandle own_view = region_at(newcomer, 4.0, 6.0);
  newcomer.ambassador.subscribe_object_class_attributes(aircraft, AttributeSet{where}, own_view);
  flights.tick();
  EXPECT_TRUE(newcomer.heard.objects.empty());
  move(owner, place, 5.0, 5.5);
  flights.tick();
  EXPECT_TRUE(newcomer.heard.objects.at(object.value).is_in_scope);
}

TEST_P(Leaving, TakesTheRegionsWithItInWhichItsObjectsWere) {
  const RegionHandle place = region_at(owner, 8.0, 9.0), view = region_at(witness, 0.0, 2.0);
  const AttributeSet both{where, radio};
  witness.ambassador.subscribe_object_class_attributes(aircraft, both, view);
  reader.ambassador.subscribe_object_class_attributes(aircraft, both);
  const ObjectHandle object = add(owner, place);
  flights.tick();
  // One attribute is another federate's, so the object outlives its first owner.
  owner.ambassador.unconditional_attribute_ownership_divestiture(object, AttributeSet{radio});
  owner.ambassador.set_automatic_resign_directive(ResignAction::unconditionally_divest_attributes);
  flights.tick();
  reader.ambassador.attribute_ownership_acquisition_if_available(object, AttributeSet{radio});
  flights.tick();
  flights.tick();
  EXPECT_TRUE(witness.heard.objects.empty()) << "it is far from where the witness looks";
  leave(0);
  ASSERT_TRUE(witness.heard.objects.contains(object.value))
      << "in the default region, whose every subscriber is concerned";
  Pilot& newcomer = arrive();
  newcomer.ambassador.publish_object_class_attributes(aircraft, both);
  const RegionHandle own = region_at(newcomer, 8.0, 9.0);
  const ObjectHandle other = add(newcomer, own);
  for (const double low : {3.0, 0.5, 5.0}) {
    move(newcomer, own, low, low + 0.5);
    flights.tick();
    EXPECT_TRUE(witness.heard.objects.at(object.value).is_in_scope)
        << "what moves is the newcomer's";
    EXPECT_EQ(flights.execution().is_in_scope(witness.ambassador.federate(), other), low < 2.0);
  }
}

TEST_P(Leaving, TakesItsRegionsOfInteractionsWithIt) {
  const RegionHandle ear = region_at(reader, 0.0, 2.0), mouth = region_at(owner, 1.0, 1.5);
  reader.ambassador.subscribe_interaction_class_with_regions(call, std::span(&ear, 1));
  const auto speak = [&] {
    owner.ambassador.send_interaction_with_regions(call, bytes_of("?"), std::span(&mouth, 1), {});
    owner.ambassador.send_interaction(call, bytes_of("!"), {});
    flights.tick();
  };
  flights.tick();
  speak();
  EXPECT_EQ(reader.heard.interactions.size(), 2u);
  leave(1);
  Pilot& newcomer = arrive();
  const RegionHandle own = region_at(newcomer, 0.0, 2.0);
  static_cast<void>(own);
  speak();
  EXPECT_TRUE(newcomer.heard.interactions.empty())
      << "a region of the same number and place, in which it does not listen";
}

/// One region of several, deleted by a federate that stays.
TEST(DeletedRegion, TakesWithItWhatUsesItAndNothingElse) {
  Flights<> flights(2);
  Pilot &owner = flights.pilots()[0], &reader = flights.pilots()[1];
  const auto region_at = [](Pilot& pilot, double low, double high) {
    const RegionHandle region = pilot.ambassador.create_region();
    pilot.ambassador.set_region(region, {low, low, high, high});
    pilot.ambassador.commit_region_modifications(region);
    return region;
  };
  // Two places of one object, and two ears of one reader: after the deletion of one, the other
  // still counts.
  const RegionHandle far = region_at(owner, 8.0, 9.0), near = region_at(owner, 1.0, 2.0),
                     view = region_at(reader, 7.0, 9.5);
  const ObjectHandle object = owner.ambassador.register_object_instance(aircraft);
  const std::array places{AttributeRegions{AttributeSet{where}, {far, near}}};
  owner.ambassador.associate_regions_for_updates(object, places);
  reader.ambassador.subscribe_object_class_attributes(aircraft, AttributeSet{where}, view);
  const RegionHandle ears[] = {region_at(reader, 0.0, 1.0), region_at(reader, 4.0, 5.0)};
  reader.ambassador.subscribe_interaction_class_with_regions(call, ears);
  flights.tick();
  EXPECT_TRUE(flights.execution().is_in_scope(reader.ambassador.federate(), object));
  const RegionHandle mouth = region_at(owner, 0.2, 0.4), other_mouth = region_at(owner, 4.2, 4.4);
  const auto speak = [&] {
    for (const RegionHandle& each : {mouth, other_mouth})
      owner.ambassador.send_interaction_with_regions(call, bytes_of("?"), std::span(&each, 1), {});
    flights.tick();
    return std::exchange(reader.heard.interactions, {}).size();
  };
  EXPECT_EQ(speak(), 2u);
  owner.ambassador.associate_regions_for_updates(object, places);
  owner.ambassador.unassociate_regions_for_updates(
      object, std::array{AttributeRegions{AttributeSet{where}, {far}}});
  owner.ambassador.delete_region(far);
  flights.tick();
  EXPECT_FALSE(flights.execution().is_in_scope(reader.ambassador.federate(), object))
      << "it is near, and not in the default region";
  reader.ambassador.unsubscribe_interaction_class_with_regions(call, std::span(ears, 1));
  reader.ambassador.delete_region(ears[0]);
  const RegionHandle same_place =
      region_at(reader, 0.0, 1.0);  // of the same number, in which it does not listen
  static_cast<void>(same_place);
  flights.tick();
  EXPECT_EQ(speak(), 1u);
}

TEST_P(Leaving, TakesItsDeclarationsWithIt) {
  reader.ambassador.subscribe_object_class_attributes(aircraft, AttributeSet{where});
  reader.ambassador.subscribe_interaction_class(call);
  reader.ambassador.watch_federates();
  const RegionHandle place = region_at(owner, 1.0, 2.0);
  const ObjectHandle object = add(owner, place);
  flights.tick();
  leave(1);
  Pilot& newcomer = arrive();
  arrive("third");
  update(owner, object);
  owner.ambassador.send_interaction(call, bytes_of("!"), {});
  flights.tick();
  EXPECT_TRUE(newcomer.heard.objects.empty());
  EXPECT_TRUE(newcomer.heard.interactions.empty());
  EXPECT_TRUE(newcomer.heard.federates.empty()) << "it did not ask who is there";
}

TEST_P(Leaving, TakesTheRelevanceOfItsSubscriptionsWithIt) {
  reader.ambassador.subscribe_object_class_attributes(aircraft, AttributeSet{where});
  flights.tick();
  flights.tick();
  const RegionHandle place = region_at(owner, 1.0, 2.0);
  const ObjectHandle object = add(owner, place);
  flights.tick();
  const std::uint64_t before = flights.execution().counters().updates_received;
  EXPECT_GT(before, 0u);
  leave(1);
  update(owner, object);
  flights.tick();
  EXPECT_EQ(flights.execution().counters().updates_received, before)
      << "nobody is left who listens";
}

TEST_P(Leaving, FreesItsNames) {
  reader.ambassador.reserve_object_instance_name("Fram");
  flights.tick();
  leave(1);
  Pilot& newcomer = arrive("pilot 1");
  EXPECT_EQ(newcomer.heard.log, std::vector<std::string>{"joined"}) << "the federate's own";
  newcomer.ambassador.reserve_object_instance_name("Fram");
  flights.tick();
  newcomer.ambassador.publish_object_class_attributes(aircraft, AttributeSet{where});
  witness.ambassador.subscribe_object_class_attributes(aircraft, AttributeSet{where});
  const ObjectHandle object = newcomer.ambassador.register_object_instance(aircraft, "Fram");
  flights.tick();
  EXPECT_EQ(witness.heard.objects.at(object.value).name, "Fram") << "and one that it had reserved";
}

TEST_P(Leaving, IsNoLongerAwaited) {
  owner.ambassador.register_synchronization_point("start", {});
  flights.tick();
  for (Pilot* each : {&owner, &witness}) each->ambassador.synchronization_point_achieved("start");
  flights.tick();
  EXPECT_EQ(std::ranges::count(witness.heard.log, "synchronized start"), 0);
  leave(1);
  flights.tick();
  EXPECT_EQ(std::ranges::count(witness.heard.log, "synchronized start"), 1);
}

TEST_P(Leaving, WithdrawsWhatItWantedToOwn) {
  for (Pilot* each : {&reader, &witness})
    each->ambassador.subscribe_object_class_attributes(aircraft, AttributeSet{where});
  const RegionHandle place = region_at(owner, 1.0, 2.0);
  const ObjectHandle object = add(owner, place);
  flights.tick();
  reader.ambassador.attribute_ownership_acquisition(object, AttributeSet{where}, {});
  flights.tick();
  leave(1);
  Pilot& newcomer = arrive();
  newcomer.ambassador.publish_object_class_attributes(aircraft, AttributeSet{where});
  owner.ambassador.unconditional_attribute_ownership_divestiture(object, AttributeSet{where});
  flights.tick();
  flights.tick();
  EXPECT_TRUE(std::ranges::none_of(newcomer.heard.ownership,
                                   [](const auto& each) { return each.what == "acquired"; }));
  witness.ambassador.query_attribute_ownership(object, where);
  flights.tick();
  const auto answer = witness.heard.owners.find({object.value, where.value});
  ASSERT_NE(answer, witness.heard.owners.end());
  EXPECT_EQ(answer->second, FederateHandle::none) << "nobody's, for who wanted it is gone";
}

TEST_P(Leaving, TakesItsRequestsForUpdatesWithIt) {
  const RegionHandle place = region_at(owner, 1.0, 2.0), view = region_at(reader, 0.0, 3.0);
  add(owner, place);
  flights.tick();
  const std::array pairs{AttributeRegions{AttributeSet{where}, {view}}};
  reader.ambassador.request_attribute_value_update_with_regions(aircraft, pairs);
  // It leaves before the RTI has looked for whom that concerns; the next in its place has asked for
  // nothing.
  flights.execution().receive(1, reader.ambassador.outgoing());
  reader.ambassador.clear_outgoing();
  flights.execution().disconnect(1, "killed");
  arrive();
  flights.tick();
  EXPECT_EQ(flights.execution().counters().drops, decltype(flights.execution().counters().drops){});
}

INSTANTIATE_TEST_SUITE_P(By, Leaving, ::testing::Bool(),
                         [](const auto& each) { return each.param ? "resigning" : "dying"; });

/// Blocks of handles: those that nobody has seen are used again, others never.
TEST(LeavingFederates, FreeTheirBlocksOnlyIfNoHandleOfTheirsWasEverSeen) {
  Flights<> flights(1);
  std::set<std::uint32_t> blocks;
  Pilot& stayer = flights.pilots()[0];
  const auto block_of = [](ObjectHandle object) { return object.value / object_block; };
  blocks.insert(block_of(stayer.ambassador.register_object_instance(aircraft)));
  for (int visit = 0; visit < 6; ++visit) {
    const auto connection = static_cast<ConnectionId>(flights.pilots().size());
    Pilot& visitor = flights.pilots().emplace_back();
    flights.execution().connect(connection);
    visitor.ambassador.join("rink", "visitor", "test");
    flights.tick();
    visitor.ambassador.publish_object_class_attributes(aircraft, AttributeSet{where});
    if (visit % 2 == 1) {
      EXPECT_TRUE(
          blocks.insert(block_of(visitor.ambassador.register_object_instance(aircraft))).second)
          << "a handle is never used twice";
    }
    flights.tick();
    visitor.ambassador.resign();
    ++flights.resigned;
    flights.tick();
  }
  EXPECT_EQ(*blocks.rbegin(), blocks.size() - 1) << "who registered nothing has used no block up";
}

}  // namespace
}  // namespace rink::rti::testing
