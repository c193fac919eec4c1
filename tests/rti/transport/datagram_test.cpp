// Best-effort updates by datagrams that are lost, doubled, late and early: who hears of an object
// knows its newest state in the end, and never goes back.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "rti/wire/datagram.h"
#include "tests/rti/rig.h"
#include "tests/rti/scenes/stormy_sea.h"
#include "tests/rti/scenes/strait.h"

namespace rink::rti::testing {
namespace {

using namespace over_the_strait;

TEST(Datagrams, BestEffortUpdatesTakeThemAndReliableOnesDoNot) {
  StormySea sea(1);
  const ObjectHandle object = sea.place_buoy();
  sea.update(object, number | height | heading);
  sea.rounds(5);
  sea.expect_truth();
  const int before = sea.far().sent;
  sea.update(object, number);
  sea.rounds(1);
  EXPECT_EQ(sea.far().sent, before);
  sea.update(object, height);
  sea.rounds(1);
  EXPECT_EQ(sea.far().sent, before + 2) << "one for each watcher";
  sea.update(object, number | heading);
  sea.rounds(1);
  EXPECT_EQ(sea.far().sent, before + 4) << "an update of both kinds is told apart";
  sea.rounds(3);
  sea.expect_truth();
  EXPECT_EQ(sea.counters().updates_repaired, 0u);
}

TEST(Datagrams, CostNothingWhereNothingIsBestEffort) {
  Rig rig(Carrier::in_process);
  Station& pilot = rig.join("pilot");
  Station& coast = rig.join("coast");
  pilot.ambassador.publish_object_class_attributes(vessel, AttributeSet{position, speed});
  coast.ambassador.subscribe_object_class_attributes(vessel, AttributeSet{position, speed});
  const ObjectHandle object = pilot.ambassador.register_object_instance(vessel);
  pilot.ambassador.update_attribute_values(object, AttributeSet{position, speed},
                                           values_of(1.0f, 2.0f, 3.0f), {});
  rig.settle();
  EXPECT_EQ(rig.execution().counters().datagrams_sent, 0u);
  EXPECT_EQ(coast.ambassador.counters().datagrams_received, 0u);
  EXPECT_EQ(coast.heard.objects[object.value].updates, 1);
}

TEST(Datagrams, AreAcknowledgedTenTimesASecondWhereNoneIsMissing) {
  StormySea sea(8, 1);
  const ObjectHandle object = sea.place_buoy();
  sea.update(object, height);
  sea.rounds(10);
  const int before = sea.clients().sent;
  const std::uint64_t frames_before = sea.counters().frames_sent;
  for (int tick = 0; tick < 180; ++tick) {
    sea.update(object, height);
    sea.round();
  }
  EXPECT_GE(sea.clients().sent - before, 3 * 8);
  EXPECT_LE(sea.clients().sent - before, 3 * 10 + 1);
  EXPECT_LE(sea.counters().frames_sent - frames_before, 4u)
      << "and who hears of us by datagrams needs no heartbeats";
  sea.expect_truth();
}

TEST(Datagrams, ManyObjectsAreCutIntoDatagramsOfTheAllowedSize) {
  StormySea sea(2);
  for (int i = 0; i < 500; ++i) sea.place_buoy();
  sea.rounds(3);
  for (int tick = 0; tick < 3; ++tick) {
    for (const ObjectHandle object : sea.buoys) sea.update(object, height);
    sea.rounds(1);
  }
  sea.rounds(5);
  sea.expect_truth();
  EXPECT_GE(sea.counters().datagrams_sent, 3u * 2u * (500u * 10u / 1191u));
}

TEST(Datagrams, ALostFinalStateIsRepaired) {
  StormySea sea(3, 1);
  const ObjectHandle object = sea.place_buoy();
  sea.update(object, height | heading);
  sea.rounds(5);
  sea.weather.is_blocked = true;
  sea.update(object, height);
  sea.update(object, heading);
  sea.rounds(1);
  sea.weather.is_blocked = false;
  sea.rounds(2);
  EXPECT_NE(sea.watchers[0].known[object.value].height, sea.truth[object.value].height);
  sea.rounds(30);
  sea.expect_truth();
  EXPECT_GE(sea.counters().updates_repaired, 1u);
}

TEST(Datagrams, StormsChangeNothingInTheEnd) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    StormySea sea(seed, 3);
    sea.weather = {.loss = 0.3,
                   .doubling = 0.2,
                   .delay = 0.5,
                   .is_blocked = false,
                   .size_max = seed % 2 == 0 ? 1191u : 300u};
    std::mt19937 random(seed);
    for (int tick = 0; tick < 200; ++tick) {
      if (tick < 40 && tick % 2 == 0) sea.place_buoy();
      for (const ObjectHandle object : sea.buoys) {
        const unsigned choice = random() % 8;
        if (choice < 3)
          sea.update(object, choice == 0 ? height : choice == 1 ? heading : height | heading);
        if (choice == 3 && tick % 10 == 0) sea.update(object, number | height);
      }
      // Watchers look away and come back, which brings the whole state by the stream, ahead of
      // datagrams that are still on their way.
      if (tick % 7 == 3) {
        BuoyWatcher& watcher = sea.watchers[random() % 3];
        watcher.ambassador.unsubscribe_object_class(buoy);
        sea.round();
        watcher.ambassador.subscribe_object_class_attributes(buoy, number | height | heading);
      }
      sea.round();
    }
    sea.weather = {};
    sea.rounds(150);
    sea.expect_truth();
    EXPECT_GT(sea.counters().updates_repaired, 0u);
    EXPECT_EQ(sea.counters().datagram_fallbacks, 0u);
  }
}

