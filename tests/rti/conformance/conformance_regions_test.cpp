// Sentences of IEEE 1516.1-2010, clause 9, about regions: what each service does, and what it
// refuses by which name.
#include <gtest/gtest.h>

#include "tests/rti/errors.h"
#include "tests/rti/scenes/airspace.h"

namespace rink::rti::testing {
namespace {

struct Sky {
  Flights<> flights{2};
  Pilot &owner = flights.pilots()[0], &watcher = flights.pilots()[1];
  Ambassador &up = owner.ambassador, &down = watcher.ambassador;

  static RegionHandle region(Ambassador& ambassador, DimensionSet dimensions, const Range& range) {
    const RegionHandle made = ambassador.create_region(dimensions);
    dimensions.for_each(
        [&](DimensionHandle each) { ambassador.set_range_bounds(made, each, range); });
    ambassador.commit_region_modifications(made);
    return made;
  }
  static std::array<AttributeRegions, 1> pair(AttributeHandle attribute, RegionHandle region) {
    return {AttributeRegions{AttributeSet{attribute}, {region}}};
  }
  bool is_in_scope(ObjectHandle object) {
    return flights.execution().is_in_scope(down.federate(), object);
  }
};

// 9.2
TEST(Conformance, ARegionIsCreatedForTheSpecifiedDimensions) {
  Sky sky;
  const RegionHandle made = sky.up.create_region({altitude, channel});
  EXPECT_EQ(sky.up.get_dimension_handle_set(made), (DimensionSet{altitude, channel}));
  EXPECT_EQ(error_thrown_by([&] { sky.up.create_region(DimensionSet{DimensionHandle{9}}); }),
            HlaError::invalid_dimension_handle);
}

// 9.2
TEST(Conformance, RangesThatWereNeverSetAreAllOfADimensionWithAnUpperBound) {
  Sky sky;
  EXPECT_EQ(sky.up.get_range_bounds(sky.up.create_region({channel}), channel), (Range{0.0, 6.0}));
  EXPECT_EQ(error_thrown_by(
                [&] { sky.up.commit_region_modifications(sky.up.create_region({altitude})); }),
            HlaError::invalid_region)
      << "no bound to fill it with";
}

// 9.3
TEST(Conformance, ACommitInformsTheRtiOfChangesAndNothingElseDoes) {
  Sky sky;
  const RegionHandle update = Sky::region(sky.up, {channel}, {1.0, 2.0}),
                     view = Sky::region(sky.down, {channel}, {1.0, 2.0});
  const ObjectHandle object =
      sky.up.register_object_instance_with_regions(aircraft, Sky::pair(where, update));
  sky.down.subscribe_object_class_attributes_with_regions(aircraft, Sky::pair(where, view));
  sky.flights.tick();
  EXPECT_TRUE(sky.is_in_scope(object));
  sky.down.set_range_bounds(view, channel, {4.0, 5.0});
  sky.flights.tick();
  EXPECT_TRUE(sky.is_in_scope(object));
  EXPECT_EQ(sky.down.get_range_bounds(view, channel), (Range{4.0, 5.0}));
  sky.down.commit_region_modifications(view);
  sky.flights.tick();
  EXPECT_FALSE(sky.is_in_scope(object));
}

// 9.3
TEST(Conformance, NoRegionOfASetIsCommittedIfOneOfThemIsInvalid) {
  Sky sky;
  const std::array regions{Sky::region(sky.up, {channel}, {1.0, 2.0}),
                           sky.up.create_region({altitude})};
  sky.flights.tick();
  EXPECT_EQ(error_thrown_by([&] { sky.up.commit_region_modifications(regions); }),
            HlaError::invalid_region);
  EXPECT_TRUE(sky.up.outgoing().empty());
}

// 9.4
TEST(Conformance, ARegionInUseForUpdateOrSubscriptionIsNotDeleted) {
  Sky sky;
  const RegionHandle region = Sky::region(sky.up, {channel}, {1.0, 2.0});
  const auto refused = [&] {
    return error_thrown_by([&] { sky.up.delete_region(region); }) ==
           HlaError::region_in_use_for_update_or_subscription;
  };
  const ObjectHandle object =
      sky.up.register_object_instance_with_regions(aircraft, Sky::pair(where, region));
  EXPECT_TRUE(refused());
  sky.up.unassociate_regions_for_updates(object, Sky::pair(where, region));
  sky.up.subscribe_object_class_attributes_with_regions(aircraft, Sky::pair(radio, region));
  EXPECT_TRUE(refused());
  sky.up.unsubscribe_object_class_attributes_with_regions(aircraft, Sky::pair(radio, region));
  sky.up.subscribe_interaction_class_with_regions(call, std::span(&region, 1));
  EXPECT_TRUE(refused());
  sky.up.unsubscribe_interaction_class_with_regions(call, std::span(&region, 1));
  sky.up.associate_regions_for_updates(object, region);
  EXPECT_TRUE(refused());
  sky.up.delete_object_instance(object);
  const ObjectHandle other = sky.up.register_object_instance(aircraft);
  sky.up.associate_regions_for_updates(other, Sky::pair(where, region));
  EXPECT_TRUE(refused());
  sky.up.delete_object_instance(other);
  EXPECT_FALSE(refused());
  EXPECT_EQ(error_thrown_by([&] { sky.up.delete_region(region); }), HlaError::invalid_region)
      << "it is gone";
  sky.flights.tick();
}

// 9.4
TEST(Conformance, ARegionIsDeletedOnlyByTheFederateThatCreatedIt) {
  Sky sky;
  const RegionHandle foreign = Sky::region(sky.down, {channel}, {1.0, 2.0});
  EXPECT_EQ(error_thrown_by([&] { sky.up.delete_region(foreign); }),
            HlaError::region_not_created_by_this_federate);
  EXPECT_EQ(error_thrown_by([&] {
              sky.up.set_range_bounds(foreign, channel, {1.0, 2.0});
            }),
            HlaError::region_not_created_by_this_federate);
  EXPECT_EQ(error_thrown_by([&] {
              sky.up.subscribe_interaction_class_with_regions(call, std::span(&foreign, 1));
            }),
            HlaError::region_not_created_by_this_federate);
  EXPECT_EQ(error_thrown_by([&] { sky.up.delete_region({}); }), HlaError::invalid_region);
}

// 9.5
TEST(Conformance, AnObjectRegisteredWithRegionsIsNeverSeenOutsideThem) {
  Sky sky;
  const RegionHandle update = Sky::region(sky.up, {channel}, {1.0, 2.0}),
                     view = Sky::region(sky.down, {channel}, {3.0, 4.0});
  sky.down.subscribe_object_class_attributes_with_regions(aircraft, Sky::pair(where, view));
  const ObjectHandle object =
      sky.up.register_object_instance_with_regions(aircraft, Sky::pair(where, update));
  sky.flights.tick();
  EXPECT_FALSE(sky.is_in_scope(object));
  EXPECT_TRUE(sky.watcher.heard.discoveries.empty());
}

// 9.5, 9.6, 9.8
TEST(Conformance, ARegionWithADimensionThatIsNotAvailableForTheAttributeIsOutOfContext) {
  Sky sky;
  const RegionHandle region = Sky::region(sky.up, {channel}, {1.0, 2.0});
  const auto foreign = Sky::pair(weight, region);
  const ObjectHandle object = sky.up.register_object_instance(aircraft);
  EXPECT_EQ(
      error_thrown_by([&] { sky.up.register_object_instance_with_regions(aircraft, foreign); }),
      HlaError::invalid_region_context);
  EXPECT_EQ(error_thrown_by([&] { sky.up.associate_regions_for_updates(object, foreign); }),
            HlaError::invalid_region_context);
  EXPECT_EQ(error_thrown_by(
                [&] { sky.up.subscribe_object_class_attributes_with_regions(aircraft, foreign); }),
            HlaError::invalid_region_context);
}

// 9.6
TEST(Conformance, AssociatedRegionsAddUpAndAttributesWithoutAnyUseTheDefaultRegion) {
  Sky sky;
  const RegionHandle low = Sky::region(sky.up, {channel}, {1.0, 2.0}),
                     high = Sky::region(sky.up, {channel}, {4.0, 5.0}),
                     view = Sky::region(sky.down, {channel}, {4.0, 5.0});
  sky.down.subscribe_object_class_attributes_with_regions(aircraft, Sky::pair(where, view));
  const ObjectHandle object = sky.up.register_object_instance(aircraft);
  sky.flights.tick();
  EXPECT_TRUE(sky.is_in_scope(object)) << "the default region overlaps all";
  sky.up.associate_regions_for_updates(object, Sky::pair(where, low));
  sky.flights.tick();
  EXPECT_FALSE(sky.is_in_scope(object));
  sky.up.associate_regions_for_updates(object, Sky::pair(where, high));
  sky.flights.tick();
  EXPECT_TRUE(sky.is_in_scope(object));
  sky.up.unassociate_regions_for_updates(object, Sky::pair(where, high));  // 9.7
  sky.flights.tick();
  EXPECT_FALSE(sky.is_in_scope(object));
  sky.up.unassociate_regions_for_updates(object, Sky::pair(where, low));
  sky.flights.tick();
  EXPECT_TRUE(sky.is_in_scope(object));
}

// 9.6
TEST(Conformance, OnlyWhoOwnsAnAttributeAssociatesRegionsWithIt) {
  Sky sky;
  const ObjectHandle object = sky.up.register_object_instance(aircraft);
  sky.down.subscribe_object_class_attributes(aircraft, AttributeSet{where});
  sky.flights.tick();
  const RegionHandle view = Sky::region(sky.down, {channel}, {1.0, 2.0});
  EXPECT_EQ(error_thrown_by(
                [&] { sky.down.associate_regions_for_updates(object, Sky::pair(where, view)); }),
            HlaError::attribute_not_owned);
  EXPECT_EQ(error_thrown_by([&] {
              sky.down.associate_regions_for_updates(ObjectHandle{77}, Sky::pair(where, view));
            }),
            HlaError::object_instance_not_known);
}

// 9.8, 9.9
TEST(Conformance, SubscriptionsWithRegionsAddUpAndEndOneByOne) {
  Sky sky;
  const RegionHandle update = Sky::region(sky.up, {channel}, {1.0, 2.0}),
                     near = Sky::region(sky.down, {channel}, {1.0, 2.0}),
                     far = Sky::region(sky.down, {channel}, {4.0, 5.0});
  const ObjectHandle object =
      sky.up.register_object_instance_with_regions(aircraft, Sky::pair(where, update));
  sky.down.subscribe_object_class_attributes_with_regions(aircraft, Sky::pair(where, far));
  sky.down.subscribe_object_class_attributes_with_regions(aircraft, Sky::pair(where, near));
  sky.flights.tick();
  EXPECT_TRUE(sky.is_in_scope(object));
  sky.down.unsubscribe_object_class_attributes_with_regions(aircraft, Sky::pair(where, near));
  sky.flights.tick();
  EXPECT_FALSE(sky.is_in_scope(object));
}

// 9.10, 9.12
TEST(Conformance, AnInteractionSentWithRegionsReachesThoseWhoseRegionsOverlapAndThoseWithoutAny) {
  Sky sky;
  const RegionHandle sent = Sky::region(sky.up, {channel}, {1.0, 2.0}),
                     near = Sky::region(sky.down, {channel, altitude}, {1.0, 2.0}),
                     far = Sky::region(sky.down, {channel}, {4.0, 5.0});
  const auto heard = [&] {
    sky.watcher.heard.interactions.clear();
    sky.up.send_interaction_with_regions(call, values_of(std::uint8_t{1}), std::span(&sent, 1), {});
    sky.flights.tick();
    return sky.watcher.heard.interactions.size();
  };
  sky.down.subscribe_interaction_class_with_regions(call, std::span(&far, 1));
  sky.flights.tick();
  EXPECT_EQ(heard(), 0u);
  sky.down.subscribe_interaction_class_with_regions(call, std::span(&near, 1));
  sky.flights.tick();
  EXPECT_EQ(heard(), 1u);
  sky.down.unsubscribe_interaction_class_with_regions(call, std::span(&near, 1));  // 9.11
  sky.flights.tick();
  EXPECT_EQ(heard(), 0u);
  sky.down.subscribe_interaction_class(call);
  sky.flights.tick();
  EXPECT_EQ(heard(), 1u);
}

// 9.12
TEST(Conformance, AnInteractionSentWithoutRegionsOverlapsEverySubscription) {
  Sky sky;
  const RegionHandle far = Sky::region(sky.down, {channel}, {4.0, 5.0});
  sky.down.subscribe_interaction_class_with_regions(call, std::span(&far, 1));
  sky.flights.tick();
  sky.up.send_interaction(call, values_of(std::uint8_t{1}), {});
  sky.flights.tick();
  EXPECT_EQ(sky.watcher.heard.interactions.size(), 1u);
}

// 9.13
TEST(Conformance, OwnersAreAskedForTheAttributesThatOverlapTheRegionOfARequest) {
  struct Provider : Recorder {
    std::vector<std::pair<ObjectHandle, AttributeSet>> asked;
    void provide_attribute_value_update(ObjectHandle object, AttributeSet attributes,
                                        Bytes) override {
      asked.emplace_back(object, attributes);
    }
  };
  struct Owner {
    Provider heard;
    Ambassador ambassador{airspace(), heard};
  };
  Flights<Owner> flights(2);
  Ambassador &up = flights.pilots()[0].ambassador, &down = flights.pilots()[1].ambassador;
  const RegionHandle near = Sky::region(up, {channel}, {1.0, 2.0}),
                     far = Sky::region(up, {channel}, {4.0, 5.0}),
                     view = Sky::region(down, {channel}, {1.0, 3.0});
  const ObjectHandle object =
      up.register_object_instance_with_regions(aircraft, Sky::pair(where, near));
  up.register_object_instance_with_regions(
      aircraft, std::array{AttributeRegions{AttributeSet{where, radio}, {far}}});
  flights.tick();
  down.request_attribute_value_update_with_regions(
      aircraft, std::array{AttributeRegions{AttributeSet{where, radio}, {view}}});
  flights.tick();
  const auto& asked = flights.pilots()[0].heard.asked;
  ASSERT_EQ(asked.size(), 1u);
  EXPECT_EQ(asked[0].first, object);
  EXPECT_EQ(asked[0].second, (AttributeSet{where, radio})) << "radio is of the default region";
  EXPECT_TRUE(flights.pilots()[1].heard.asked.empty());
}

// 9.1
TEST(Conformance, RegionsWithoutADimensionInCommonDoNotOverlap) {
  Sky sky;
  const RegionHandle update = Sky::region(sky.up, {channel}, {1.0, 2.0}),
                     view = Sky::region(sky.down, {altitude}, {1.0, 2.0});
  const ObjectHandle object =
      sky.up.register_object_instance_with_regions(aircraft, Sky::pair(where, update));
  sky.down.subscribe_object_class_attributes_with_regions(aircraft, Sky::pair(where, view));
  sky.flights.tick();
  EXPECT_FALSE(sky.is_in_scope(object));
}

// 10.25 to 10.30: dimensions by name, their bounds, and where they are available
TEST(Conformance, DimensionsAreLookedUpByNameAndGiveTheirBounds) {
  Sky sky;
  EXPECT_EQ(sky.up.get_dimension_handle("Channel"), channel);
  EXPECT_EQ(error_thrown_by([&] { sky.up.get_dimension_handle("Colour"); }),
            HlaError::name_not_found);
  EXPECT_EQ(sky.up.get_dimension_name(altitude), "Altitude");
  EXPECT_EQ(sky.up.get_dimension_upper_bound(channel), 6u);
  EXPECT_EQ(sky.up.get_dimension_upper_bound(altitude), std::nullopt)
      << "measured: any finite number";
  EXPECT_EQ(sky.up.get_available_dimensions_for_class_attribute(aircraft, where),
            (DimensionSet{x, y, altitude, channel}));
  EXPECT_TRUE(sky.up.get_available_dimensions_for_class_attribute(aircraft, weight).is_empty());
  EXPECT_EQ(sky.up.get_available_dimensions_for_interaction_class(call),
            (DimensionSet{x, y, altitude, channel}));
}

// 10.31, 10.32
TEST(Conformance, RangeBoundsAreThoseOfAContainedDimensionAndWithinIt) {
  Sky sky;
  const RegionHandle region = sky.up.create_region({channel, altitude});
  const auto error = [&](DimensionHandle dimension, const Range& range) {
    return error_thrown_by([&] { sky.up.set_range_bounds(region, dimension, range); });
  };
  EXPECT_EQ(error(x, {0.0, 1.0}), HlaError::region_does_not_contain_specified_dimension);
  EXPECT_EQ(error(DimensionHandle{12}, {0.0, 1.0}), HlaError::invalid_dimension_handle);
  for (const Range& range :
       {Range{2.0, 2.0}, Range{3.0, 2.0}, Range{-1.0, 2.0}, Range{5.0, 7.0}, Range{0.5, 2.0}})
    EXPECT_EQ(error(channel, range), HlaError::invalid_range_bound);
  EXPECT_EQ(error(altitude, {2.0, 1.0}), HlaError::invalid_range_bound);
  EXPECT_EQ(error(altitude, {0.0, std::numeric_limits<double>::infinity()}),
            HlaError::invalid_range_bound);
  EXPECT_EQ(error(altitude, {1.5, 1.5}), HlaError::none);
  EXPECT_EQ(error(channel, {0.0, 6.0}), HlaError::none);
}

}  // namespace
}  // namespace rink::rti::testing
