// Federates whose clock is off, at their own end and as bytes that break the rules; and what time management costs.
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

TEST(TimeCosts, AFederationWithoutTimeManagementHasNone) {
  int made = 0;
  FederationServices services;
  services.time_management = [&made] { return ++made, std::make_unique<ConservativeTime>(); };
  TimedFederation federation(services);
  TimedFederate& sender = federation.join();
  TimedFederate& receiver = federation.join();
  sender.ambassador.send_interaction(hail, bytes_of("now"), Stamp{});
  EXPECT_FALSE(TimedFederation::say(sender, 3.0, "who does not regulate sends as ever"));
  federation.carry();
  EXPECT_EQ(receiver.heard.size(), 2u);
  EXPECT_EQ(federation.execution().counters().timed_received, 0u);
  EXPECT_EQ(made, 0) << "nothing was made, so a flush had nothing to ask";
  sender.ambassador.enable_time_regulation(1.0);
  federation.carry();
  EXPECT_EQ(made, 1);
}

/// A stamp costs what it did; a request and its grant are this long.
TEST(TimeCosts, AStepOfAFederateCostsTwentySevenBytes) {
  AdvanceRequestMessage request;
  TimeAdvanceGrantMessage grant;
  EXPECT_EQ(frame_header_size + measure(request), 14u);
  EXPECT_EQ(frame_header_size + measure(grant), 13u);
}

}  // namespace
}  // namespace rink::rti
