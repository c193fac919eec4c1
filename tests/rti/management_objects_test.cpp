// The management object model as object classes: found by subscribing, told when asked, when due
// and when it changes, and nothing at all while nobody subscribes.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "rti/management/management_values.h"
#include "tests/rti/bare.h"
#include "tests/rti/errors.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

const ObjectClassHandle federate_class =
    *harbour().object_class("HLAobjectRoot.HLAmanager.HLAfederate");
const ObjectClassHandle federation_class =
    *harbour().object_class("HLAobjectRoot.HLAmanager.HLAfederation");

InteractionClassHandle manager_interaction(const std::string& name) {
  return *harbour().interaction_class("HLAinteractionRoot.HLAmanager." + name);
}

/// Subscribes to all of the management object model, and reads what it hears.
class Warden {
 public:
  explicit Warden(Rig& rig) : rig_(rig), station_(rig.join("warden")) {
    station_.ambassador.subscribe_object_class_attributes(federate_class,
                                                          harbour().attributes(federate_class));
    station_.ambassador.subscribe_object_class_attributes(federation_class,
                                                          harbour().attributes(federation_class));
    rig.settle();
  }
  Ambassador& ambassador() { return station_.ambassador; }
  Recorder& heard() { return station_.heard; }
  /// The object of the federate of that name; none if there is none.
  ObjectHandle object_of(const std::string& name) const {
    for (const auto& [object, known] : station_.heard.objects)
      if (known.object_class == federate_class &&
          text(ObjectHandle{object}, "HLAfederateName") == name)
        return {object};
    return {};
  }
  ObjectHandle federation() const {
    for (const auto& [object, known] : station_.heard.objects)
      if (known.object_class == federation_class) return {object};
    return {};
  }
  std::int32_t count(const std::string& federate, const char* attribute) const {
    return reader(object_of(federate), attribute).count();
  }
  double time(const std::string& federate, const char* attribute) const {
    return reader(object_of(federate), attribute).time();
  }
  std::string text(ObjectHandle object, const char* attribute) const {
    return std::string(reader(object, attribute).text());
  }
  ManagementReader reader(ObjectHandle object, const char* attribute) const {
    static const std::vector<std::byte> nothing;
    const auto known = station_.heard.objects.find(object.value);
    if (known == station_.heard.objects.end()) return ManagementReader(nothing);
    const auto value = known->second.values.find(
        harbour().attribute(known->second.object_class, attribute)->value);
    return ManagementReader(value == known->second.values.end() ? nothing : value->second);
  }
  /// Asks for the current values of all that it knows.
  void ask() {
    station_.ambassador.request_attribute_value_update(federate_class,
                                                       harbour().attributes(federate_class));
    rig_.settle();
  }
  void send(const std::string& name, const std::vector<std::byte>& parameters) {
    station_.ambassador.publish_interaction_class(manager_interaction(name));
    station_.ambassador.send_interaction(manager_interaction(name), parameters, {});
    rig_.settle();
  }

 private:
  Rig& rig_;
  Station& station_;
};

std::vector<std::byte> written(auto write) {
  std::vector<std::byte> bytes;
  write(ManagementWriter(bytes));
  return bytes;
}

std::vector<std::byte> timing(FederateHandle federate, std::uint64_t period) {
  return written([&](ManagementWriter to) { to.handle(federate.value), to.count(period); });
}

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

TEST(ManagementObjectModel, IsTheRtisToSpeakOf) {
  Rig rig(Carrier::in_process);
  Warden warden(rig);
  EXPECT_EQ(error_thrown_by([&] {
              warden.ambassador().publish_object_class_attributes(federate_class, AttributeSet(1));
            }),
            HlaError::unauthorized);
  EXPECT_EQ(error_thrown_by([&] {
              warden.ambassador().publish_interaction_class(
                  manager_interaction("HLAfederate.HLAreport.HLAreportObjectClassPublication"));
            }),
            HlaError::unauthorized);
  EXPECT_EQ(error_thrown_by([&] { warden.ambassador().register_object_instance(federate_class); }),
            HlaError::object_class_not_published);
  EXPECT_EQ(error_thrown_by([&] {
              warden.ambassador().attribute_ownership_acquisition(warden.object_of("warden"),
                                                                  AttributeSet(1));
            }),
            HlaError::object_class_not_published);
  warden.ambassador().query_attribute_ownership(warden.object_of("warden"), AttributeHandle{0});
  rig.settle();
  EXPECT_TRUE(warden.heard().lost.empty());
}

