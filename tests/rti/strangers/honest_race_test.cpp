// What crosses a deletion on its way: it does nothing, is counted, and costs nobody a connection.
#include <gtest/gtest.h>

#include "rti/wire/time_messages.h"
#include "rti/wire/update_block.h"
#include "tests/rti/time/timed_federation.h"

namespace rink::rti {
namespace {

using namespace testing;

/// A federate with one vessel, and one that sees it.
struct Race {
  TimedFederation federation;
  TimedFederate& owner = federation.join_timed(1.0, false);
  TimedFederate& watcher = federation.join_timed(-1.0);
  ObjectHandle object;
  std::uint64_t number = 0;

  Race() {
    owner.ambassador.publish_object_class_attributes(vessel, motion);
    watcher.ambassador.subscribe_object_class_attributes(vessel, motion);
    object = owner.ambassador.register_object_instance(vessel);
    owner.ambassador.update_attribute_values(object, motion, values_of(1.0f, 2.0f, 3.0f), Stamp{});
    federation.carry();
  }
  /// As bytes, for an ambassador would know better.
  template <class Message>
  void say(Message message) {
    FrameWriter frame(frame_max_to_rti);
    write(frame.begin_message(measure(message)), message);
    frame.appended();
    federation.execution().receive(owner.connection, frame.bytes());
  }
  void say_timed(double time, const std::vector<std::byte>& content) {
    TimedSendMessage message;
    message.number = number++;
    message.stamp.time = time;
    message.content = content;
    say(message);
  }
  std::vector<std::byte> update_of(std::uint32_t handle) {
    std::vector<std::byte> content;
    UpdatesMessage header{static_cast<std::uint16_t>(vessel.value), motion.bits};
    write(content, header);
    RecordWriter(content).add(handle, values_of(4.0f, 5.0f, 6.0f));
    return content;
  }
  std::vector<std::byte> deletion_of(std::uint32_t handle) {
    std::vector<std::byte> content;
    DeleteObjectMessage deletion{handle};
    write(content, deletion);
    return content;
  }
  std::size_t removals() const { return watcher.times(TimedFederate::Heard::What::removal).size(); }
  void expect_nobody_was_dropped(std::uint64_t late) {
    federation.carry();
    owner.ambassador.time_advance_request(LogicalTime(50.0));
    watcher.ambassador.time_advance_request(LogicalTime(50.0));
    federation.carry();
    EXPECT_EQ(removals(), 1u);
    EXPECT_EQ(federation.execution().object_count(), 0u);
    EXPECT_EQ(federation.execution().federate_count(), 2u);
    EXPECT_EQ(federation.execution().counters().late_requests, late);
    EXPECT_EQ(watcher.lost + owner.lost, "");
    EXPECT_EQ(watcher.grants(), std::vector{50.0});
  }
};

TEST(HonestRace, ASecondDeletionFindsNothingToDelete) {
  Race race;
  race.say(DeleteObjectMessage{race.object.value});
  race.say(DeleteObjectMessage{race.object.value});
  race.federation.carry();
  race.say(DeleteObjectMessage{race.object.value});
  race.expect_nobody_was_dropped(2);
}

TEST(HonestRace, WhatIsSaidInTimeStampOrderOfAnObjectThatIsGoneIsToldToNobody) {
  Race race;
  race.say(DeleteObjectMessage{race.object.value});
  race.say_timed(10.0, race.update_of(race.object.value));
  race.say_timed(11.0, race.deletion_of(race.object.value));
  race.federation.carry();
  race.say_timed(12.0, race.update_of(race.object.value));
  race.expect_nobody_was_dropped(3);
  EXPECT_EQ(race.watcher.times(TimedFederate::Heard::What::message).size(), 0u);
}

TEST(HonestRace, TheSecondOfTwoTimedDeletionsHasNoPartInTheFirst) {
  Race race;
  race.say_timed(10.0, race.deletion_of(race.object.value));
  race.say_timed(20.0, race.deletion_of(race.object.value));
  race.federation.carry();
  race.say(RetractMessage{1});
  race.expect_nobody_was_dropped(1);
  EXPECT_EQ(race.watcher.times(TimedFederate::Heard::What::removal), std::vector{10.0})
      << "taking the second back does not undo the first";
}

TEST(HonestRace, AnObjectThatNeverWasIsStillACrime) {
  for (int timed = 0; timed < 3; ++timed) {
    Race race;
    const std::uint32_t never = race.object.value + 1;
    if (timed == 0) race.say(DeleteObjectMessage{never});
    else race.say_timed(10.0, timed == 1 ? race.update_of(never) : race.deletion_of(never));
    race.federation.carry();
    EXPECT_EQ(race.federation.drops(Violation::unknown_name), 1u) << timed;
    EXPECT_EQ(race.federation.execution().federate_count(), 1u);
  }
}

}  // namespace
}  // namespace rink::rti
