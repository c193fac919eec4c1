// Regions as federates speak of them: what is taken, what is a crime, and what follows for
// subscriptions, uses and requests.
#include "rti/federation/services/region_service.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/rti/federation/service_ground.h"

namespace rink::rti {
namespace {

/// Ann has registered a body; Bob subscribes.
struct Chart : ServiceGround, ::testing::Test {
  template <class Record>
  static std::vector<std::byte> records_of(const std::vector<Record>& records) {
    std::vector<std::byte> bytes;
    Writer writer(bytes);
    for (Record record : records) exchange(writer, record);
    return bytes;
  }
  Status create(std::uint32_t slot, std::uint32_t region) {
    return hand_in(CreateRegionMessage{region},
                   [&](Reader& reader) { return regions.handle_create(slot, reader); });
  }
  Status create_over(std::uint32_t slot, std::uint32_t region, std::uint64_t dimensions) {
    return hand_in(CreateRegionOverMessage{region, dimensions},
                   [&](Reader& reader) { return regions.handle_create_over(slot, reader); });
  }
  Status place(std::uint32_t slot, std::uint32_t region, const im::Region& bounds) {
    const std::vector<std::byte> records = records_of<RegionBounds>({{{region}, bounds}});
    return hand_in(ModifyRegionsMessage{1, records},
                   [&](Reader& reader) { return regions.handle_modify(slot, reader); });
  }
  Status set_ranges(std::uint32_t slot, std::uint32_t region, const std::vector<Range>& wanted) {
    const std::vector<std::byte> ranges = records_of(wanted);
    return hand_in(ModifyRangesMessage{region, static_cast<std::uint8_t>(wanted.size()), ranges},
                   [&](Reader& reader) { return regions.handle_modify_ranges(slot, reader); });
  }
  Status remove(std::uint32_t slot, std::uint32_t region) {
    return hand_in(DeleteRegionMessage{region},
                   [&](Reader& reader) { return regions.handle_delete(slot, reader); });
  }
  Status associate(std::uint32_t slot, std::uint32_t object, std::uint32_t region) {
    return hand_in(AssociateRegionMessage{object, region},
                   [&](Reader& reader) { return regions.handle_associate(slot, reader); });
  }
  Status of_class(std::uint32_t slot, RegionAction action, AttributeSet attributes,
                  std::uint32_t region) {
    const std::vector<std::byte> pairs =
        records_of<AttributeRegionRecord>({{attributes.bits, region}});
    return hand_in(RegionalClassMessage{body_class, static_cast<std::uint8_t>(action), 1, pairs},
                   [&](Reader& reader) { return regions.handle_class(slot, reader); });
  }
  Subscription subscribed() const { return ground.distribution->subscribed(bob, body_class, {0}); }

