// Federates whose clock is off, at their own end and as bytes that break the rules.
#include "rti/wire/time_messages.h"
#include "tests/rti/relaxed_time.h"
#include "tests/rti/timed_federation.h"

namespace rink::rti {
namespace {

using namespace testing;

/// A federate that does not know the rules, or breaks them.
void send_raw(TimedFederation& federation, TimedFederate& federate, auto message) {
  FrameWriter frame(frame_max_to_rti);
  write(frame.begin_message(measure(message)), message);
  frame.appended();
  federation.execution().receive(federate.connection, frame.bytes());
  federation.carry();
}

TEST(BadClock, AClockAnHourOffIsRefusedAtBothEnds) {
  TimedFederation federation{relaxed()};
  TimedFederate& federate = federation.join_timed(1.0, false);
  TimedFederate& other = federation.join_timed(-1.0);
  federate.ambassador.time_advance_request(LogicalTime(7200.0));
  federation.carry();
  EXPECT_EQ(error_of([&] { TimedFederation::say(federate, 3600.0); }), "InvalidLogicalTime");
  EXPECT_EQ(error_of([&] { federate.ambassador.time_advance_request(LogicalTime(3600.0)); }), "LogicalTimeAlreadyPassed");
  std::vector<std::byte> content;
  InteractionMessage words{static_cast<std::uint16_t>(hail.value), FederateHandle::none, {}, {}};
  write(content, words);
  TimedSendMessage message;
  message.stamp.time = 3600.0;
  message.content = content;
  send_raw(federation, federate, message);
  EXPECT_EQ(federation.drops(Violation::untimely), 1u);
  other.ambassador.time_advance_request(LogicalTime(1.0));
  federation.carry();
  EXPECT_EQ(other.grants(), std::vector{1.0}) << "the federation goes on";
}

TEST(BadClock, ARequestThatItsTimeForbidsCostsTheConnection) {
  TimedFederation federation{relaxed()};
  const AdvanceRequestMessage back{static_cast<std::uint8_t>(AdvanceKind::time_advance), 1.0};
  TimedFederate& federate = federation.join_timed(1.0, false);
  federate.ambassador.time_advance_request(LogicalTime(2.0));
  federation.carry();
  send_raw(federation, federate, back);
  EXPECT_EQ(federation.drops(Violation::untimely), 1u);
  TimedFederate& second = federation.join_timed(1.0, false);
  send_raw(federation, second, EnableTimeRegulationMessage{1.0});
  EXPECT_EQ(federation.drops(Violation::untimely), 2u);
}

}  // namespace
}  // namespace rink::rti
