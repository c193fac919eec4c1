// Federates whose clock is off, at their own end and as bytes that break the rules; and what time
// management costs.
#include "rti/wire/time_messages.h"
#include "tests/rti/time/relaxed_time.h"
#include "tests/rti/time/timed_federation.h"

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
  EXPECT_EQ(error_of([&] { federate.ambassador.time_advance_request(LogicalTime(3600.0)); }),
            "LogicalTimeAlreadyPassed");
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

/// A retraction whose bytes break the rule that the ambassador keeps.
TEST(BadClock, ARetractionAfterItsTimeIsNotLetThrough) {
  const auto scene = [](double advanced_to, bool is_allowed) {
    TimedFederation federation{relaxed()};
    TimedFederate& sender = federation.join_timed(1.0, false);
    TimedFederate& waiting = federation.join_timed(-1.0);
    TimedFederate& free = federation.join();
    const RetractionHandle handle = TimedFederation::say(sender, 3.0);
    sender.ambassador.time_advance_request(LogicalTime(advanced_to));
    federation.carry();
    send_raw(federation, sender, RetractMessage{handle.number});
    sender.ambassador.time_advance_request(LogicalTime(9.0));
    waiting.ambassador.time_advance_request(LogicalTime(9.0));
    federation.carry();
    EXPECT_EQ(waiting.times(TimedFederate::Heard::What::message).size(), is_allowed ? 0u : 1u);
    EXPECT_EQ(free.times(TimedFederate::Heard::What::retraction).size(), is_allowed ? 1u : 0u);
    EXPECT_EQ(federation.execution().counters().retractions, is_allowed ? 1u : 0u);
    EXPECT_EQ(sender.lost, "") << "it may have crossed the grant";
  };
  scene(2.0, true);                        // the least time stamp allowed is 3
  scene(std::nextafter(2.0, 3.0), false);  // and here just after it
  scene(5.0, false);
}

TEST(BadClock, ATimeStampBelowWhatRegulationBeganWithCostsTheConnection) {
  for (const double stamp : {10.0, just_after(10.0)}) {
    TimedFederation federation{relaxed()};
    TimedFederate& federate = federation.join_timed(-1.0);
    federate.ambassador.time_advance_request(LogicalTime(10.0));
    federation.carry();
    federate.ambassador.enable_time_regulation(0.0);
    federation.carry();
    std::vector<std::byte> content;
    InteractionMessage words{static_cast<std::uint16_t>(hail.value), FederateHandle::none, {}, {}};
    write(content, words);
    TimedSendMessage message;
    message.stamp.time = stamp;
    message.content = content;
    send_raw(federation, federate, message);
    EXPECT_EQ(federation.drops(Violation::untimely), stamp == 10.0 ? 1u : 0u) << stamp;
  }
}

std::vector<std::byte> timed_hail(double time, std::uint64_t number) {
  std::vector<std::byte> content;
  InteractionMessage words{static_cast<std::uint16_t>(hail.value), FederateHandle::none, {}, {}};
  write(content, words);
  TimedSendMessage message;
  message.number = number;
  message.stamp.time = time;
  message.content = content;
  FrameWriter frame(frame_max_to_rti);
  write(frame.begin_message(measure(message)), message);
  frame.appended();
  return {frame.bytes().begin(), frame.bytes().end()};
}

/// Who waits for an advance may already be granted it: what it says must be late enough for that.
TEST(BadClock, ATimeStampBelowWhatAPendingAdvanceAllowsCostsTheConnection) {
  for (const AdvanceKind kind :
       {AdvanceKind::time_advance, AdvanceKind::next_message, AdvanceKind::flush_queue}) {
    for (const bool is_early : {true, false}) {
      TimedFederation federation{relaxed()};
      TimedFederate& slow = federation.join_timed(0.0, false);  // so that nothing is granted
      TimedFederate& federate = federation.join_timed(1.0);
      AdvanceRequestMessage request{static_cast<std::uint8_t>(kind), 5.0};
      FrameWriter frame(frame_max_to_rti);
      write(frame.begin_message(measure(request)), request);
      frame.appended();
      federation.execution().receive(federate.connection, frame.bytes());
      const double least = 6.0;  // 5 and the lookahead
      federation.execution().receive(federate.connection,
                                     timed_hail(is_early ? std::nextafter(least, 0.0) : least, 0));
      EXPECT_EQ(federation.drops(Violation::untimely), is_early ? 1u : 0u)
          << static_cast<int>(kind);
      EXPECT_EQ(slow.lost, "");
    }
  }
}