  RegionService regions{ground.basis(),
                        {*ground.distribution, ground.ownership, objects.known, objects.requests}};
  const std::uint32_t ann = admit("ann"), bob = admit("bob");
  const ObjectSlot boat = add_object(ann, body_class);
};

TEST_F(Chart, NumbersRegionsWithoutGapsForEachFederateByItself) {
  EXPECT_EQ(create(ann, 1), Violation::unknown_name) << "it would leave a gap";
  EXPECT_EQ(create(ann, 0), Status());
  EXPECT_EQ(create(ann, 0), Violation::unknown_name) << "it is there";
  EXPECT_EQ(create(ann, 1), Status());
  EXPECT_EQ(create(bob, 0), Status());
  EXPECT_EQ(federate(ann).counts.regions, 2u);
  EXPECT_EQ(remove(ann, 0), Status());
  EXPECT_EQ(remove(ann, 0), Violation::unknown_name);
  EXPECT_EQ(federate(ann).counts.regions, 1u);
  EXPECT_EQ(create(ann, 0), Status());
}

TEST_F(Chart, TakesNoBoundsThatAreNone) {
  create(ann, 0);
  EXPECT_EQ(place(ann, 0, {0, 0, 1, 1}), Status());
  EXPECT_EQ(place(ann, 0, {2, 0, 1, 1}), Violation::malformed);
  EXPECT_EQ(place(ann, 0, {0, 3, 1, 2}), Violation::malformed);
  EXPECT_EQ(place(ann, 1, {0, 0, 1, 1}), Violation::unknown_name);
  EXPECT_EQ(place(bob, 0, {0, 0, 1, 1}), Violation::unknown_name) << "it is another's";
}

/// Of dimensions X, Y and Height: one range for each that it has.
TEST_F(Chart, TakesARangeForEachDimensionOfARegion) {
  EXPECT_EQ(create_over(ann, 0, 0b1000), Violation::unknown_name) << "there is no fourth";
  EXPECT_EQ(create_over(ann, 0, 0b101), Status());
  EXPECT_EQ(set_ranges(ann, 0, {{0, 1}}), Violation::unknown_name);
  EXPECT_EQ(set_ranges(ann, 0, {{0, 1}, {5, 4}}), Violation::malformed);
  EXPECT_EQ(set_ranges(ann, 0, {{0, 1}, {4, 5}}), Status());
  EXPECT_EQ(place(ann, 0, {0, 0, 1, 1}), Violation::unknown_name) << "it is not over the plane";
  EXPECT_EQ(set_ranges(ann, 1, {{0, 1}, {4, 5}}), Violation::unknown_name);
}

TEST_F(Chart, TellsTheFilterWhereAnObjectIsThatUsesARegion) {
  create(ann, 0), place(ann, 0, {0, 0, 1, 1});
  EXPECT_TRUE(filter->entities.empty());
  EXPECT_EQ(associate(ann, number_of(boat), 0), Status());
  ASSERT_EQ(filter->entities.size(), 1u);
  EXPECT_EQ(filter->entities.begin()->second, (im::Region{0, 0, 1, 1}));
  EXPECT_EQ(associate(ann, number_of(boat), RegionHandle::none), Status());
  EXPECT_TRUE(filter->entities.empty());
}

TEST_F(Chart, LetsNobodyPlaceAnothersObjectNorUseAnothersRegion) {
  create(bob, 0);
  EXPECT_EQ(associate(bob, number_of(boat), 0), Violation::not_owned);
  EXPECT_EQ(associate(ann, number_of(boat), 0), Violation::unknown_name);
  EXPECT_EQ(associate(ann, 4711, RegionHandle::none), Violation::unknown_name);
  const std::uint32_t number = number_of(boat);
  objects.objects.remove(boat);
  EXPECT_EQ(associate(ann, number, RegionHandle::none), Status())
      << "who deleted it was faster, which is no crime";
}

TEST_F(Chart, SubscribesWithinARegionAttributeByAttribute) {
  create(bob, 0), place(bob, 0, {0, 0, 9, 9});
  of_class(bob, RegionAction::add, position, 0);
  EXPECT_EQ(subscribed(), (Subscription{position, position}));
  of_class(bob, RegionAction::add_passively, colour, 0);
  EXPECT_EQ(subscribed(), (Subscription{both, position}));
  of_class(bob, RegionAction::add_passively, position, 0);
  EXPECT_EQ(subscribed(), (Subscription{both, {}})) << "the later word counts";
  of_class(bob, RegionAction::remove, position, 0);
  EXPECT_EQ(subscribed(), (Subscription{colour, {}}));
  EXPECT_EQ(filter->subscribers.size(), 1u);
  of_class(bob, RegionAction::remove, colour, 0);
  EXPECT_TRUE(filter->subscribers.empty());
  EXPECT_EQ(of_class(bob, RegionAction::add, AttributeSet(1u << 9), 0), Violation::unknown_name);
  EXPECT_EQ(of_class(bob, RegionAction::add, position, 3), Violation::unknown_name);
}

/// Also where the region is deleted at once.
TEST_F(Chart, AsksOwnersOfWhatOverlapsForItsValues) {
  create(ann, 0), place(ann, 0, {0, 0, 1, 1});
  associate(ann, number_of(boat), 0);
  create(bob, 0);
  for (const bool is_near : {true, false})
    for (const bool is_deleted : {false, true}) {
      const double x = is_near ? 1.0 : 2.0;
      place(bob, 0, {x, 0, 9, 9});
      of_class(bob, RegionAction::request_update, colour, 0);
      if (is_deleted) remove(bob, 0);
      objects.requests.settle();
      if (is_deleted) create(bob, 0);
      std::vector<AttributeBits> asked;
      for_each_said_to<ProvideUpdateMessage>(
          federate(ann), [&](const auto& message) { asked.push_back(message.attributes); });
      EXPECT_EQ(asked, is_near ? std::vector{colour.bits} : std::vector<AttributeBits>())
          << is_near << is_deleted;
    }
}

/// What it made is gone with it: nobody is subscribed or placed by it any more.
TEST_F(Chart, EndsWithTheFederateThatMadeIt) {
  create(bob, 0), place(bob, 0, {0, 0, 9, 9});
  of_class(bob, RegionAction::add, position, 0);
  create(ann, 0), place(ann, 0, {0, 0, 1, 1});
  associate(ann, number_of(boat), 0);
  ground.distribution->remove_federate(bob);
  EXPECT_TRUE(filter->subscribers.empty());
  EXPECT_EQ(filter->entities.size(), 1u);
  ground.distribution->remove_federate(ann);
  EXPECT_TRUE(filter->entities.empty());
  ground.distribution->add_federate(bob);
  EXPECT_FALSE(ground.distribution->has_region(bob, {0}));
}

}  // namespace
}  // namespace rink::rti
