// An object that is associated with several regions is so after a restore.
#include <gtest/gtest.h>

#include <string>

#include "tests/rti/save/saved_fleet.h"

namespace rink::rti::testing {
namespace {

/// The harbour, where speed has the dimensions that position has.
const Fom& regional_harbour() {
  static const Fom fom = [] {
    std::string xml = harbour_xml;
    const std::string type = "<name>speed</name><dataType>HLAfloat32LE</dataType>";
    xml.insert(xml.find(type) + type.size(),
               "<dimensions><dimension>X</dimension><dimension>Y</dimension></dimensions>");
    return Fom::parse(xml, "regional.xml");
  }();
  return fom;
}

struct TwoRegions {
  AttributeSet in_south, in_north;
  bool is_seen_from_north;
};

/// Coast sees the same of a boat with these regions after a restore as before.
void expect_same_regions(SavedFleet& fleet, const TwoRegions& regions) {
  fleet.begin();
  auto &pilot = fleet.join("pilot"), &coast = fleet.join("coast", "guard");
  const auto region_of = [](Ambassador& rti, float y) {
    const RegionHandle region = rti.create_region();
    rti.set_region(region, {0.0f, y, 9.0f, y + 9.0f});
    rti.commit_region_modifications(region);
    return region;
  };
  Ambassador& rti = *pilot.ambassador;
  rti.publish_object_class_attributes(vessel, motion);
  const RegionHandle north = region_of(rti, 100.0f), south = region_of(rti, 0.0f);
  coast.ambassador->subscribe_object_class_attributes(
      vessel, motion, region_of(*coast.ambassador, regions.is_seen_from_north ? 100.0f : 0.0f));
  const ObjectHandle boat = rti.register_object_instance(vessel, "Boat");
  const AttributeRegions pairs[] = {{regions.in_south, {south}}, {regions.in_north, {north}}};
  rti.associate_regions_for_updates(boat, pairs);
  fleet.tick();
  const auto seen = [&] {
    coast.heard.objects[boat.value].values.clear();
    rti.update_attribute_values(boat, motion, motion_of(1.0f, 2.0f, 3.0f), {});
    fleet.tick();
    AttributeSet attributes;
    for (const auto& each : coast.heard.objects[boat.value].values) attributes.insert({each.first});
    return attributes;
  };
  const AttributeSet here = regions.is_seen_from_north ? regions.in_north : regions.in_south;
  const AttributeSet regional = regions.in_north | regions.in_south;
  const AttributeSet expected = here | motion.without(regional);
  EXPECT_EQ(seen(), expected);
  rti.request_federation_save("evening");
  fleet.tick();
  rti.request_federation_restore("evening");
  fleet.tick();
  ASSERT_EQ(coast.heard.told.back(), "restored");
  EXPECT_EQ(seen(), expected);
}

TEST(RestoredRegions, AreAllThoseOfAnObjectThatUsesSeveral) {
  SavedFleet fleet;
  fleet.model = &regional_harbour();
  for (const AttributeSet in_south : {AttributeSet{position}, AttributeSet{speed}, motion})
    for (const AttributeSet in_north : {AttributeSet{position}, AttributeSet{speed}, motion})
      for (const bool is_seen_from_north : {false, true})
        expect_same_regions(fleet, {in_south, in_north, is_seen_from_north});
}

}  // namespace
}  // namespace rink::rti::testing