TEST(BadClock, ARetractionAfterRegulationEndedIsNotLetThrough) {
  TimedFederation federation{relaxed()};
  TimedFederate& sender = federation.join_timed(1.0, false);
  TimedFederate& free = federation.join();
  const RetractionHandle handle = TimedFederation::say(sender, 5.0);
  sender.ambassador.disable_time_regulation();
  federation.carry();
  sender.ambassador.enable_time_regulation(1.0);
  federation.carry();
  send_raw(federation, sender, RetractMessage{handle.number});
  EXPECT_TRUE(free.times(TimedFederate::Heard::What::retraction).empty());
  EXPECT_EQ(federation.execution().counters().retractions, 0u);
}

/// An RTI that answers what its federate's clock forbids loses it.
TEST(BadClock, AnAmbassadorLeavesAnRtiWhoseAnswersGoBackwardsOrTooFar) {
  const auto is_left_after = [](auto ask, auto... answers) {
    TimedFederation federation{relaxed()};
    TimedFederate& slow = federation.join_timed(0.0, false);
    TimedFederate& federate = federation.join();
    federate.ambassador.time_advance_request(LogicalTime(2.0));
    federation.carry();
    ask(federate.ambassador);
    federate.ambassador.clear_outgoing();
    FrameWriter frame(frame_max_to_federate);
    const auto add = [&](auto message) {
      write(frame.begin_message(measure(message)), message);
      frame.appended();
    };
    (add(answers), ...);
    static_cast<void>(slow);
    return !federate.ambassador.receive(frame.bytes());
  };
  const auto regulation = [](Ambassador& each) { each.enable_time_regulation(1.0); };
  EXPECT_FALSE(is_left_after(regulation, TimeRegulationEnabledMessage{2.0, 3.0}));
  EXPECT_TRUE(is_left_after(regulation, TimeRegulationEnabledMessage{1.0, 3.0}))
      << "before its time";
  EXPECT_TRUE(is_left_after(regulation, TimeRegulationEnabledMessage{2.0, 1.5}))
      << "a first stamp before its time";
  const auto again = [](Ambassador& each) { each.time_advance_request(LogicalTime(3.0)); };
  EXPECT_FALSE(is_left_after(again, TimeAdvanceGrantMessage{3.0}));
  EXPECT_TRUE(is_left_after(again, TimeAdvanceGrantMessage{std::nextafter(3.0, 4.0)}))
      << "beyond what was asked";
  EXPECT_TRUE(is_left_after(again, TimeAdvanceGrantMessage{1.0})) << "before its time";
  EXPECT_TRUE(is_left_after(again, TimeAdvanceGrantMessage{3.0}, TimeAdvanceGrantMessage{3.0}))
      << "nobody asked";
  const auto constraint = [](Ambassador& each) { each.enable_time_constrained(); };
  EXPECT_FALSE(is_left_after(constraint, TimeConstrainedEnabledMessage{2.0}));
  EXPECT_TRUE(is_left_after(constraint, TimeConstrainedEnabledMessage{1.0}))
      << "at another time than its own";
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
TEST(TimeCosts, AStepOfAFederateCostsTwentyThreeBytes) {
  AdvanceRequestMessage request;
  TimeAdvanceGrantMessage grant;
  EXPECT_EQ(frame_head_size(0) + measure(request), 12u);
  EXPECT_EQ(frame_head_size(0) + measure(grant), 11u);
}

}  // namespace
}  // namespace rink::rti
