// The management object model as object classes: found by subscribing, told when asked, when due
// and when it changes, and nothing at all while nobody subscribes.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "rti/management/management_values.h"
#include "tests/rti/bare.h"
#include "tests/rti/rig.h"
#include "tests/rti/warden.h"

namespace rink::rti::testing {
namespace {

class ManagementObjects : public ::testing::TestWithParam<Carrier> {};

TEST_P(ManagementObjects, TellWhatHasHappenedByTheStandardsNames) {
  Rig rig(GetParam());
  Station &pilot = rig.join("pilot"), &coast = rig.join("coast");
  pilot.ambassador.publish_object_class_attributes(vessel, AttributeSet{speed});
  pilot.ambassador.publish_interaction_class(hail);
  coast.ambassador.subscribe_object_class_attributes(vessel, AttributeSet{speed});
  coast.ambassador.subscribe_interaction_class(hail);
  rig.settle();
  const ObjectHandle object = pilot.ambassador.register_object_instance(vessel),
                     other = pilot.ambassador.register_object_instance(vessel),
                     third = pilot.ambassador.register_object_instance(vessel);
  for (int i = 0; i < 5; ++i) {
    for (const ObjectHandle each : {object, other})
      pilot.ambassador.update_attribute_values(each, AttributeSet{speed}, values_of(1.0f), {});
    rig.settle();
  }
  for (int i = 0; i < 3; ++i) pilot.ambassador.send_interaction(hail, bytes_of("ahoy"), {});
  rig.settle();
  pilot.ambassador.delete_object_instance(third);
  rig.settle();
  const Warden warden(rig);
  EXPECT_EQ(warden.count("pilot", "HLAupdatesSent"), 10);
  EXPECT_EQ(warden.count("pilot", "HLAinteractionsSent"), 3);
  EXPECT_EQ(warden.count("pilot", "HLAobjectInstancesRegistered"), 3);
  EXPECT_EQ(warden.count("pilot", "HLAobjectInstancesDeleted"), 1);
  EXPECT_EQ(warden.count("pilot", "HLAobjectInstancesThatCanBeDeleted"), 2);
  EXPECT_EQ(warden.count("pilot", "HLAobjectInstancesDiscovered"), 0);
  EXPECT_EQ(warden.count("coast", "HLAobjectInstancesDiscovered"), 3);
  EXPECT_EQ(warden.count("coast", "HLAobjectInstancesRemoved"), 1);
  EXPECT_EQ(static_cast<std::uint64_t>(warden.count("coast", "HLAreflectionsReceived")),
            coast.ambassador.counters().updates_reflected);
  EXPECT_EQ(warden.count("coast", "HLAinteractionsReceived"), 3);
  EXPECT_EQ(warden.text(warden.object_of("coast"), "HLAfederateType"), "tester");
  EXPECT_EQ(warden.reader(warden.object_of("coast"), "HLAfederateHandle").handle(),
            coast.ambassador.federate().value);
  EXPECT_EQ(warden.count("coast", "HLAfederateState"), 1);
  EXPECT_EQ(warden.time("coast", "HLAGALT"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(warden.text(warden.federation(), "HLAfederationName"), "rink");
  EXPECT_EQ(warden.text(warden.federation(), "HLAFOMmoduleDesignatorList"), "Harbour");
  EXPECT_EQ(warden.reader(warden.federation(), "HLAfederatesInFederation").handles(),
            (std::vector<std::uint32_t>{0, 1, 2}));
}

INSTANTIATE_TEST_SUITE_P(Carriers, ManagementObjects,
                         ::testing::Values(Carrier::in_process, Carrier::tcp),
                         [](const auto& carrier) { return name_of(carrier.param); });

TEST(ManagementObjectModel, FollowsThoseWhoComeAndGo) {
  Rig rig(Carrier::in_process);
  Warden warden(rig);
  EXPECT_TRUE(warden.object_of("warden")) << "its own too";
  Station& guest = rig.join("guest");
  const ObjectHandle object = warden.object_of("guest");
  ASSERT_TRUE(object);
  EXPECT_EQ(warden.reader(warden.federation(), "HLAfederatesInFederation").handles(),
            (std::vector<std::uint32_t>{0, 1}));
  guest.ambassador.resign();
  rig.settle();
  EXPECT_FALSE(warden.heard().objects.contains(object.value));
  EXPECT_EQ(warden.reader(warden.federation(), "HLAfederatesInFederation").handles(),
            std::vector<std::uint32_t>{0});
}

TEST(ManagementObjectModel, ALostFederatesObjectIsRemoved) {
  Bare bare;
  bare.witness.subscribe_object_class_attributes(federate_class,
                                                 harbour().attributes(federate_class));
  bare.tick();
  bare.execution.connect(1);
  bare.execution.receive(1, frame_of(join_of("stranger")));
  bare.tick();
  EXPECT_EQ(bare.witness_heard.objects.size(), 2u);
  bare.execution.disconnect(1, "killed");
  bare.tick();
  EXPECT_EQ(bare.witness_heard.objects.size(), 1u);
}

TEST(ManagementObjectModel, CostsNothingWhileNobodySubscribes) {
  Rig rig(Carrier::in_process);
  Station &pilot = rig.join("pilot"), &other = rig.join("other");
  pilot.ambassador.publish_object_class_attributes(vessel, AttributeSet{speed});
  other.ambassador.subscribe_object_class_attributes(vessel, AttributeSet{speed});
  const ObjectHandle object = pilot.ambassador.register_object_instance(vessel);
  for (int i = 0; i < 20; ++i) {
    pilot.ambassador.update_attribute_values(object, AttributeSet{speed}, values_of(1.0f), {});
    rig.settle();
  }
  EXPECT_EQ(rig.execution().object_count(), 1u) << "nobody's but the pilot's";
  EXPECT_EQ(rig.execution().counters().management_updates, 0u);
  {
    Warden warden(rig);
    EXPECT_EQ(rig.execution().object_count(), 1u + 1u + 3u);
    const std::uint64_t told = rig.execution().counters().management_updates;
    EXPECT_EQ(told, 4u) << "one for each object";
    for (int i = 0; i < 20; ++i) {
      pilot.ambassador.update_attribute_values(object, AttributeSet{speed}, values_of(1.0f), {});
      rig.settle();
    }
    EXPECT_EQ(rig.execution().counters().management_updates, told)
        << "no period is set, and nobody asked";
    warden.ambassador().unsubscribe_object_class(federate_class);
    rig.settle();
    EXPECT_TRUE(warden.federation()) << "of which it still hears";
    warden.ambassador().unsubscribe_object_class(federation_class);
    rig.settle();
    EXPECT_EQ(rig.execution().object_count(), 1u);
  }
}

TEST(ManagementObjectModel, IsToldWhenAskedAndOnlyWhatChanged) {
  Rig rig(Carrier::in_process);
  Warden warden(rig);
  Station& pilot = rig.join("pilot");
  pilot.ambassador.publish_interaction_class(hail);
  rig.join("coast").ambassador.subscribe_interaction_class(hail);
  rig.settle();
  pilot.ambassador.send_interaction(hail, bytes_of("ahoy"), {});
  rig.settle();
  EXPECT_EQ(warden.count("pilot", "HLAinteractionsSent"), 0) << "not asked yet";
  warden.ambassador().request_attribute_value_update(
      warden.object_of("pilot"),
      AttributeSet{*harbour().attribute(federate_class, "HLAinteractionsSent")});
  rig.settle();
  EXPECT_EQ(warden.count("pilot", "HLAinteractionsSent"), 1);
  EXPECT_EQ(warden.count("coast", "HLAinteractionsReceived"), 0) << "nobody asked for that";
  warden.ask();
  EXPECT_EQ(warden.count("coast", "HLAinteractionsReceived"), 1);
}

TEST(ManagementObjectModel, IsToldAtThePeriodThatHlaSetTimingSets) {
  Rig rig(Carrier::in_process);
  Station& pilot = rig.join("pilot");
  Warden warden(rig);
  const auto sent = [&] { return warden.count("pilot", "HLAinteractionsSent"); };
  pilot.ambassador.publish_interaction_class(hail);
  warden.ambassador().subscribe_interaction_class(hail);
  rig.settle();
  warden.send("HLAfederate.HLAadjust.HLAsetTiming", timing(pilot.ambassador.federate(), 2));
  int shouts = 0;
  std::vector<int> told_at;
  for (int second = 1; second <= 6; ++second) {
    pilot.ambassador.send_interaction(hail, bytes_of("ahoy"), {});
    ++shouts;
    rig.now = second;
    const std::int32_t before = sent();
    rig.settle();
    if (sent() == before) continue;
    told_at.push_back(second);
    EXPECT_EQ(sent(), shouts);
  }
  EXPECT_EQ(told_at, (std::vector<int>{2, 4, 6}));
  warden.send("HLAfederate.HLAadjust.HLAsetTiming", timing(pilot.ambassador.federate(), 0));
  const std::uint64_t told = rig.execution().counters().management_updates;
  for (rig.now = 7; rig.now < 12; ++rig.now)
    pilot.ambassador.send_interaction(hail, bytes_of("ahoy"), {}), rig.settle();
  EXPECT_EQ(rig.execution().counters().management_updates, told) << "0: no more reports";
}

TEST(ManagementObjectModel, TellsTheStateOfTimeManagementWhenItChanges) {
  Rig rig(Carrier::in_process);
  Warden warden(rig);
  Station &pilot = rig.join("pilot"), &coast = rig.join("coast");
  pilot.ambassador.enable_time_regulation(0.5);
  coast.ambassador.enable_time_constrained();
  rig.settle();
  EXPECT_EQ(warden.count("pilot", "HLAtimeRegulating"), 1);
  EXPECT_EQ(warden.count("pilot", "HLAtimeConstrained"), 0);
  EXPECT_EQ(warden.count("coast", "HLAtimeConstrained"), 1);
  EXPECT_EQ(warden.time("pilot", "HLAlookahead"), 0.5);
  pilot.ambassador.time_advance_request(LogicalTime(2.0));
  rig.settle();
  coast.ambassador.time_advance_request(LogicalTime(10.0));
  rig.settle();
  warden.ask();
  EXPECT_EQ(warden.time("pilot", "HLAlogicalTime"), 2.0);
  EXPECT_EQ(warden.count("pilot", "HLAtimeManagerState"), 0);
  EXPECT_EQ(warden.count("coast", "HLAtimeManagerState"), 1) << "it waits for the pilot";
  EXPECT_EQ(warden.time("coast", "HLAGALT"), 2.5);
  pilot.ambassador.disable_time_regulation();
  rig.settle();
  EXPECT_EQ(warden.count("pilot", "HLAtimeRegulating"), 0);
  EXPECT_EQ(coast.ambassador.query_logical_time().value, 10.0);
}

TEST(ManagementObjectModel, ReportsPublicationsSubscriptionsAndPoints) {
  Rig rig(Carrier::in_process);
  Warden warden(rig);
  Station& pilot = rig.join("pilot");
  pilot.ambassador.publish_object_class_attributes(vessel, AttributeSet{speed});
  pilot.ambassador.publish_interaction_class(hail);
  pilot.ambassador.subscribe_object_class_attributes(ferry, AttributeSet{position}, {}, false);
  pilot.ambassador.register_synchronization_point("anchored");
  for (const char* each : {"HLAfederate.HLAreport.HLAreportObjectClassPublication",
                           "HLAfederate.HLAreport.HLAreportInteractionPublication",
                           "HLAfederate.HLAreport.HLAreportObjectClassSubscription",
                           "HLAfederation.HLAreport.HLAreportSynchronizationPoints"})
    warden.ambassador().subscribe_interaction_class(manager_interaction(each));
  rig.settle();
  const std::uint32_t number = pilot.ambassador.federate().value;
  const auto about = written([&](ManagementWriter to) { to.handle(number); });
  warden.send("HLAfederate.HLArequest.HLArequestPublications", about);
  auto& heard = warden.heard().interactions;
  ASSERT_EQ(heard.size(), 2u);
  EXPECT_EQ(heard[0].second, text_of(written([&](ManagementWriter to) {
              to.handle(number), to.count(1), to.handle(vessel.value), to.handles({speed.value});
            })));
  EXPECT_EQ(
      heard[1].second,
      text_of(written([&](ManagementWriter to) { to.handle(number), to.handles({hail.value}); })));
  heard.clear();
  warden.send("HLAfederate.HLArequest.HLArequestSubscriptions", about);
  ASSERT_EQ(heard.size(), 1u) << "to the other report nobody subscribes";
  EXPECT_EQ(heard[0].second, text_of(written([&](ManagementWriter to) {
              to.handle(number), to.count(1), to.handle(ferry.value), to.count(0),
                  to.handles({position.value});
            })));
  heard.clear();
  warden.send("HLAfederation.HLArequest.HLArequestSynchronizationPoints", {});
  ASSERT_EQ(heard.size(), 1u);
  const std::vector<std::byte> parameters = bytes_of(heard[0].second);
  const std::vector<std::byte> labels = bytes_of(ManagementReader(parameters).text());
  EXPECT_EQ(ManagementReader(labels).text(), "anchored");
}

TEST(ManagementObjectModel, AutoProvideAsksOwnersWhenSomebodyDiscovers) {
  struct Owner : Recorder {
    int asked = 0;
    void provide_attribute_value_update(ObjectHandle, AttributeSet, Bytes) override { ++asked; }
  } owner;
  Bare bare;
  bare.execution.connect(1);
  Ambassador ambassador(harbour(), owner);
  ambassador.join("rink", "owner", "tester");
  const auto tick = [&] {
    bare.execution.receive(1, ambassador.outgoing());
    ambassador.clear_outgoing();
    bare.tick();
    EXPECT_TRUE(ambassador.receive(bare.sent[1]));
    bare.sent[1].clear();
  };
  tick();
  ambassador.publish_object_class_attributes(vessel, AttributeSet{speed});
  ambassador.register_object_instance(vessel);
  tick(), tick();
  EXPECT_EQ(owner.asked, 0) << "at first it is off";
  bare.witness.publish_interaction_class(
      manager_interaction("HLAfederation.HLAadjust.HLAsetSwitches"));
  bare.witness.send_interaction(manager_interaction("HLAfederation.HLAadjust.HLAsetSwitches"),
                                written([](ManagementWriter to) { to.count(1); }), {});
  ambassador.register_object_instance(vessel);
  tick(), tick(), tick();
  EXPECT_EQ(owner.asked, 1);
}

}  // namespace
}  // namespace rink::rti::testing