TEST(ManagementObjectModel, StrangersWhoForgeItAreDroppedAndNobodyElseNotices) {
  const auto drop_of = [](auto message) {
    Bare bare;
    bare.execution.connect(1);
    bare.execution.receive(1, frame_of(join_of("stranger")));
    bare.tick();
    bare.execution.receive(1,
                           frame_of(PublishInteractionClassMessage{
                               static_cast<std::uint16_t>(
                                   manager_interaction("HLAfederate.HLAadjust.HLAsetTiming").value),
                               1}));
    bare.execution.receive(1, frame_of(message));
    bare.tick();
    EXPECT_TRUE(bare.witness.is_joined());
    const auto& drops = bare.execution.counters().drops;
    for (std::size_t i = 0; i < drops.size(); ++i)
      if (drops[i] != 0) return std::string(to_string(static_cast<Violation>(i)));
    return std::string("nothing");
  };
  const auto set_timing = [](Bytes parameters) {
    return InteractionMessage{
        static_cast<std::uint16_t>(manager_interaction("HLAfederate.HLAadjust.HLAsetTiming").value),
        FederateHandle::none,
        {},
        parameters};
  };
  const std::vector<std::byte> good = timing({1}, 5), nobody = timing({99}, 5),
                               backwards = timing({1}, 5), cut = values_of(1);
  EXPECT_EQ(drop_of(PublishObjectClassMessage{static_cast<std::uint16_t>(federate_class.value), 1}),
            "not owned");
  EXPECT_EQ(drop_of(PublishInteractionClassMessage{
                static_cast<std::uint16_t>(manager_interaction("HLAfederate.HLAreport").value), 1}),
            "not owned");
  EXPECT_EQ(drop_of(set_timing(good)), "nothing");
  EXPECT_EQ(drop_of(set_timing(nobody)), "malformed");
  EXPECT_EQ(drop_of(set_timing(cut)), "malformed");
}

TEST(ManagementObjectModel, NoFederatesModelRedefinesIt) {
  const auto complaint = [](const std::string& xml) {
    try {
      Fom::parse(xml, "own.xml");
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(complaint("<objectModel><objects><objectClass><name>HLAobjectRoot</"
                      "name>\n<objectClass><name>HLAmanager</name></objectClass></objectClass></"
                      "objects></objectModel>"),
            "own.xml:2: <objectClass> 'HLAmanager': names that begin with HLA are the standard's");
  EXPECT_EQ(
      complaint(
          "<objectModel><objects/><interactions><interactionClass><name>HLAinteractionRoot</"
          "name>\n<interactionClass><name>HLAmanager</name></interactionClass></interactionClass>"
          "</interactions></objectModel>"),
      "own.xml:2: <interactionClass> 'HLAmanager': names that begin with HLA are the standard's");
}

TEST(ManagementObjectModel, StandsBehindAModelsOwnClassesAndIsNoPartOfItsHash) {
  EXPECT_FALSE(harbour().is_management(ferry));
  EXPECT_TRUE(harbour().is_management(federate_class));
  const Fom bare = Fom::parse(
      "<objectModel><objects><objectClass><name>Root</name></objectClass></objects></objectModel>",
      "bare.xml");
  EXPECT_EQ(bare.object_class("Root"), ObjectClassHandle{0});
  EXPECT_TRUE(bare.object_class("HLAobjectRoot.HLAmanager.HLAfederate"));
  EXPECT_TRUE(
      bare.interaction_class("HLAinteractionRoot.HLAmanager.HLAfederate.HLAadjust.HLAsetTiming"));
}

}  // namespace
}  // namespace rink::rti::testing
