// What newcomers are told of objects whose updates go in time-stamp order.
#include "rti/management/federation_report.h"
#include "tests/rti/time/relaxed_time.h"
#include "tests/rti/time/timed_federation.h"

namespace rink::rti {
namespace {

using namespace testing;
using What = TimedFederate::Heard::What;

class TimedState : public ::testing::Test {
 protected:
  TimedState() {
    owner.ambassador.publish_object_class_attributes(ferry, harbour().attributes(ferry));
    receiver.ambassador.subscribe_object_class_attributes(ferry, {destination});
    object = owner.ambassador.register_object_instance(ferry, "Elba");
    federation.carry();
  }
  void sail(const std::string& port, double time) {
    owner.ambassador.update_attribute_values(object, {destination}, varying(port),
                                             LogicalTime(time));
    federation.carry();
  }
  /// What one who joins now is told first; "" for nothing.
  std::string told_to_a_newcomer() {
    TimedFederate& newcomer = federation.join();
    newcomer.ambassador.subscribe_object_class_attributes(ferry, {destination});
    federation.carry();
    return newcomer.heard.empty() ? "" : newcomer.heard.back().text.substr(4);
  }
  void advance_both(double time) {
    owner.ambassador.time_advance_request(LogicalTime(time));
    receiver.ambassador.time_advance_request(LogicalTime(time));
    federation.carry();
  }
  TimedFederation federation{relaxed()};
  TimedFederate& owner = federation.join_timed(1.0);
  TimedFederate& receiver = federation.join_timed(-1.0);
  ObjectHandle object;
};

TEST_F(TimedState, ANewcomerIsNotToldWhatIsStillToCome) {
  sail("Piombino", 2.0);
  sail("Bastia", 6.0);
  EXPECT_EQ(told_to_a_newcomer(), "");
  advance_both(4.0);
  EXPECT_EQ(receiver.times(What::message), std::vector{2.0});
  EXPECT_EQ(told_to_a_newcomer(), "Piombino");
  advance_both(9.0);
  EXPECT_EQ(told_to_a_newcomer(), "Bastia");
}

TEST_F(TimedState, AnEarlierUpdateThatHadToWaitDoesNotReplaceALaterOne) {
  sail("Piombino", 2.0);
  receiver.ambassador.unsubscribe_object_class(ferry);
  federation.carry();
  sail("Bastia", 6.0);  // nobody has to wait for it
  EXPECT_EQ(told_to_a_newcomer(), "Bastia");
  advance_both(9.0);
  EXPECT_EQ(told_to_a_newcomer(), "Bastia");
}

TEST_F(TimedState, AnUpdateIsDroppedForThoseForWhomTheObjectIsGone) {
  sail("Piombino", 2.0);
  owner.ambassador.delete_object_instance(object);
  federation.carry();
  advance_both(3.0);
  EXPECT_TRUE(receiver.times(What::message).empty());
  EXPECT_EQ(receiver.times(What::removal), std::vector{-1.0})
      << "in receive order, while it advanced";
}

TEST_F(TimedState, EachReceiverIsToldTheAttributesThatItNamed) {
  owner.ambassador.change_attribute_order_type(object, {speed}, Order::timestamp);
  std::vector<std::byte> values = values_of(2.5f);
  const std::vector<std::byte> port = varying("Bastia");
  values.insert(values.end(), port.begin(), port.end());
  owner.ambassador.update_attribute_values(object, {speed, destination}, values, LogicalTime(2.0));
  federation.carry();
  advance_both(3.0);
  ASSERT_EQ(receiver.times(What::message), std::vector{2.0});
  EXPECT_EQ(receiver.heard[receiver.heard.size() - 2].text, text_of(port));
}

TEST_F(TimedState, WhatGoesInTimeStampOrderIsCountedAsWhatGoesOtherwiseIs) {
  for (int i = 0; i < 7; ++i) sail("Bastia", 2.0 + i);
  for (int i = 0; i < 5; ++i) TimedFederation::say(owner, 2.0 + i, "ahoy");
  federation.carry();
  advance_both(9.0);
  const FederationReport report = federation.execution().report();
  ASSERT_EQ(report.federates.size(), 2u);
  EXPECT_EQ(report.federates[0].counts.updates_sent, 7u);
  EXPECT_EQ(report.federates[0].counts.interactions_sent, 5u);
  EXPECT_EQ(report.federates[1].counts.reflections_received, 7u);
  EXPECT_EQ(report.federates[1].counts.interactions_received, 5u);
}

/// An owner of four ferries, one who waits for what the owner says, and a newcomer who has been
/// told of the first ferry when something is said of the last.
class NewcomerOfALargeWorld : public ::testing::TestWithParam<bool> {
 protected:
  NewcomerOfALargeWorld() {
    owner.ambassador.publish_object_class_attributes(ferry, harbour().attributes(ferry));
    if (GetParam()) waiting.ambassador.subscribe_object_class_attributes(ferry, {destination});
    for (int i = 0; i < 4; ++i) ferries.push_back(owner.ambassador.register_object_instance(ferry));
    owner.ambassador.update_attribute_values(ferries.back(), {destination}, varying("Piombino"),
                                             LogicalTime(1.5));
    step(20);
    advance(2.0);
    newcomer.ambassador.subscribe_object_class_attributes(ferry, {destination});
    step(1);
  }
  void step(int count) {
    for (int i = 0; i < count; ++i) {
      for (TimedFederate* each : {&owner, &waiting, &newcomer}) federation.carry_up(*each);
      federation.tick();
      for (TimedFederate* each : {&owner, &waiting, &newcomer}) federation.carry_down(*each);
    }
  }
  void advance(double time) {
    for (TimedFederate* each : {&owner, &waiting})
      each->ambassador.time_advance_request(LogicalTime(time));
    step(20);
  }
  std::string last_port() const {
    const auto last =
        std::find_if(newcomer.heard.rbegin(), newcomer.heard.rend(), [](const auto& each) {
          return each.what == What::message || each.what == What::receive_order;
        });
    return last == newcomer.heard.rend() ? "" : last->text.substr(4);
  }
  TimedFederation federation{relaxed(), with_entry_room(1)};
  TimedFederate& owner = federation.join_timed(1.0);
  TimedFederate& waiting = federation.join_timed(-1.0);
  TimedFederate& newcomer = federation.join();
  std::vector<ObjectHandle> ferries;
};

TEST_P(NewcomerOfALargeWorld, IsNotLostByTheDeletionOfWhatItWasNotToldOfYet) {
  owner.ambassador.update_attribute_values(ferries[2], {destination}, varying("Bastia"),
                                           LogicalTime(4.0));
  owner.ambassador.delete_object_instance(ferries[2], LogicalTime(4.0));
  owner.ambassador.delete_object_instance(ferries[3], LogicalTime(4.0));
  step(10);
  advance(10.0);
  EXPECT_EQ(newcomer.lost, "");
  EXPECT_EQ(waiting.lost, "");
  EXPECT_EQ(owner.lost, "");
  EXPECT_EQ(newcomer.times(What::removal).size(), 1u)
      << "of the ferry of which it was told since something was said of it";
}

TEST_P(NewcomerOfALargeWorld, DoesNotGoBackToWhatWasBeforeTheNewestThatItWasTold) {
  owner.ambassador.update_attribute_values(ferries.back(), {destination}, varying("Bastia"),
                                           LogicalTime(4.0));
  step(1);
  EXPECT_EQ(last_port(), "Bastia");
  step(10);
  EXPECT_EQ(last_port(), "Bastia");
  advance(10.0);
  EXPECT_EQ(last_port(), "Bastia");
  EXPECT_EQ(newcomer.lost, "");
}

INSTANTIATE_TEST_SUITE_P(While, NewcomerOfALargeWorld, ::testing::Bool(),
                         [](const auto& is_waiting) {
                           return is_waiting.param ? "SomebodyWaitsForTheSame"
                                                   : "NobodyElseHearsOfIt";
                         });

TEST(TimedMessages, OneWhoNeverAdvancesIsLostBeforeWhatWaitsForItCostsTheOthersTheirSender) {
  FederationSettings settings;
  settings.timed_max = 100;
  TimedFederation federation({}, settings);
  TimedFederate& sender = federation.join_timed(1.0);
  TimedFederate& awake = federation.join_timed(-1.0);
  TimedFederate& stopped = federation.join_timed(-1.0);
  for (int step = 1; step <= 300; ++step) {
    TimedFederation::say(sender, sender.clock().earliest(), "step " + std::to_string(step));
    for (TimedFederate* each : {&sender, &awake})
      each->ambassador.time_advance_request(LogicalTime(step));
    federation.carry();
  }
  EXPECT_EQ(awake.times(What::message).size(), 300u);
  EXPECT_EQ(sender.lost, "");
  EXPECT_EQ(awake.lost, "");
  EXPECT_NE(stopped.lost, "");
  EXPECT_EQ(federation.drops(Violation::over_limit), 1u);
}

}  // namespace
}  // namespace rink::rti
