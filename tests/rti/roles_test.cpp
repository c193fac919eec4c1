// What the host of a federation tells its filter: teams, owners and what is always relevant, of
// objects and federates that come and go.
#include <gtest/gtest.h>

#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

FederationSettings under(const char* filter) {
  FederationSettings settings;
  settings.filter = filter;
  settings.filter_settings.world = {0.0, 0.0, 100.0, 100.0};
  return settings;
}

/// A pilot with vessels all over the sea, and watchers who look elsewhere.
struct FilteredHarbour {
  explicit FilteredHarbour(const char* filter)
      : rig(Carrier::in_process, under(filter)), pilot(rig.join("pilot")) {
    pilot.ambassador.publish_object_class_attributes(vessel, AttributeSet{position, speed});
  }
  RegionHandle place(Station& station, const im::Region& bounds) {
    const RegionHandle region = station.ambassador.create_region();
    station.ambassador.set_region(region, bounds);
    station.ambassador.commit_region_modifications(region);
    return region;
  }
  ObjectHandle add_vessel(RegionHandle region) {
    const ObjectHandle object = pilot.ambassador.register_object_instance(vessel);
    pilot.ambassador.associate_regions_for_updates(object, region);
    pilot.ambassador.update_attribute_values(object, AttributeSet{speed}, values_of(5.0f), {});
    return object;
  }
  ObjectHandle add_vessel(double at) { return add_vessel(place(pilot, {at, at, at, at})); }
  Station& add_watcher(const std::string& name) {
    Station& watcher = rig.join(name);
    watcher.ambassador.subscribe_object_class_attributes(vessel, AttributeSet{position, speed},
                                                         place(watcher, {90.0, 0.0, 99.0, 9.0}));
    return watcher;
  }
  void tell(ObjectHandle object, const im::Role& role) {
    rig.execution().set_object_role(object, role);
  }
  void tell(const Station& station, const im::Role& role) {
    rig.execution().set_federate_role(station.ambassador.federate(), role);
  }
  bool receives(const Station& station, ObjectHandle object) {
    const auto known = station.heard.objects.find(object.value);
    const bool is_heard = known != station.heard.objects.end() && known->second.is_in_scope;
    EXPECT_EQ(is_heard, rig.execution().is_in_scope(station.ambassador.federate(), object));
    return is_heard;
  }
  Rig rig;
  Station& pilot;
};

TEST(Roles, DecideWhoHearsOfWhatWhereverBothAre) {
  FilteredHarbour harbour("region or team or always");
  const ObjectHandle friendly = harbour.add_vessel(10.0), foreign = harbour.add_vessel(20.0),
                     lighthouse = harbour.add_vessel(30.0);
  Station &watcher = harbour.add_watcher("watcher"), &other = harbour.add_watcher("other");
  harbour.rig.settle();
  harbour.tell(friendly, {.team = 1}), harbour.tell(foreign, {.team = 2}),
      harbour.tell(lighthouse, {.is_always_relevant = true});
  harbour.tell(watcher, {.team = 1}), harbour.tell(other, {.team = 2});
  harbour.rig.settle();
  EXPECT_TRUE(harbour.receives(watcher, friendly) && harbour.receives(watcher, lighthouse) &&
              !harbour.receives(watcher, foreign));
  EXPECT_TRUE(harbour.receives(other, foreign) && harbour.receives(other, lighthouse) &&
              !harbour.receives(other, friendly));
  EXPECT_EQ(watcher.heard.objects.at(friendly.value).values.at(speed.value), values_of(5.0f))
      << "with its state";
  harbour.tell(friendly, {.team = 2});
  harbour.tell(lighthouse, {});
  harbour.rig.settle();
  EXPECT_TRUE(!harbour.receives(watcher, friendly) && !harbour.receives(watcher, lighthouse) &&
              harbour.receives(other, friendly));
}

