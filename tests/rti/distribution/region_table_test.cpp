// Regions by themselves: bounds, uses and overlaps, without federation or federates.
#include "rti/distribution/region_table.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/rti/distribution/told_filter.h"

namespace rink::rti {
namespace {

struct RegionTableAlone : ::testing::Test {
  void SetUp() override {
    regions.add_federate(0);
    for (std::uint32_t i = 0; i < 3; ++i) {
      objects.insert({i}, 0, body_class, "");
      regions.add_object(i);
    }
  }
  RegionSlot made(RegionHandle handle, DimensionSet dimensions = {}) {
    EXPECT_TRUE(regions.create(0, handle, dimensions));
    return regions.slot_of(0, handle);
  }
  DimensionHandle dimension(const char* name) const { return *plain_fom().dimension(name); }

  ObjectTable objects{plain_fom()};
  ToldFilter filter;
  FilterFacts facts{filter};
  DistributionCounters counters;
  RegionTable regions{plain_fom(), objects, filter, facts, counters};
  const AttributeSet both = plain_fom().attributes({body_class}), one{AttributeHandle{0}};
};

TEST_F(RegionTableAlone, GivesHandlesWithoutGapsAndUsesSlotsAgain) {
  EXPECT_FALSE(regions.create(0, {1}, {})) << "it would leave a gap";
  const RegionSlot first = made({0});
  EXPECT_FALSE(regions.create(0, {0}, {})) << "it is in use";
  EXPECT_TRUE(regions.has(0, {0}));
  regions.remove(0, {0});
  EXPECT_FALSE(regions.has(0, {0}));
  EXPECT_EQ(made({0}), first);
}

TEST_F(RegionTableAlone, TellsTheFilterOfRegionsThatAreUsedAndCommitted) {
  const RegionSlot slot = made({0});
  EXPECT_EQ(regions.modify(0, {0}, im::Region{0, 0, 1, 1}), Commit::first);
  EXPECT_TRUE(filter.entities.empty()) << "nobody uses it";
  regions.associate(0, slot);
  ASSERT_EQ(filter.entities.size(), 1u);
  EXPECT_EQ(regions.modify(0, {0}, im::Region{0, 0, 2, 2}), Commit::moved);
  EXPECT_EQ(filter.entities.begin()->second, (im::Region{0, 0, 2, 2}));
  EXPECT_EQ(regions.modify(0, {0}, im::Region{0, 0, 2, 2}), Commit::unchanged);
  EXPECT_EQ(regions.modify(0, {7}, im::Region{}), Commit::impossible);
  EXPECT_EQ(counters.regions_changed, 2u);
  EXPECT_TRUE(regions.changed().empty()) << "the filter knows all of it";
}

TEST_F(RegionTableAlone, SaysWhatFollowsWhenAnObjectUsesAnotherRegion) {
  const RegionSlot first = made({0}), second = made({1});
  regions.modify(0, {0}, im::Region{0, 0, 1, 1});
  regions.modify(0, {1}, im::Region{5, 5, 6, 6});
  regions.associate(0, first);
  const im::Entity entity = regions.use_of(0).entity;
  const Reassociation change = regions.associate(0, second);
  EXPECT_EQ(change.objects, std::vector<ObjectSlot>{0});
  EXPECT_EQ(change.gone, std::vector<im::Entity>{entity});
  EXPECT_FALSE(change.is_mixing_changed);
  EXPECT_EQ(regions.use_of(0).region, second);
  EXPECT_EQ(filter.entities.size(), 1u);
}

TEST_F(RegionTableAlone, MixesWhereAttributesOfAnObjectUseDifferentRegions) {
  const RegionSlot first = made({0}), second = made({1});
  EXPECT_TRUE(regions.associate(0, first, one).is_mixing_changed);
  EXPECT_EQ(regions.use_of(0).region, RegionTable::several);
  EXPECT_FALSE(regions.associate(0, second, both.without(one)).is_mixing_changed);
  EXPECT_EQ(regions.several_of(0).size(), 2u);
  EXPECT_TRUE(regions.disassociate(0, first, one).is_mixing_changed == false &&
              regions.has_several());
  EXPECT_TRUE(regions.associate(0, second).is_mixing_changed);
  EXPECT_FALSE(regions.has_several());
}

TEST_F(RegionTableAlone, FreesItsObjectsWhenItIsRemoved) {
  const RegionSlot slot = made({0});
  regions.modify(0, {0}, im::Region{0, 0, 1, 1});
  regions.associate(0, slot);
  regions.associate(2, slot);
  const Reassociation change = regions.remove(0, {0});
  EXPECT_EQ(change.objects, (std::vector<ObjectSlot>{2, 0}));
  EXPECT_EQ(change.gone.size(), 1u) << "they shared it";
  EXPECT_EQ(regions.use_of(2).region, no_region);
  EXPECT_TRUE(filter.entities.empty());
}

TEST_F(RegionTableAlone, OverlapsInEveryDimensionThatTwoHaveInCommon) {
  const DimensionSet space{dimension("X"), dimension("Y"), dimension("Height")};
  const RegionSlot flat = made({0}), low = made({1}, space), high = made({2}, space),
                   height = made({3}, {dimension("Height")});
  regions.modify(0, {0}, im::Region{0, 0, 4, 4});
  regions.modify(0, {1}, std::array{Range{1, 2}, Range{1, 2}, Range{0, 1}});
  regions.modify(0, {2}, std::array{Range{1, 2}, Range{1, 2}, Range{5, 6}});
  regions.modify(0, {3}, std::array{Range{1, 5}});
  const auto overlap = [&](RegionSlot a, RegionSlot b) {
    return regions.overlap(regions[a], regions[b]);
  };
  EXPECT_TRUE(overlap(flat, low));
  EXPECT_FALSE(overlap(low, high));
  EXPECT_TRUE(overlap(low, height)) << "at 1";
  EXPECT_TRUE(overlap(high, height)) << "at 5";
  EXPECT_FALSE(overlap(flat, height)) << "nothing in common";
}

TEST_F(RegionTableAlone, ListsWhatTheFilterCannotKnow) {
  const RegionSlot height = made({0}, {dimension("Height")}), flat = made({1});
  regions.modify(0, {0}, std::array{Range{1, 5}});
  EXPECT_EQ(std::vector(regions.changed().begin(), regions.changed().end()),
            std::vector<RegionSlot>{height});
  regions.forget_changed();
  regions.modify(0, {1}, im::Region{0, 0, 1, 1});
  EXPECT_TRUE(regions.changed().empty());
  regions.count_subscription(height, true);
  regions.modify(0, {1}, im::Region{0, 0, 2, 2});
  EXPECT_EQ(regions.changed().size(), 1u) << "somebody subscribes beyond the plane";
  EXPECT_EQ(regions.changed()[0], flat);
  regions.count_subscription(height, false);
}

}  // namespace
}  // namespace rink::rti
