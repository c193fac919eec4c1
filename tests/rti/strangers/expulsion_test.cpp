// Whoever is dropped is dropped at once, whatever the rule it broke, and its last message says why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rti/wire/declaration_messages.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/message.h"
#include "tests/rti/bare.h"

namespace rink::rti::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<std::byte> empty_frame = in_frame({});

/// A federate on connection 1 of a bare execution, which speaks through its ambassador and, at
/// times, past it.
struct Offender {
  Bare& bare;
  Recorder heard{};
  Ambassador ambassador{harbour(), heard};

  explicit Offender(Bare& execution) : bare(execution) {
    bare.execution.connect(1);
    ambassador.join("rink", "offender", "tester");
    bare.execution.receive(1, ambassador.outgoing());
    ambassador.clear_outgoing();
    hear();
  }
  void hear() {
    bare.tick();
    ambassador.receive(bare.sent[1]);
    bare.sent[1].clear();
  }
};

TEST(Expulsion, AFrameWithoutAMessageEndsTheConnectionOfAStranger) {
  Bare bare;
  bare.execution.connect(1);
  bare.execution.receive(1, empty_frame);
  EXPECT_EQ(bare.drops(Violation::malformed), 1u);
  const std::uint64_t heard = bare.execution.counters().bytes_received;
  bare.execution.receive(1, std::vector<std::byte>(1'000'000));
  EXPECT_EQ(bare.execution.counters().bytes_received, heard) << "nothing more is taken from it";
  bare.tick();
  EXPECT_EQ(bare.dropped.count(1), 1u);
  EXPECT_THAT(bare.sent[1], IsEmpty()) << "a stranger who breaks a rule gets no answer";
}

TEST(Expulsion, AFrameWithoutAMessageEndsTheConnectionOfAFederate) {
  Bare bare;
  Offender offender(bare);
  ASSERT_TRUE(offender.ambassador.is_joined());
  bare.execution.receive(1, empty_frame);
  bare.tick();
  EXPECT_EQ(bare.dropped.count(1), 1u);
  EXPECT_EQ(bare.execution.federate_count(), 1u);
  EXPECT_THAT(bare.witness_heard.log, ::testing::Contains("offender misbehaved"));
}

TEST(Expulsion, AnEmptyFrameAfterOtherMessagesOfOneReadEndsTheConnectionToo) {
  Bare bare;
  Offender offender(bare);
  std::vector<std::byte> said = frame_of(HeartbeatMessage{});
  said.insert(said.end(), empty_frame.begin(), empty_frame.end());
  const std::vector<std::byte> more = frame_of(HeartbeatMessage{});
  said.insert(said.end(), more.begin(), more.end());
  for (const std::byte each : said) bare.execution.receive(1, {&each, 1});
  bare.tick();
  EXPECT_EQ(bare.dropped.count(1), 1u) << "however the stream is cut";
}

struct Offence {
  const char* name;
  std::vector<std::byte> said;
  const char* why;
};

std::vector<Offence> offences() {
  std::vector<std::byte> oversized(frame_head_max, std::byte{255});
  return {{"EmptyFrame", empty_frame, "without a message"},
          {"OversizedFrame", oversized, "longer than allowed"},
          {"EmptyFrameOfTheOlderForm", std::vector<std::byte>(4), "without a message"},
          {"FrameOfTheOlderForm", framed(HeartbeatMessage{}), "no message"},
          {"KindOfZero", in_frame(values_of(std::uint16_t{0x100})), "no message"},
          {"UnknownKind", in_frame(std::vector<std::byte>{std::byte{250}}), "no message"},
          {"SecondJoin", frame_of(join_of("again")), "a second time"},
          {"UnknownClass", frame_of(PublishObjectClassMessage{99, 1}), "does not exist"},
          {"UnpublishedClass", frame_of(RegisterObjectMessage{object_block, vessel_number, ""}),
           "had not published"},
          {"ForeignObject", frame_of(DeleteObjectMessage{0}), "another federate owns"}};
}

class ExpulsionFor : public ::testing::TestWithParam<Offence> {};

TEST_P(ExpulsionFor, IsExplainedToTheFederateInItsLastMessage) {
  Bare bare;
  ASSERT_EQ(bare.witness.register_object_instance(vessel).value, 0u);
  bare.tick();
  Offender offender(bare);
  bare.execution.receive(1, GetParam().said);
  offender.hear();
  EXPECT_THAT(offender.heard.lost, HasSubstr(GetParam().why));
  const std::string why = offender.heard.lost;
  offender.ambassador.disconnected("closed by peer");
  EXPECT_EQ(offender.heard.lost, why) << "the loss is reported once, with its reason";
}

INSTANTIATE_TEST_SUITE_P(Of, ExpulsionFor, ::testing::ValuesIn(offences()),
                         [](const auto& offence) { return std::string(offence.param.name); });

