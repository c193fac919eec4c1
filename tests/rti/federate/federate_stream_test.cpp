// What a federate writes to its stream, and how it waits, each part by itself.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "rti/federate/delivery/callback_gate.h"
#include "rti/federate/delivery/frame_outbox.h"
#include "rti/federate/delivery/link_watch.h"
#include "rti/federate/delivery/postponed_messages.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/update_block.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

TEST(FrameOutbox, SharesAStampAndAHeaderAmongUpdatesThatFollowEachOther) {
  JoinPhase phase;
  FrameOutbox frames(phase);
  phase.begin_joining();
  const UpdateHeader header{vessel, AttributeSet{speed}, {2.0, 1}};
  const std::vector<std::byte> value = values_of(3.0f);
  EXPECT_TRUE(frames.enqueue_update(header, {5}, value));
  const std::size_t first = frames.bytes().size();
  EXPECT_FALSE(frames.enqueue_update(header, {6}, value));
  EXPECT_EQ(frames.bytes().size(), first + 1 + value.size()) << "a step to the handle, and values";
  EXPECT_TRUE(frames.enqueue_update({ferry, AttributeSet{speed}, {2.0, 1}}, {7}, value));
  const std::size_t third = frames.bytes().size();
  frames.close_frame();
  EXPECT_TRUE(frames.enqueue_update(header, {8}, value)) << "a block stands in one frame";
  EXPECT_EQ(frames.bytes().size(), third + first) << "a stamp is good for its frame";
  EXPECT_EQ(frames.frame_count(), 2u);
}

TEST(FrameOutbox, RefusesStrangersAndThoseWhoHaveLeft) {
  JoinPhase phase;
  FrameOutbox frames(phase);
  const auto error = [&] {
    try {
      frames.enqueue(HeartbeatMessage{});
    } catch (const RtiException& refused) {
      return refused.error();
    }
    return HlaError::none;
  };
  EXPECT_EQ(error(), HlaError::federate_not_execution_member);
  phase.begin_joining();
  EXPECT_EQ(error(), HlaError::none);
  phase.end();
  EXPECT_EQ(error(), HlaError::federate_not_execution_member);
}

TEST(LinkWatch, WaitsForASilentRtiAndBeatsWhenIdle) {
  LinkWatch watch(Timeouts{1.0, 5.0});
  watch.advance(100.0, false, false);
  EXPECT_FALSE(watch.is_rti_lost()) << "the clock starts where it is first set";
  watch.advance(101.0, false, false);
  EXPECT_TRUE(watch.is_heartbeat_due());
  watch.beat();
  EXPECT_FALSE(watch.is_heartbeat_due());
  watch.received();
  watch.advance(104.0, true, false);
  EXPECT_FALSE(watch.is_heartbeat_due()) << "something waits to go out";
  watch.advance(109.0, false, false);
  EXPECT_FALSE(watch.is_rti_lost()) << "5 s since it was heard";
  watch.advance(109.5, false, false);
  EXPECT_TRUE(watch.is_rti_lost());
}

TEST(CallbackGate, HoldsWhatComesWhileItIsClosedAndGivesItOnce) {
  FederateAmbassador deaf;
  CallbackGate gate(deaf, CallbackModel::immediate);
  EXPECT_EQ(&gate.callbacks(), &deaf);
  gate.disable();
  EXPECT_FALSE(gate.is_open());
  EXPECT_TRUE(gate.hold(bytes_of("first ")));
  EXPECT_TRUE(gate.hold(bytes_of("second")));
  gate.hold_loss("gone");
  gate.enable();
  EXPECT_EQ(text_of(gate.take_held()), "first second");
  EXPECT_EQ(gate.take_held_loss(), "gone");
  EXPECT_TRUE(gate.take_held().empty());
  CallbackGate evoked(deaf, CallbackModel::evoked);
  evoked.disable();
  EXPECT_TRUE(evoked.is_open()) << "what is read waits in the queue";
}

TEST(PostponedMessages, KeepAnUpdateWithTheStampItWasReadUnder) {
  std::vector<std::byte> body, whole;
  UpdatesMessage updates{static_cast<std::uint16_t>(vessel.value), AttributeSet{speed}.bits};
  write(body, updates);
  write_handle(body, 0, 5);
  for (const std::byte each : values_of(3.0f)) body.push_back(each);
  body.push_back(std::byte{0});
  PostponedMessages postponed(harbour());
  const auto keep = [&](const ReadContext& context) {
    Reader reader(body);
    std::uint8_t kind = 0;
    reader.number(kind);
    return postponed.keep(reader, static_cast<MessageKind>(kind), context);
  };
  EXPECT_FALSE(keep({})) << "without a stamp";
  EXPECT_TRUE(postponed.is_empty());
  EXPECT_TRUE(keep({Stamp{2.0, 1}, nullptr}));
  StampMessage stamp{{2.0, 1}};
  write(whole, stamp);
  whole.insert(whole.end(), body.begin(), body.end());
  EXPECT_EQ(postponed.take(), whole);
  EXPECT_TRUE(postponed.is_empty());
  body.pop_back();  // a block without an end makes no sense
  EXPECT_FALSE(keep({Stamp{2.0, 1}, nullptr}));
  EXPECT_TRUE(postponed.is_empty());
}

}  // namespace
}  // namespace rink::rti::testing
