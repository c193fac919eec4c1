// Updates held back within bounds, in a federation: told when the bounds say so, and never lost.
#include <gtest/gtest.h>

#include <string>

#include "tests/rti/time/buoyed_sea.h"

namespace rink::rti::testing {
namespace {

TEST(HeldUpdates, AreToldWhenTheirBoundIsExceeded) {
  BuoyedSea sea("region with vfc(at=0.25 matches=5)");
  sea.add_buoy(52.0, 50.0);
  sea.add_buoy(95.0, 50.0);
  sea.add_watcher({0.0, 0.0, 100.0, 100.0});
  sea.rig.settle();
  const int before = sea.known(0, sea.buoys[1]).updates;
  for (int match = 1; match <= 60; ++match) {
    for (Buoy& each : sea.buoys) sea.say(each, static_cast<float>(match));
    sea.round();
    ASSERT_EQ(sea.heard(0, sea.buoys[0]), static_cast<float>(match)) << "near";
    ASSERT_EQ(sea.heard(0, sea.buoys[1]), match < 6 ? 0.5f : static_cast<float>(match / 6 * 6));
  }
  EXPECT_EQ(sea.known(0, sea.buoys[1]).updates - before, 10);
  sea.say(sea.buoys[1], 100.0f);
  for (int match = 0; match < 5; ++match) sea.round();
  sea.round();
  EXPECT_EQ(sea.heard(0, sea.buoys[1]), 100.0f) << "at rest, too";
}

TEST(HeldUpdates, OfOneWhoSubscribesEverywhereDoNotWait) {
  BuoyedSea sea("region with vfc(at=0 matches=60)");
  Buoy& buoy = sea.add_buoy(95.0, 50.0);
  Station& watcher = sea.add_watcher({0.0, 0.0, 100.0, 100.0});
  sea.rig.settle();
  sea.say(buoy, 1.0f);
  sea.round();
  EXPECT_EQ(sea.heard(0, buoy), 0.5f);
  watcher.ambassador.subscribe_object_class_attributes(ferry, {speed, destination}, {});
  sea.round();
  EXPECT_EQ(sea.heard(0, buoy), 1.0f);
  sea.say(buoy, 2.0f);
  sea.round();
  EXPECT_EQ(sea.heard(0, buoy), 2.0f);
}

TEST(HeldUpdates, AreToldWhenTheirObjectComesIntoAnotherSubscriptionOrGetsAnotherRegion) {
  BuoyedSea sea("region with vfc(at=0 matches=60)");
  Buoy& buoy = sea.add_buoy(95.0, 50.0);
  Station& watcher = sea.add_watcher({0.0, 0.0, 100.0, 100.0});
  sea.rig.settle();
  const auto say = [&](float value) {
    sea.say(buoy, value);
    sea.round();
  };
  say(1.0f);
  EXPECT_EQ(sea.heard(0, buoy), 0.5f);
  const RegionHandle close = watcher.ambassador.create_region();
  watcher.ambassador.set_region(close, {90.0, 40.0, 100.0, 56.0});
  watcher.ambassador.commit_region_modifications(close);
  watcher.ambassador.subscribe_object_class_attributes(ferry, {speed, destination}, close);
  sea.round();
  EXPECT_EQ(sea.heard(0, buoy), 1.0f);
  say(2.0f);
  EXPECT_EQ(sea.heard(0, buoy), 1.0f);
  const RegionHandle other = sea.pilot.ambassador.create_region();
  sea.pilot.ambassador.set_region(other, {94.0, 50.0, 94.0, 50.0});
  sea.pilot.ambassador.commit_region_modifications(other);
  sea.pilot.ambassador.associate_regions_for_updates(buoy.object, other);
  sea.round(), sea.round();
  EXPECT_EQ(sea.heard(0, buoy), 2.0f);
}

TEST(HeldUpdates, OfAnObjectThatJoinsAnothersRegionAreToldByItsBounds) {
  BuoyedSea sea("region with vfc(at=0 matches=3)");
  sea.add_buoy(95.0, 50.0), sea.add_buoy(96.0, 50.0);
  sea.add_watcher({0.0, 0.0, 100.0, 100.0});
  sea.rig.settle();
  sea.say(sea.buoys[0], 1.0f);
  sea.round();
  sea.pilot.ambassador.associate_regions_for_updates(sea.buoys[0].object, sea.buoys[1].region);
  for (int match = 0; match < 6; ++match) sea.round();
  EXPECT_EQ(sea.heard(0, sea.buoys[0]), 1.0f);
}

TEST(HeldUpdates, KeepEverybodyWithinTheirBoundsWhateverHappens) {
  for (unsigned seed = 1; seed <= 4; ++seed) wander("region with vfc(at=0 matches=4)", seed, 5);
  for (unsigned seed = 1; seed <= 4; ++seed)
    wander("region with dyconits(cell_size=20 matches=2)", seed, 11);
  for (unsigned seed = 1; seed <= 4; ++seed)
    wander("region with vfc(at=0.3 matches=4) with priority(budget=60)", seed, 0);
}

/// A message in the order of time that names an object not announced yet is sent between two turns,
/// without the updates of the others: what is due of these waits for the turn.
TEST(HeldUpdates, ThatAreDueOutliveAFlushBetweenTwoTurns) {
  constexpr std::uint32_t matches = 8;
  for (int first = 1; first < static_cast<int>(matches) - 2; ++first) {
    BuoyedSea sea("region with vfc(at=0 distance=5)");
    sea.add_buoy(30.0, 50.0);
    Station& watcher = sea.add_watcher({0.0, 0.0, 100.0, 100.0});
    sea.pilot.ambassador.enable_time_regulation(1.0);
    watcher.ambassador.enable_time_constrained();
    watcher.ambassador.enable_asynchronous_delivery();
    sea.rig.settle();
    sea.rig.execution().set_update_rate(watcher.ambassador.federate(), {1, matches});
    const auto updates = [&] { return sea.known(0, sea.buoys[0]).updates; };
    sea.say(sea.buoys[0], 1.0f);
    for (int before = updates(); updates() == before;) {  // to a turn
      sea.move(sea.buoys[0], sea.buoys[0].x < 40.0 ? 50.0 : 30.0, 50.0);
      sea.say(sea.buoys[0], 2.0f);
      sea.round();
    }
    for (int match = 1; match < first; ++match) sea.round();
    sea.move(sea.buoys[0], sea.buoys[0].x < 40.0 ? 50.0 : 30.0, 50.0);
    sea.say(sea.buoys[0], 3.0f);
    sea.round();  // due, and not told yet
    Buoy& newcomer = sea.add_buoy(70.0, 50.0);
    sea.pilot.ambassador.update_attribute_values(newcomer.object, AttributeSet{destination},
                                                 varying("Calais"), LogicalTime{1.0});
    sea.pilot.ambassador.time_advance_request(LogicalTime{2.0});
    watcher.ambassador.time_advance_request(LogicalTime{1.0});
    sea.round(), sea.round();
    for (std::uint32_t match = 0; match < 2 * matches; ++match) sea.round();
    EXPECT_EQ(sea.heard(0, sea.buoys[0]), 3.0f) << "due at match " << first << " after a turn";
    EXPECT_EQ(watcher.heard.lost, "");
  }
}

}  // namespace
}  // namespace rink::rti::testing