TEST(Expulsion, ForSilenceIsExplainedToo) {
  Bare bare;
  Offender offender(bare);
  bare.pass(4.0);
  bare.pass(8.0);
  bare.pass(12.0);
  offender.hear();
  EXPECT_THAT(offender.heard.lost, HasSubstr("silent for too long"));
}

class ExpulsionOver : public ::testing::TestWithParam<Carrier> {};

TEST_P(ExpulsionOver, ReachesTheFederateBeforeItsConnectionCloses) {
  Rig rig(GetParam());
  Station& station = rig.join("offender");
  ASSERT_TRUE(station.ambassador.is_joined());
  const Bytes bytes = empty_frame;
  rig.client_transport().send(station.link->connection(), std::span(&bytes, 1));
  rig.settle();
  EXPECT_TRUE(station.link->is_finished());
  EXPECT_THAT(station.heard.lost, HasSubstr("a frame without a message"));
}

INSTANTIATE_TEST_SUITE_P(Each, ExpulsionOver,
                         ::testing::Values(Carrier::in_process, Carrier::tcp,
                                           Carrier::virtual_network),
                         [](const auto& carrier) { return name_of(carrier.param); });

TEST(Expulsion, FederatesOfVersion8WhichKnowsNoHostMessagesAreRefused) {
  Bare bare;
  bare.execution.connect(1);
  JoinMessage join = join_of("old");
  join.version = 8;
  std::vector<std::byte> frame = frame_of(join);
  bare.execution.receive(1, frame);
  bare.tick();
  Recorder heard;
  Ambassador old(harbour(), heard);
  old.join("rink", "old", "tester");
  EXPECT_TRUE(old.receive(bare.sent[1]));
  EXPECT_EQ(heard.refusal, Refusal::wrong_version);
}

/// Neither side takes its own stall for the other's silence, and both notice who is really silent.
TEST(Expulsion, AStallIsNotTheOthersSilence) {
  Recorder heard;
  Ambassador stalled(harbour(), heard);
  stalled.join("rink", "stalled", "tester");
  stalled.advance_clock(100.0);
  stalled.advance_clock(130.0);
  EXPECT_EQ(heard.lost, "");
  stalled.advance_clock(130.25);
  EXPECT_NE(heard.lost, "");

  Bare bare;
  bare.enter(1, "talker");
  bare.enter(2, "sleeper");
  bare.execution.advance_clock(1.0);
  bare.execution.advance_clock(31.0);
  EXPECT_EQ(bare.execution.federate_count(), 3u);
  for (const ConnectionId each : {0u, 1u})
    bare.execution.receive(each, frame_of(HeartbeatMessage{}));
  bare.execution.advance_clock(31.25);
  EXPECT_EQ(bare.execution.federate_count(), 2u);
  EXPECT_EQ(bare.drops(Violation::silent), 1u);
}

/// A process with more to read than it manages has not heard all that was said.
TEST(Expulsion, WhatWaitsUnreadIsNotSilenceForAWhile) {
  Recorder heard, flooded_heard;
  Ambassador busy(harbour(), heard), flooded(harbour(), flooded_heard);
  busy.join("rink", "busy", "tester"), flooded.join("rink", "flooded", "tester");
  for (double now = 100.0; now < 118.0; now += 0.25) busy.advance_clock(now, true);
  EXPECT_EQ(heard.lost, "");
  for (double now = 118.0; now < 123.5; now += 0.25) busy.advance_clock(now);
  EXPECT_NE(heard.lost, "") << "who has read all knows";
  for (double now = 100.0; now < 124.0; now += 0.25) flooded.advance_clock(now, true);
  EXPECT_EQ(flooded_heard.lost, "");
  for (double now = 124.0; now < 127.0; now += 0.25) flooded.advance_clock(now, true);
  EXPECT_NE(flooded_heard.lost, "") << "others that send without pause are no excuse for ever";

  Bare bare, besieged;
  bare.enter(1, "unread"), besieged.enter(1, "mute");
  bare.execution.advance_clock(1.0), besieged.execution.advance_clock(1.0);
  for (double now = 2.0; now < 18.0; now += 1.0) bare.execution.advance_clock(now, true);
  EXPECT_EQ(bare.execution.federate_count(), 2u);
  for (double now = 18.0; now < 25.0; now += 1.0) bare.execution.advance_clock(now);
  EXPECT_EQ(bare.execution.federate_count(), 0u);
  for (double now = 2.0; now < 24.0; now += 1.0) besieged.execution.advance_clock(now, true);
  EXPECT_EQ(besieged.execution.federate_count(), 2u);
  for (double now = 24.0; now < 30.0; now += 1.0) besieged.execution.advance_clock(now, true);
  EXPECT_EQ(besieged.execution.federate_count(), 0u);
}

}  // namespace
}  // namespace rink::rti::testing