TEST(Datagrams, AWayThatLosesEverythingFallsBackToTheStreamAndOpensAgain) {
  StormySea sea(5);
  const ObjectHandle object = sea.place_buoy();
  sea.update(object, height | heading);
  sea.rounds(5);
  sea.weather.is_blocked = true;
  for (int tick = 0; tick < 180; ++tick) {
    sea.update(object, height);
    sea.round();
  }
  EXPECT_EQ(sea.counters().datagram_fallbacks, 2u) << "one for each watcher";
  sea.rounds(2);
  sea.expect_truth();
  sea.weather.is_blocked = false;
  sea.rounds(100);
  EXPECT_EQ(sea.counters().datagram_recoveries, 2u);
  const int before = sea.far().sent;
  sea.update(object, height);
  sea.rounds(2);
  EXPECT_GE(sea.far().sent, before + 2);
  sea.expect_truth();
}

TEST(Datagrams, NonsenseIsIgnoredAndCounted) {
  StormySea sea(6, 1);
  const ObjectHandle object = sea.place_buoy();
  sea.update(object, height);
  sea.rounds(5);
  std::mt19937 random(6);
  BuoyWatcher& watcher = sea.watchers[0];
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::byte> bytes(random() % 60);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() % (i % 2 == 0 ? 256 : 64));
    if (bytes.size() >= 8 && i % 3 != 0) {
      // A plausible number, or receipts of all later ones would be spoilt, as a stranger without
      // the key cannot.
      std::fill(bytes.begin(), bytes.begin() + 8, std::byte{0});
    }
    if (i % 3 != 0) watcher.ambassador.receive_datagram(bytes);
    sea.execution().receive_datagram(1, bytes);
    sea.execution().receive_datagram(77, bytes);
  }
  EXPECT_GT(watcher.ambassador.counters().datagrams_ignored, 100u);
  EXPECT_GT(sea.counters().datagrams_ignored, 100u);
  sea.update(object, height);
  sea.rounds(60);
  sea.expect_truth();
  EXPECT_EQ(sea.execution().federate_count(), 2u);
}

TEST(DatagramReceipts, TellOfTheLastSixtyFourAsASetWould) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    DatagramReceipts receipts;
    std::set<std::uint32_t> arrived;
    std::uint32_t front = 1;
    for (int i = 0; i < 500; ++i) {
      const auto back = static_cast<std::uint32_t>(random() % 80),
                 number = front > back ? front - back : 1;
      if (random() % 3 == 0)
        front += 1 + static_cast<std::uint32_t>(random() % (seed % 5 == 0 ? 100 : 3));
      const std::uint32_t newest = arrived.empty() ? 0 : *arrived.rbegin();
      const bool is_new = !arrived.contains(number) && (number > newest || newest - number <= 64);
      EXPECT_EQ(receipts.note(number), is_new) << number << " after " << newest;
      if (is_new) arrived.insert(number);
      const AcknowledgeDatagramsMessage told = receipts.acknowledge();
      for (std::uint32_t age = 0; age <= 64 && age < told.newest; ++age)
        EXPECT_EQ(told.has(told.newest - age), arrived.contains(told.newest - age));
    }
  }
}

}  // namespace
}  // namespace rink::rti::testing
