// What IEEE 1516.1-2010 says of taking messages back, 8.21 and 8.22.
#include <gtest/gtest.h>

#include "tests/rti/time/relaxed_time.h"
#include "tests/rti/time/timed_federation.h"

namespace rink::rti {
namespace {

using namespace testing;
using What = TimedFederate::Heard::What;

// 8.21
TEST(Conformance, AMessageThatIsTakenBackIsNotDelivered) {
  TimedFederation federation{relaxed()};
  TimedFederate& sender = federation.join_timed(1.0, false);
  TimedFederate& receiver = federation.join_timed(-1.0);
  const RetractionHandle kept = TimedFederation::say(sender, 3.0),
                         taken_back = TimedFederation::say(sender, 2.0);
  EXPECT_TRUE(kept && taken_back);
  federation.carry();
  sender.ambassador.retract(taken_back);
  sender.ambassador.time_advance_request(LogicalTime(9.0));
  receiver.ambassador.next_message_request(LogicalTime(9.0));
  federation.carry();
  EXPECT_EQ(receiver.grants(), std::vector{3.0});
  EXPECT_EQ(receiver.times(What::message), std::vector{3.0});
  EXPECT_EQ(error_of([&] { sender.ambassador.retract(kept); }), "MessageCanNoLongerBeRetracted");
  EXPECT_EQ(error_of([&] {
              sender.ambassador.retract({receiver.ambassador.federate(), 0, 90.0});
            }),
            "InvalidMessageRetractionHandle");
  EXPECT_EQ(error_of([&] { receiver.ambassador.retract(kept); }), "TimeRegulationIsNotEnabled");
}

// 8.21: as long as a message of that time stamp could still be sent
TEST(Conformance, AMessageMayBeTakenBackAtTheLeastTimeStampAllowedAndNotBelowIt) {
  TimedFederation federation{relaxed()};
  TimedFederate& sender = federation.join_timed(1.0, false);
  TimedFederate& receiver = federation.join_timed(-1.0);
  const RetractionHandle below = TimedFederation::say(sender, std::nextafter(4.0, 0.0)),
                         at = TimedFederation::say(sender, 4.0);
  sender.ambassador.time_advance_request(LogicalTime(3.0));
  EXPECT_EQ(error_of([&] { sender.ambassador.retract(below); }), "MessageCanNoLongerBeRetracted")
      << "while the advance is under way";
  federation.carry();
  EXPECT_EQ(error_of([&] { sender.ambassador.retract(below); }), "MessageCanNoLongerBeRetracted");
  EXPECT_EQ(error_of([&] { sender.ambassador.retract(at); }), "");
  sender.ambassador.time_advance_request(LogicalTime(9.0));
  receiver.ambassador.time_advance_request(LogicalTime(9.0));
  federation.carry();
  EXPECT_EQ(receiver.times(What::message), std::vector{below.time});
}

// 8.21
TEST(Conformance, WhatWasSentBeforeRegulationEndedStays) {
  TimedFederation federation{relaxed()};
  TimedFederate& sender = federation.join_timed(1.0, false);
  TimedFederate& receiver = federation.join_timed(-1.0);
  const RetractionHandle early = TimedFederation::say(sender, 5.0);
  sender.ambassador.disable_time_regulation();
  federation.carry();
  sender.ambassador.enable_time_regulation(1.0);
  federation.carry();
  EXPECT_EQ(error_of([&] { sender.ambassador.retract(early); }), "MessageCanNoLongerBeRetracted");
  sender.ambassador.time_advance_request(LogicalTime(9.0));
  receiver.ambassador.time_advance_request(LogicalTime(9.0));
  federation.carry();
  EXPECT_EQ(receiver.times(What::message), std::vector{5.0});
}

// 8.22
TEST(Conformance, WhoHasTheMessageAlreadyIsAskedToTakeItBack) {
  TimedFederation federation{relaxed()};
  TimedFederate& sender = federation.join_timed(1.0, false);
  TimedFederate& receiver = federation.join();
  const RetractionHandle handle = TimedFederation::say(sender, 3.0);
  federation.carry();
  sender.ambassador.retract(handle);
  federation.carry();
  EXPECT_EQ(receiver.heard.back().what, What::retraction);
  EXPECT_EQ(receiver.heard.back().handle, handle);
}

}  // namespace
}  // namespace rink::rti