TEST(Roles, MayBeSaidBeforeThereIsARegion) {
  FilteredHarbour harbour("team");
  Station& watcher = harbour.rig.join("watcher");
  const ObjectHandle object = harbour.pilot.ambassador.register_object_instance(vessel);
  harbour.rig.settle();
  harbour.tell(object, {.team = 3});
  harbour.tell(watcher, {.team = 3});
  const RegionHandle late = harbour.pilot.ambassador.create_region();
  harbour.pilot.ambassador.associate_regions_for_updates(object, late);
  const RegionHandle view = watcher.ambassador.create_region();
  watcher.ambassador.subscribe_object_class_attributes(vessel, AttributeSet{speed}, view);
  harbour.rig.settle();
  EXPECT_FALSE(harbour.receives(watcher, object)) << "neither is committed";
  harbour.pilot.ambassador.set_region(late, {1.0, 1.0, 1.0, 1.0});
  harbour.pilot.ambassador.commit_region_modifications(late);
  watcher.ambassador.set_region(view, {90.0, 90.0, 91.0, 91.0});
  watcher.ambassador.commit_region_modifications(view);
  harbour.rig.settle();
  EXPECT_TRUE(harbour.receives(watcher, object));
}

TEST(Roles, OfObjectsThatShareARegionAreWhatTheyAgreeIn) {
  FilteredHarbour harbour("team or always");
  const RegionHandle convoy = harbour.place(harbour.pilot, {5.0, 5.0, 6.0, 6.0});
  const ObjectHandle one = harbour.add_vessel(convoy), other = harbour.add_vessel(convoy);
  Station& watcher = harbour.add_watcher("watcher");
  harbour.rig.settle();
  harbour.tell(watcher, {.team = 1});
  harbour.tell(one, {.team = 1});
  harbour.rig.settle();
  EXPECT_FALSE(harbour.receives(watcher, one) || harbour.receives(watcher, other));
  harbour.tell(other, {.team = 1});
  harbour.rig.settle();
  EXPECT_TRUE(harbour.receives(watcher, one) && harbour.receives(watcher, other));
  harbour.tell(other, {.team = 2});
  harbour.rig.settle();
  EXPECT_FALSE(harbour.receives(watcher, one));
  harbour.pilot.ambassador.delete_object_instance(other);
  harbour.rig.settle();
  EXPECT_TRUE(harbour.receives(watcher, one)) << "it is alone now";
}

TEST(Roles, EndWithWhoHasThem) {
  FilteredHarbour harbour("team or owner");
  Station& first = harbour.add_watcher("first");
  const ObjectHandle object = harbour.add_vessel(10.0);
  harbour.rig.settle();
  harbour.tell(first, {.team = 1, .owner = 7});
  harbour.tell(object, {.team = 1, .owner = 7});
  harbour.rig.settle();
  ASSERT_TRUE(harbour.receives(first, object));
  const FederateHandle gone = first.ambassador.federate();
  first.ambassador.resign();
  harbour.rig.settle();
  harbour.rig.execution().set_federate_role(gone, {.team = 1});  // no longer there
  harbour.rig.execution().set_federate_role({4711}, {.team = 1});
  harbour.rig.execution().set_object_role({4711}, {.team = 1});
  Station& second = harbour.add_watcher("second");
  harbour.rig.settle();
  EXPECT_FALSE(harbour.receives(second, object)) << "in the place of the first, and of no team";
  harbour.tell(second, {.owner = 7});
  harbour.pilot.ambassador.delete_object_instance(object);
  harbour.rig.settle();
  const ObjectHandle next = harbour.add_vessel(10.0);
  harbour.rig.settle();
  EXPECT_FALSE(harbour.receives(second, next));
}

TEST(Roles, ShowAFederateWhatIsItsOwnUnderAnyFilter) {
  for (const char* filter : {"region", "not none", "region and not region", "none and not owner",
                             "grid with dwell(matches=3)"}) {
    FilteredHarbour harbour(filter);
    Station &owner = harbour.add_watcher("owner"), &other = harbour.add_watcher("other");
    const ObjectHandle object = harbour.add_vessel(10.0);
    harbour.tell(owner, {.owner = 7});
    harbour.rig.settle();
    harbour.tell(object, {.owner = 7});
    harbour.tell(other, {.owner = 8});
    harbour.rig.settle();
    EXPECT_TRUE(harbour.receives(owner, object)) << filter;
    EXPECT_EQ(harbour.receives(other, object), std::string(filter) == "none and not owner")
        << filter;
    harbour.pilot.ambassador.update_attribute_values(object, AttributeSet{speed}, values_of(6.0f),
                                                     {});
    harbour.rig.settle();
    EXPECT_EQ(owner.heard.objects.at(object.value).values.at(speed.value), values_of(6.0f))
        << filter;
    harbour.tell(object, {.owner = 8});
    harbour.rig.settle();
    EXPECT_TRUE(harbour.receives(other, object)) << filter;
  }
}

}  // namespace
}  // namespace rink::rti::testing
