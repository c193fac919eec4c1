// A federate's own best-effort updates by datagram: lost ones are repaired, old ones change
// nothing, and nothing that goes by the stream is overtaken.
#include <gtest/gtest.h>

#include <random>

#include "tests/rti/scenes/strait.h"

namespace rink::rti::testing {
namespace {

using namespace over_the_strait;

void say_and_hear(Strait& scene, ObjectHandle object, double value) {
  scene.set(object, value);
  scene.tick();
  EXPECT_EQ(scene.seen(object), value);
}

TEST(UpwardDatagrams, CarryBestEffortUpdatesAndNothingElse) {
  Strait scene;
  const ObjectHandle object = scene.place();
  scene.ticks(3);
  const std::uint64_t frames = scene.publisher.counters().frames_sent,
                      received = scene.counters().datagrams_received;
  for (int i = 1; i <= 10; ++i) say_and_hear(scene, object, i);
  EXPECT_EQ(scene.publisher.counters().frames_sent, frames) << "not by the stream";
  EXPECT_EQ(scene.counters().datagrams_received - received, 10u);
  scene.publisher.update_attribute_values(object, number | height | heading,
                                          values_of(std::int32_t{7}, 11.0, 3.0f), {scene.now, 0});
  scene.tick();
  EXPECT_EQ(scene.publisher.counters().frames_sent, frames + 1) << "the reliable part";
  EXPECT_EQ(scene.counters().datagrams_received - received, 11u);
  EXPECT_EQ(scene.seen(object), 11.0);
  EXPECT_EQ(scene.heard[1].known[object.value].heading, 3.0f);
  EXPECT_EQ(scene.counters().updates_outdated, 0u);
  EXPECT_EQ(scene.heard[1].went_back, 0);
}

TEST(UpwardDatagrams, ManyUpdatesAreCutToTheAllowedSize) {
  Strait scene;
  std::vector<ObjectHandle> objects;
  for (int i = 0; i < 200; ++i) objects.push_back(scene.place());
  scene.ticks(3);
  scene.delivers = false;
  for (const ObjectHandle each : objects) scene.set(each, 5.0);
  scene.tick();
  EXPECT_GT(scene.up.size(), 4u);
  for (const auto& each : scene.up) EXPECT_LE(each.size(), scene.size_max);
  scene.delivers = true;
  scene.tick();
  for (const ObjectHandle each : objects) EXPECT_EQ(scene.seen(each), 5.0);
}

TEST(UpwardDatagrams, ALostFinalStateIsRepaired) {
  Strait scene;
  const ObjectHandle object = scene.place();
  scene.ticks(3);
  for (int i = 1; i < 5; ++i) scene.set(object, i), scene.tick();
  scene.delivers = false;
  scene.set(object, 5.0);
  scene.tick();
  ASSERT_EQ(scene.up.size(), 1u);
  scene.up.clear();
  scene.delivers = true;
  scene.tick();
  EXPECT_EQ(scene.seen(object), 4.0);
  scene.ticks(20);
  EXPECT_EQ(scene.seen(object), 5.0);
  EXPECT_EQ(scene.publisher.counters().updates_repaired, 1u);
  EXPECT_EQ(scene.publisher.counters().datagram_fallbacks, 0u);
  const std::uint64_t sent = scene.publisher.counters().datagrams_sent;
  scene.ticks(40);
  EXPECT_EQ(scene.publisher.counters().datagrams_sent, sent)
      << "once it has arrived, it is not said again";
}

TEST(UpwardDatagrams, AnOldOneChangesNothingAndADoubledOneCountsOnce) {
  Strait scene;
  const ObjectHandle object = scene.place(0.5);
  scene.delivers = false;
  for (int i = 1; i <= 2; ++i) scene.set(object, i), scene.tick();
  ASSERT_EQ(scene.up.size(), 2u);
  const std::vector<std::byte> first = scene.up[0], second = scene.up[1];
  scene.execution.receive_datagram(0, second);
  scene.tick();
  EXPECT_EQ(scene.seen(object), 2.0);
  const std::uint64_t reflections = static_cast<std::uint64_t>(scene.heard[1].reflections);
  scene.execution.receive_datagram(0, first);
  scene.execution.receive_datagram(0, second);
  scene.tick();
  EXPECT_EQ(scene.seen(object), 2.0);
  EXPECT_EQ(static_cast<std::uint64_t>(scene.heard[1].reflections), reflections);
  EXPECT_EQ(scene.counters().updates_outdated, 1u);
  EXPECT_EQ(scene.counters().datagrams_ignored, 1u);
}

TEST(UpwardDatagrams, WhatIsMadeReliableIsNotOvertakenByWhatWasSaidBefore) {
  Strait scene;
  const ObjectHandle object = scene.place(1.0);
  scene.delivers = false;
  scene.set(object, 2.0);
  scene.publisher.request_attribute_transportation_type_change(object, height,
                                                               Transportation::reliable);
  scene.set(object, 3.0);  // in the same tick: by the stream
  scene.tick();
  EXPECT_EQ(scene.seen(object), 3.0);
  ASSERT_EQ(scene.up.size(), 1u);
  scene.arrive();
  scene.tick();
  EXPECT_EQ(scene.seen(object), 3.0) << "the datagram was said before";
  EXPECT_EQ(scene.heard[1].went_back, 0);
  scene.delivers = true;
  const std::uint64_t received = scene.counters().datagrams_received;
  for (int i = 4; i < 8; ++i) say_and_hear(scene, object, i);
  EXPECT_EQ(scene.counters().datagrams_received, received) << "reliable from the request on";
  EXPECT_EQ(scene.heard[0].confirmed, 1);
  scene.publisher.request_attribute_transportation_type_change(object, height,
                                                               Transportation::best_effort);
  scene.set(object, 8.0);
  scene.tick();
  EXPECT_EQ(scene.counters().datagrams_received, received) << "not before it is confirmed";
  for (int i = 9; i < 12; ++i) say_and_hear(scene, object, i);
  EXPECT_EQ(scene.counters().datagrams_received, received + 3);
  EXPECT_EQ(scene.heard[1].went_back, 0);
}

TEST(UpwardDatagrams, SentWithinACallbackOfADatagramLeaveItsValuesAsTheyAre) {
  Strait scene;
  scene.listener.publish_object_class_attributes(buoy, number | height | heading);
  scene.publisher.subscribe_object_class_attributes(buoy, height | heading);
  const ObjectHandle own = scene.place(), theirs = scene.listener.register_object_instance(buoy);
  scene.ticks(3);
  scene.set(own, 1.0);
  scene.ticks(2);  // from now on its updates go by datagram
  scene.delivers = false;
  scene.listener.update_attribute_values(theirs, height | heading, values_of(2.5, 10.0f),
                                         {scene.now, 0});
  scene.tick();
  ASSERT_FALSE(scene.down.empty());
  const std::vector<std::byte> older = scene.down.back();
  scene.down.clear();
  scene.listener.update_attribute_values(theirs, heading, values_of(20.0f), {scene.now, 0});
  scene.tick();
  ASSERT_FALSE(scene.down.empty());
  Ear& heard = scene.heard[0];
  scene.publisher.receive_datagram(scene.down.back());
  ASSERT_EQ(heard.known[theirs.value].heading, 20.0f);
  // Of the older datagram only the height is still news; meanwhile the federate sends an update of
  // which a part goes by the stream.
  const int before = heard.reflections;
  heard.meanwhile = [&] {
    scene.publisher.update_attribute_values(own, number | height, values_of(std::int32_t{7}, 99.0),
                                            {scene.now, 0});
  };
  scene.publisher.receive_datagram(older);
  EXPECT_EQ(heard.reflections, before + 1);
  EXPECT_EQ(heard.known[theirs.value].height, 2.5);
  EXPECT_EQ(heard.known[theirs.value].heading, 20.0f);
}

TEST(UpwardDatagrams, WaitForTheFrameThatRegistersTheirObject) {
  Strait scene;
  scene.set(scene.place(), 0.0);
  scene.ticks(3);
  scene.holds_stream = true;
  const ObjectHandle object = scene.place();
  scene.set(object, 7.0);
  scene.tick();
  EXPECT_EQ(scene.seen(object), -2.0);
  scene.holds_stream = false;
  scene.tick(), scene.tick();
  EXPECT_EQ(scene.seen(object), 7.0);
  EXPECT_EQ(scene.publisher.counters().updates_repaired, 0u);
}

TEST(UpwardDatagrams, TheirNewestValueGoesByTheStreamBeforeTheirObjectIsGivenAway) {
  Strait scene;
  const ObjectHandle object = scene.place(1.0);
  scene.delivers = false;
  scene.set(object, 2.0);
  scene.publisher.unconditional_attribute_ownership_divestiture(object, height);
  scene.tick();
  EXPECT_EQ(scene.seen(object), 2.0) << "its datagram never arrived";
  scene.up.clear();
  scene.delivers = true;
  scene.ticks(20);
  EXPECT_EQ(scene.seen(object), 2.0);
  EXPECT_TRUE(scene.heard[0].lost.empty());
}

TEST(UpwardDatagrams, WhatWasKeptBackMeanwhileIsNotMadeCurrentByALateOne) {
  Strait scene;
  const ObjectHandle object = scene.place(1.0);
  scene.delivers = false;
  scene.set(object, 2.0);
  scene.tick();
  scene.listener.unsubscribe_object_class(buoy);
  scene.ticks(2);
  scene.set(object, 3.0);  // nobody hears it: kept back, and the RTI is told that it is out of date
  scene.tick();
  EXPECT_EQ(scene.publisher.counters().updates_spared, 1u);
  scene.arrive();
  scene.tick();
  scene.delivers = true;
  scene.listener.subscribe_object_class_attributes(buoy, height);
  scene.ticks(6);
  EXPECT_EQ(scene.seen(object), 3.0);
  EXPECT_EQ(scene.heard[1].went_back, 0);
}

TEST(UpwardDatagrams, AWayThatLosesEverythingFallsBackToTheStreamAndOpensAgain) {
  Strait scene;
  const ObjectHandle object = scene.place(1.0);
  scene.delivers = false;
  for (int i = 2; i < 90; ++i)
    scene.set(object, i), scene.tick(), scene.up.clear(), scene.down.clear();
  EXPECT_EQ(scene.publisher.counters().datagram_fallbacks, 1u);
  EXPECT_EQ(scene.seen(object), 89.0);
  scene.delivers = true;
  for (int i = 90; i < 130; ++i) scene.set(object, i), scene.tick();
  EXPECT_EQ(scene.publisher.counters().datagram_recoveries, 1u);
  const std::uint64_t frames = scene.publisher.counters().frames_sent;
  for (int i = 130; i < 135; ++i) scene.set(object, i), scene.tick();
  EXPECT_EQ(scene.publisher.counters().frames_sent, frames);
  EXPECT_EQ(scene.seen(object), 134.0);
  EXPECT_EQ(scene.heard[1].went_back, 0);
}

TEST(UpwardDatagrams, AreNotUsedByWhoKeepsTimeOrLeavesObjectsBehind) {
  Strait timed, leaving;
  timed.publisher.enable_time_regulation(1.0);
  leaving.publisher.set_automatic_resign_directive(ResignAction::unconditionally_divest_attributes);
  for (Strait* scene : {&timed, &leaving}) {
    const ObjectHandle object = scene->place();
    scene->ticks(3);
    for (int i = 1; i < 5; ++i) scene->set(object, i), scene->tick();
    EXPECT_EQ(scene->counters().datagrams_received, 0u);
    EXPECT_EQ(scene->seen(object), 4.0);
  }
}

TEST(UpwardDatagrams, NonsenseAndWhatIsNotOnesOwnIsIgnoredAndCostsNobodyTheConnection) {
  Strait scene;
  const ObjectHandle object = scene.place(4.0);
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::byte> noise(random() % 60);
    for (std::byte& each : noise) each = static_cast<std::byte>(random() % 4 == 0 ? random() : 0);
    scene.execution.receive_datagram(static_cast<ConnectionId>(random() % 3), noise);
  }
  std::vector<std::byte> stolen;  // the listener speaks of the publisher's buoy
  DatagramHead head{1u << 20, 0};
  Writer writer(stolen);
  exchange(writer, head);
  StampMessage stamp{{scene.now, 0}};
  write(stolen, stamp);
  UpdatesMessage updates{static_cast<std::uint16_t>(buoy.value), height.bits};
  write(stolen, updates);
  write_handle(stolen, 0, object.value);
  const auto value = values_of(99.0);
  stolen.insert(stolen.end(), value.begin(), value.end());
  stolen.push_back(std::byte{0});
  scene.execution.receive_datagram(1, stolen);
  scene.ticks(3);
  EXPECT_EQ(scene.seen(object), 4.0);
  EXPECT_GT(scene.counters().datagrams_ignored, 400u);
  EXPECT_EQ(scene.execution.federate_count(), 2u);
}

TEST(UpwardDatagrams, CostNothingWhereNothingIsBestEffort) {
  Rig rig(Carrier::in_process);
  Station& pilot = rig.join("pilot");
  const std::size_t memory = pilot.ambassador.memory_bytes();
  const Fom reliable = Fom::parse(
      "<objectModel><objects><objectClass><name>Root</name></objectClass></objects></objectModel>",
      "reliable.xml");
  Recorder heard;
  Ambassador ambassador(reliable, heard);
  ambassador.expect_datagrams(1191);
  EXPECT_TRUE(ambassador.outgoing_datagrams().empty());
  EXPECT_LE(ambassador.memory_bytes(), memory + 4096);
}

/// Datagrams are lost, doubled and late, the stream is late, regions of the class come and go,
/// attributes change their transportation: in the end everybody knows the truth, and nobody ever
/// went back.
TEST(UpwardDatagrams, StormsChangeNothingInTheEnd) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    Strait scene;
    std::vector<std::pair<ObjectHandle, double>> truth;
    std::deque<std::vector<std::byte>> air;
    for (int step = 0; step < 300; ++step) {
      if (truth.size() < 6 && random() % 8 == 0) truth.emplace_back(scene.place(), 0.0);
      for (auto& [object, value] : truth) {
        const auto what = random() % 16;
        if (what < 9) scene.set(object, value += 1.0);
        if (what == 9)
          scene.publisher.update_attribute_values(
              object, number | height, values_of(std::int32_t{step}, value += 1.0), {scene.now, 0});
        if (what == 10)
          scene.publisher.request_attribute_transportation_type_change(object, height,
                                                                       Transportation::reliable);
        if (what == 11)
          scene.publisher.request_attribute_transportation_type_change(object, height,
                                                                       Transportation::best_effort);
      }
      if (random() % 40 == 0) scene.listener.unsubscribe_object_class(buoy);
      if (random() % 20 == 0) scene.listener.subscribe_object_class_attributes(buoy, height);
      scene.delivers = false;
      scene.holds_stream = random() % 5 == 0;
      scene.tick(0.02);
      for (; !scene.up.empty(); scene.up.pop_front()) {
        const auto fate = random() % 10;
        if (fate < 2) continue;
        air.push_back(scene.up.front());
        if (fate == 2) air.push_back(scene.up.front());
      }
      while (!air.empty() && random() % 3 != 0) {
        const std::size_t at = random() % air.size();
        scene.execution.receive_datagram(0, air[at]);
        air.erase(air.begin() + static_cast<std::ptrdiff_t>(at));
      }
      if (random() % 4 != 0) scene.answer();
      else scene.down.clear();
    }
    scene.delivers = true, scene.holds_stream = false;
    scene.listener.subscribe_object_class_attributes(buoy, height);
    scene.ticks(40);
    for (const auto& [object, value] : truth) EXPECT_EQ(scene.seen(object), value) << object.value;
    EXPECT_EQ(scene.heard[1].went_back, 0);
    EXPECT_GT(scene.counters().datagrams_received, 100u);
  }
}

}  // namespace
}  // namespace rink::rti::testing
