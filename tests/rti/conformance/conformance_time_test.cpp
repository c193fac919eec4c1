// What IEEE 1516.1-2010 says of time management, clause 8, service by service.
#include <gtest/gtest.h>

#include "tests/rti/time/relaxed_time.h"
#include "tests/rti/time/timed_federation.h"

namespace rink::rti {
namespace {

using namespace testing;
using What = TimedFederate::Heard::What;

// 8.1, 8.2
TEST(Conformance, AFederateBeginsNeitherRegulatingNorConstrainedAtTimeZero) {
  TimedFederation federation{relaxed()};
  TimedFederate& federate = federation.join();
  EXPECT_FALSE(federate.clock().is_regulating());
  EXPECT_FALSE(federate.clock().is_constrained());
  EXPECT_EQ(federate.ambassador.query_logical_time(), LogicalTime(0.0));
}

// 8.2
TEST(Conformance, EnablingRegulationNamesWhyItCannot) {
  TimedFederation federation{relaxed()};
  TimedFederate& federate = federation.join();
  EXPECT_EQ(error_of([&] { federate.ambassador.enable_time_regulation(-1.0); }),
            "InvalidLookahead");
  EXPECT_EQ(error_of([&] { federate.ambassador.enable_time_regulation(time_unbounded); }),
            "InvalidLookahead");
  federate.ambassador.enable_time_regulation(1.0);
  EXPECT_EQ(error_of([&] { federate.ambassador.enable_time_regulation(1.0); }),
            "RequestForTimeRegulationPending");
  EXPECT_EQ(error_of([&] { federate.ambassador.time_advance_request(LogicalTime(1.0)); }),
            "RequestForTimeRegulationPending");
  federation.carry();
  EXPECT_EQ(error_of([&] { federate.ambassador.enable_time_regulation(1.0); }),
            "TimeRegulationAlreadyEnabled");
  federate.ambassador.time_advance_request(LogicalTime(1.0));
  EXPECT_EQ(error_of([&] { federate.ambassador.enable_time_regulation(1.0); }),
            "InTimeAdvancingState");
}

// 8.3
TEST(Conformance, OneWhoBeginsToRegulateIsMovedToWhereItCannotSpeakInAnybodysPast) {
  TimedFederation federation{relaxed()};
  TimedFederate& old = federation.join_timed(1.0);
  old.ambassador.time_advance_request(LogicalTime(10.0));
  federation.carry();
  TimedFederate& young = federation.join_timed(4.0, false);
  EXPECT_EQ(young.times(What::regulation), std::vector{6.0});
  EXPECT_EQ(error_of([&] { TimedFederation::say(young, 10.0); }), "InvalidLogicalTime")
      << "the other has heard all of 10";
  EXPECT_EQ(error_of([&] { TimedFederation::say(young, just_after(10.0)); }), "");
}

// 8.3, 8.10: who heard all of an instant says nothing at it, for somebody could answer
TEST(Conformance, OneWhoBeginsToRegulateCannotSpeakAtAnInstantOfWhichItHasHeardAll) {
  for (const double lookahead : {0.0, 1.0}) {
    TimedFederation federation{relaxed()};
    TimedFederate& federate = federation.join_timed(-1.0);
    federate.ambassador.time_advance_request(LogicalTime(10.0));
    federation.carry();
    federate.ambassador.enable_time_regulation(lookahead);
    federation.carry();
    EXPECT_EQ(federate.times(What::regulation), std::vector{10.0});
    const double least = std::max(just_after(10.0), 10.0 + lookahead);
    EXPECT_EQ(error_of([&] { TimedFederation::say(federate, std::nextafter(least, 0.0)); }),
              "InvalidLogicalTime");
    EXPECT_EQ(error_of([&] { TimedFederation::say(federate, least); }), "");
    federation.carry();
    EXPECT_EQ(federate.lost, "");
  }
}

TEST(Conformance, OneWhoBeginsToRegulateMaySpeakAtAnInstantOfWhichNobodyHasHeardAll) {
  TimedFederation federation{relaxed()};
  TimedFederate& other = federation.join_timed(-1.0);
  other.ambassador.time_advance_request_available(LogicalTime(10.0));
  federation.carry();
  TimedFederate& federate = federation.join_timed(0.0, false);
  EXPECT_EQ(federate.times(What::regulation), std::vector{10.0});
  EXPECT_EQ(error_of([&] { TimedFederation::say(federate, std::nextafter(10.0, 0.0)); }),
            "InvalidLogicalTime");
  TimedFederation::say(federate, 10.0, "more at that very time");
  other.ambassador.time_advance_request_available(LogicalTime(10.0));
  federation.carry();
  EXPECT_EQ(other.times(What::message), std::vector{10.0});
}

// 8.4, 8.7
TEST(Conformance, WhatIsNotEnabledCannotBeDisabled) {
  TimedFederation federation{relaxed()};
  TimedFederate& federate = federation.join();
  EXPECT_EQ(error_of([&] { federate.ambassador.disable_time_regulation(); }),
            "TimeRegulationIsNotEnabled");
  EXPECT_EQ(error_of([&] { federate.ambassador.disable_time_constrained(); }),
            "TimeConstrainedIsNotEnabled");
  EXPECT_EQ(error_of([&] { federate.ambassador.modify_lookahead(1.0); }),
            "TimeRegulationIsNotEnabled");
  EXPECT_EQ(error_of([&] { federate.ambassador.query_lookahead(); }), "TimeRegulationIsNotEnabled");
}

// 8.5, 8.6
TEST(Conformance, EnablingConstraintNamesWhyItCannotAndIsAnsweredOnce) {
  TimedFederation federation{relaxed()};
  TimedFederate& federate = federation.join();
  federate.ambassador.enable_time_constrained();
  EXPECT_EQ(error_of([&] { federate.ambassador.enable_time_constrained(); }),
            "RequestForTimeConstrainedPending");
  federation.carry();
  EXPECT_EQ(federate.times(What::constrained), std::vector{0.0});
  EXPECT_EQ(error_of([&] { federate.ambassador.enable_time_constrained(); }),
            "TimeConstrainedAlreadyEnabled");
}

// 8.6
TEST(Conformance, ConstraintBeginsOnceNobodyCanSpeakInTheFederatesPast) {
  TimedFederation federation{relaxed()};
  TimedFederate& ahead = federation.join();
  ahead.ambassador.time_advance_request(LogicalTime(5.0));
  federation.carry();
  TimedFederate& slow = federation.join_timed(1.0, false);
  ahead.ambassador.enable_time_constrained();
  federation.carry();
  EXPECT_TRUE(ahead.times(What::constrained).empty());
  slow.ambassador.time_advance_request(LogicalTime(4.0));
  federation.carry();
  EXPECT_EQ(ahead.times(What::constrained), std::vector{5.0});
}

// 8.7
TEST(Conformance, WhatWaitsIsDeliveredWhenConstraintEnds) {
  TimedFederation federation{relaxed()};
  TimedFederate& sender = federation.join_timed(1.0, false);
  TimedFederate& receiver = federation.join_timed(-1.0);
  TimedFederation::say(sender, 7.0, "later");
  federation.carry();
  EXPECT_TRUE(receiver.times(What::message).empty());
  receiver.ambassador.disable_time_constrained();
  federation.carry();
  EXPECT_EQ(receiver.times(What::message), std::vector{7.0});
  EXPECT_FALSE(receiver.heard.back().is_in_order);
}

// 8.8
TEST(Conformance, ATimeAdvanceRequestNamesWhyItCannot) {
  TimedFederation federation{relaxed()};
  TimedFederate& federate = federation.join_timed(1.0);
  TimedFederate& other = federation.join_timed(1.0);
  federate.ambassador.time_advance_request(LogicalTime(0.5));
  federation.carry();
  EXPECT_EQ(error_of([&] { federate.ambassador.time_advance_request(LogicalTime(0.25)); }),
            "LogicalTimeAlreadyPassed");
  EXPECT_EQ(error_of([&] { federate.ambassador.time_advance_request(LogicalTime(-1.0)); }),
            "InvalidLogicalTime");
  EXPECT_EQ(
      error_of([&] { federate.ambassador.time_advance_request(LogicalTime(time_unbounded)); }),
      "InvalidLogicalTime");
  federate.ambassador.time_advance_request(LogicalTime(2.0));
  EXPECT_EQ(error_of([&] { federate.ambassador.next_message_request(LogicalTime(3.0)); }),
            "InTimeAdvancingState");
  EXPECT_EQ(error_of([&] { federate.ambassador.modify_lookahead(2.0); }), "InTimeAdvancingState");
  federation.carry();
  EXPECT_EQ(federate.grants(), std::vector{0.5}) << "the other can still speak at 1";
  other.ambassador.time_advance_request(LogicalTime(2.0));
  federation.carry();
  EXPECT_EQ(federate.grants(), (std::vector{0.5, 2.0}));
}

// 8.8
TEST(Conformance, ATimeAdvanceIsGrantedWithAllMessagesUpToItAndNoneBeyond) {
  TimedFederation federation{relaxed()};
  TimedFederate& sender = federation.join_timed(1.0, false);
  TimedFederate& receiver = federation.join_timed(-1.0);
  for (const double time : {3.0, 1.5, 2.0, 2.5}) TimedFederation::say(sender, time);
  sender.ambassador.time_advance_request(LogicalTime(5.0));
  receiver.ambassador.time_advance_request(LogicalTime(2.0));
  federation.carry();
  EXPECT_EQ(receiver.times(What::message), (std::vector{1.5, 2.0}));
  EXPECT_EQ(receiver.grants(), std::vector{2.0});
}

// 8.8, 8.9
TEST(Conformance, WithoutLookaheadWhoAdvancedToAnInstantCannotSpeakAtItUnlessByTheAvailableForm) {
  TimedFederation federation{relaxed()};
  TimedFederate& strict = federation.join_timed(0.0);
  TimedFederate& loose = federation.join_timed(0.0);
  strict.ambassador.time_advance_request(LogicalTime(1.0));
  loose.ambassador.time_advance_request(LogicalTime(1.0));
  federation.carry();
  EXPECT_EQ(error_of([&] { TimedFederation::say(strict, 1.0); }), "InvalidLogicalTime");
  strict.ambassador.time_advance_request_available(LogicalTime(2.0));
  loose.ambassador.time_advance_request_available(LogicalTime(2.0));
  federation.carry();
  EXPECT_EQ(strict.grants(), (std::vector{1.0, 2.0}));
  EXPECT_EQ(error_of([&] { TimedFederation::say(strict, 2.0, "now"); }), "");
  loose.ambassador.next_message_request_available(LogicalTime(9.0));
  federation.carry();
  EXPECT_EQ(loose.times(What::message), std::vector{2.0});
  EXPECT_EQ(loose.grants(), (std::vector{1.0, 2.0, 2.0}));
}

// 8.10
TEST(Conformance, ANextMessageRequestIsGrantedToTheNextMessageOrToWhatWasAsked) {
  TimedFederation federation{relaxed()};
  TimedFederate& sender = federation.join_timed(1.0, false);
  TimedFederate& receiver = federation.join_timed(-1.0);
  TimedFederation::say(sender, 3.0);
  TimedFederation::say(sender, 3.0);
  TimedFederation::say(sender, 4.0);
  sender.ambassador.time_advance_request(LogicalTime(20.0));
  receiver.ambassador.next_message_request(LogicalTime(10.0));
  federation.carry();
  EXPECT_EQ(receiver.grants(), std::vector{3.0});
  EXPECT_EQ(receiver.times(What::message), (std::vector{3.0, 3.0}));
  receiver.ambassador.next_message_request(LogicalTime(3.5));
  federation.carry();
  EXPECT_EQ(receiver.grants(), (std::vector{3.0, 3.5}));
}

// 8.10
TEST(Conformance, FederatesThatAllWaitForTheirNextMessageDoNotWaitForEachOther) {
  TimedFederation federation{relaxed()};
  for (const double lookahead : {0.0, 0.0, 0.25, 1.0}) federation.join_timed(lookahead);
  for (const auto& each : federation.federates())
    each->ambassador.next_message_request(LogicalTime(1000.0));
  federation.carry();
  for (const auto& each : federation.federates()) EXPECT_EQ(each->grants(), std::vector{1000.0});
}

// 8.12
TEST(Conformance, AFlushQueueRequestDeliversAllAtOnceAndGrantsNoMoreThanIsSafe) {
  TimedFederation federation{relaxed()};
  TimedFederate& sender = federation.join_timed(1.0, false);
  TimedFederate& receiver = federation.join_timed(-1.0);
  for (const double time : {8.0, 2.0, 5.0}) TimedFederation::say(sender, time);
  receiver.ambassador.flush_queue_request(LogicalTime(10.0));
  federation.carry();
  EXPECT_EQ(receiver.times(What::message), (std::vector{2.0, 5.0, 8.0}));
  EXPECT_EQ(receiver.grants(), std::vector{1.0}) << "the sender can still speak at 1";
}

// 8.13
TEST(Conformance, AnUnconstrainedFederateIsGrantedAtOnce) {
  TimedFederation federation{relaxed()};
  federation.join_timed(0.5);
  TimedFederate& free = federation.join_timed(1.0, false);
  free.ambassador.time_advance_request(LogicalTime(100.0));
  federation.carry();
  EXPECT_EQ(free.grants(), std::vector{100.0});
}

// 8.14, 8.15
TEST(Conformance,
     MessagesInReceiveOrderWaitWhileAConstrainedFederateIsGrantedUnlessDeliveryIsAsynchronous) {
  TimedFederation federation{relaxed()};
  TimedFederate& sender = federation.join();
  TimedFederate& receiver = federation.join_timed(-1.0);
  EXPECT_EQ(error_of([&] { receiver.ambassador.disable_asynchronous_delivery(); }),
            "AsynchronousDeliveryAlreadyDisabled");
  sender.ambassador.send_interaction(hail, bytes_of("first"), Stamp{});
  federation.carry();
  EXPECT_TRUE(receiver.times(What::receive_order).empty());
  receiver.ambassador.time_advance_request(LogicalTime(1.0));
  federation.carry();
  ASSERT_EQ(receiver.heard.size(), 3u) << "constrained, message, grant";
  EXPECT_EQ(receiver.heard[1].text, "first");
  EXPECT_TRUE(receiver.heard[1].is_advancing);
  receiver.ambassador.enable_asynchronous_delivery();
  EXPECT_EQ(error_of([&] { receiver.ambassador.enable_asynchronous_delivery(); }),
            "AsynchronousDeliveryAlreadyEnabled");
  sender.ambassador.send_interaction(hail, bytes_of("second"), Stamp{});
  federation.carry();
  EXPECT_EQ(receiver.heard.back().text, "second");
}

// 8.16, 8.18
TEST(Conformance, GaltAndLitsTellWhatCanStillCome) {
  TimedFederation federation{relaxed()};
  TimedFederate& federate = federation.join_timed(-1.0);
  federate.ambassador.query_time_bounds();
  federation.carry();
  EXPECT_EQ(federate.galt, time_unbounded);
  TimedFederate& other = federation.join_timed(2.0);
  TimedFederation::say(other, 5.0);
  other.ambassador.time_advance_request(LogicalTime(4.0));
  federate.ambassador.query_time_bounds();
  federation.carry();
  EXPECT_EQ(federate.galt, 6.0);
  EXPECT_EQ(federate.lits, 5.0);
}

// 8.19, 8.20
TEST(Conformance, AShorterLookaheadComesAboutAsTimeAdvances) {
  TimedFederation federation{relaxed()};
  TimedFederate& federate = federation.join_timed(3.0, false);
  federate.ambassador.modify_lookahead(1.0);
  EXPECT_EQ(federate.ambassador.query_lookahead(), 3.0);
  EXPECT_EQ(error_of([&] { TimedFederation::say(federate, 2.0); }), "InvalidLogicalTime");
  federate.ambassador.time_advance_request(LogicalTime(1.5));
  federation.carry();
  EXPECT_EQ(federate.ambassador.query_lookahead(), 1.5);
  federate.ambassador.time_advance_request(LogicalTime(5.0));
  federation.carry();
  EXPECT_EQ(federate.ambassador.query_lookahead(), 1.0);
}

// 8.23, 8.24
TEST(Conformance, WhatIsSentInReceiveOrderHasNoHandle) {
  TimedFederation federation{relaxed()};
  TimedFederate& sender = federation.join_timed(1.0, false);
  TimedFederate& receiver = federation.join_timed(-1.0);
  receiver.ambassador.enable_asynchronous_delivery();
  sender.ambassador.change_interaction_order_type(hail, Order::receive);
  EXPECT_FALSE(TimedFederation::say(sender, 0.25, "at once"))
      << "nor does a time stamp in receive order have to be late enough";
  federation.carry();
  EXPECT_EQ(receiver.heard.back().what, What::receive_order);
  TimedFederate& free = federation.join();
  EXPECT_FALSE(TimedFederation::say(free, 0.0)) << "who does not regulate sends in receive order";
}

// 6.10, 8.1.1: the model's order; attributes of both orders in one call
TEST(Conformance, EachAttributeTravelsInItsOwnOrder) {
  TimedFederation federation{relaxed()};
  TimedFederate& owner = federation.join_timed(1.0, false);
  TimedFederate& receiver = federation.join_timed(-1.0);
  receiver.ambassador.enable_asynchronous_delivery();
  owner.ambassador.publish_object_class_attributes(ferry, harbour().attributes(ferry));
  receiver.ambassador.subscribe_object_class_attributes(ferry, harbour().attributes(ferry));
  const ObjectHandle object = owner.ambassador.register_object_instance(ferry, "Elba");
  federation.carry();
  std::vector<std::byte> values = values_of(1.5f);
  const std::vector<std::byte> port = varying("Piombino");
  values.insert(values.end(), port.begin(), port.end());
  EXPECT_TRUE(owner.ambassador.update_attribute_values(object, {speed, destination}, values,
                                                       LogicalTime(2.0)));
  federation.carry();
  ASSERT_EQ(receiver.times(What::receive_order), std::vector{2.0});
  EXPECT_EQ(receiver.heard.back().text, text_of(values_of(1.5f)));
  owner.ambassador.time_advance_request(LogicalTime(5.0));
  receiver.ambassador.time_advance_request(LogicalTime(2.0));
  federation.carry();
  ASSERT_EQ(receiver.times(What::message), std::vector{2.0});
  EXPECT_EQ(receiver.heard[receiver.heard.size() - 2].text, text_of(port));
}

// 6.14, 8.21
TEST(Conformance, ADeletionComesAtItsTimeAndCanBeTakenBack) {
  TimedFederation federation{relaxed()};
  TimedFederate& owner = federation.join_timed(1.0, false);
  TimedFederate& receiver = federation.join_timed(-1.0);
  owner.ambassador.publish_object_class_attributes(vessel, harbour().attributes(vessel));
  receiver.ambassador.subscribe_object_class_attributes(vessel, harbour().attributes(vessel));
  const ObjectHandle first = owner.ambassador.register_object_instance(vessel),
                     second = owner.ambassador.register_object_instance(vessel);
  federation.carry();
  const RetractionHandle handle = owner.ambassador.delete_object_instance(first, LogicalTime(2.0));
  owner.ambassador.delete_object_instance(second, LogicalTime(3.0));
  federation.carry();
  EXPECT_TRUE(receiver.times(What::removal).empty());
  EXPECT_EQ(federation.execution().object_count(), 2u);
  owner.ambassador.retract(handle);
  owner.ambassador.time_advance_request(LogicalTime(9.0));
  receiver.ambassador.time_advance_request(LogicalTime(5.0));
  federation.carry();
  EXPECT_EQ(receiver.times(What::removal), std::vector{3.0});
  EXPECT_EQ(federation.execution().object_count(), 1u);
  EXPECT_TRUE(federation.execution().is_in_scope(receiver.ambassador.federate(), first));
}

// 4.10, 8.1: a federate that left, or died, holds nobody back
TEST(Conformance, WhoLeftOrWasKilledHoldsNobodysTimeBack) {
  TimedFederation federation{relaxed()};
  TimedFederate& killed = federation.join_timed(0.0);
  TimedFederate& resigned = federation.join_timed(0.0);
  TimedFederate& waiting = federation.join_timed(0.0);
  TimedFederation::say(killed, 0.5, "last words");
  waiting.ambassador.time_advance_request(LogicalTime(1.0));
  federation.carry();
  EXPECT_TRUE(waiting.grants().empty());
  federation.kill(killed);
  federation.resign(resigned);
  federation.carry();
  EXPECT_EQ(waiting.times(What::message), std::vector{0.5}) << "what it said before counts";
  EXPECT_EQ(waiting.grants(), std::vector{1.0});
}

}  // namespace
}  // namespace rink::rti
