// What the standard says of names, local deletion, requests for updates and transportation,
// sentence by sentence (IEEE 1516.1-2010, clauses 4.9, 6.2 to 6.8, 6.16, 6.19, 6.23 to 6.30).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <initializer_list>

#include "tests/rti/company.h"

namespace rink::rti::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::string joined_by_commas(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& each : names) text += (text.empty() ? "" : ",") + each;
  return text;
}

/// Writes down answers.
struct Registrar : Recorder {
  std::vector<std::string> told;
  void object_instance_name_reservation_succeeded(std::string_view name) override {
    told.push_back("got " + std::string(name));
  }
  void object_instance_name_reservation_failed(std::string_view name) override {
    told.push_back("not " + std::string(name));
  }
  void multiple_object_instance_name_reservation_succeeded(
      const std::vector<std::string>& names) override {
    told.push_back("got all " + joined_by_commas(names));
  }
  void multiple_object_instance_name_reservation_failed(
      const std::vector<std::string>& names) override {
    told.push_back("not all " + joined_by_commas(names));
  }
  void provide_attribute_value_update(ObjectHandle object, AttributeSet set, Bytes tag) override {
    told.push_back("provide " + std::to_string(static_cast<std::uint32_t>(set.bits)) + " of " +
                   std::to_string(object.value) + " " + text_of(tag));
  }
  void confirm_attribute_transportation_type_change(ObjectHandle, AttributeSet set,
                                                    Transportation type) override {
    told.push_back("confirmed " + std::to_string(static_cast<std::uint32_t>(set.bits)) + " " +
                   std::string(Ambassador::get_transportation_type_name(type)));
  }
  void report_attribute_transportation_type(ObjectHandle, AttributeHandle attribute,
                                            Transportation type) override {
    told.push_back("attribute " + std::to_string(attribute.value) + " " +
                   std::string(Ambassador::get_transportation_type_name(type)));
  }
  void confirm_interaction_transportation_type_change(InteractionClassHandle each,
                                                      Transportation type) override {
    told.push_back("confirmed " + harbour().at(each).name + " " +
                   std::string(Ambassador::get_transportation_type_name(type)));
  }
  void report_interaction_transportation_type(FederateHandle federate, InteractionClassHandle each,
                                              Transportation type) override {
    told.push_back(std::to_string(federate.value) + " " + harbour().at(each).name + " " +
                   std::string(Ambassador::get_transportation_type_name(type)));
  }
};

/// Both publish vessels.
struct Port : Company<Registrar> {
  Port() {
    for (Ambassador* each : {&pilot, &coast}) each->publish_object_class_attributes(vessel, motion);
  }
};

// 6.2, 6.3
TEST(Conformance, ANameIsReservedByOneFederateUntilItIsReleased) {
  Port port;
  port.pilot.reserve_object_instance_name("Fram");
  EXPECT_THAT(port.told(port.pilot_heard), ElementsAre("got Fram"));
  port.coast.reserve_object_instance_name("Fram");
  EXPECT_THAT(port.told(port.coast_heard), ElementsAre("not Fram"));
  EXPECT_EQ(error_thrown_by([&] { port.coast.release_object_instance_name("Fram"); }),
            HlaError::object_instance_name_not_reserved);
  port.pilot.release_object_instance_name("Fram");
  port.settle();
  port.coast.reserve_object_instance_name("Fram");
  EXPECT_THAT(port.told(port.coast_heard), ElementsAre("got Fram"));
  EXPECT_EQ(port.dropped, 0u);
}

// 6.2
TEST(Conformance, ANameThatBeginsWithHlaOrIsEmptyIsIllegal) {
  Port port;
  EXPECT_EQ(error_thrown_by([&] { port.pilot.reserve_object_instance_name("HLAobject 3"); }),
            HlaError::illegal_name);
  EXPECT_EQ(error_thrown_by([&] { port.pilot.reserve_object_instance_name(""); }),
            HlaError::illegal_name);
  EXPECT_EQ(error_thrown_by([&] { port.pilot.register_object_instance(vessel, "HLAfram"); }),
            HlaError::illegal_name);
  EXPECT_EQ(error_thrown_by([&] { port.pilot.reserve_multiple_object_instance_names({}); }),
            HlaError::name_set_was_empty);
}

// 6.5, 6.6, 6.7
TEST(Conformance, ASetOfNamesIsReservedWholeOrNotAtAll) {
  Port port;
  const std::array<std::string_view, 2> pair{"Fram", "Maud"}, overlapping{"Gjoa", "Maud"},
      twice{"Tern", "Tern"};
  port.pilot.reserve_multiple_object_instance_names(pair);
  EXPECT_THAT(port.told(port.pilot_heard), ElementsAre("got all Fram,Maud"));
  port.coast.reserve_multiple_object_instance_names(overlapping);
  EXPECT_THAT(port.told(port.coast_heard), ElementsAre("not all Gjoa,Maud"));
  port.coast.reserve_object_instance_name("Gjoa");
  EXPECT_THAT(port.told(port.coast_heard), ElementsAre("got Gjoa"));
  port.coast.reserve_multiple_object_instance_names(twice);
  EXPECT_THAT(port.told(port.coast_heard), ElementsAre("not all Tern,Tern"));
  EXPECT_EQ(
      error_thrown_by([&] { port.pilot.release_multiple_object_instance_names(overlapping); }),
      HlaError::object_instance_name_not_reserved);
  port.pilot.release_multiple_object_instance_names(pair);
  port.settle();
  port.coast.reserve_multiple_object_instance_names(pair);
  EXPECT_THAT(port.told(port.coast_heard), ElementsAre("got all Fram,Maud"));
}

// 6.8, 10: Get Object Instance Handle and Name
TEST(Conformance, AnObjectIsFoundByItsNameAndEveryObjectHasAUniqueOne) {
  Port port;
  port.coast.subscribe_object_class_attributes(vessel, motion);
  port.pilot.reserve_object_instance_name("Fram");
  port.settle();
  const ObjectHandle fram = port.pilot.register_object_instance(vessel, "Fram"),
                     other = port.pilot.register_object_instance(vessel),
                     third = port.pilot.register_object_instance(vessel);
  port.settle();
  for (Ambassador* each : {&port.pilot, &port.coast}) {
    EXPECT_EQ(each->get_object_instance_handle("Fram"), fram);
    EXPECT_EQ(each->get_object_instance_name(fram), "Fram");
    EXPECT_NE(each->get_object_instance_name(other), each->get_object_instance_name(third));
    EXPECT_EQ(each->get_object_instance_handle(each->get_object_instance_name(other)), other);
    EXPECT_EQ(each->get_known_object_class_handle(fram), vessel);
    EXPECT_EQ(error_thrown_by([&] { each->get_object_instance_handle("Maud"); }),
              HlaError::object_instance_not_known);
    EXPECT_EQ(error_thrown_by([&] {
                each->get_object_instance_handle("HLAobject 0" + std::to_string(other.value));
              }),
              HlaError::object_instance_not_known);
    EXPECT_EQ(error_thrown_by([&] { each->get_object_instance_name({12345}); }),
              HlaError::object_instance_not_known);
  }
  EXPECT_EQ(port.pilot.get_object_instance_name(other), port.coast.get_object_instance_name(other));
  EXPECT_EQ(port.coast_heard.objects.at(other.value).name,
            port.coast.get_object_instance_name(other));
}

// 6.8
TEST(Conformance, NoTwoObjectsHaveOneName) {
  Port port;
  port.coast.subscribe_object_class_attributes(vessel, motion);
  port.pilot.subscribe_object_class_attributes(vessel, motion);
  port.settle();
  const ObjectHandle first = port.pilot.register_object_instance(vessel, "Fram");
  EXPECT_EQ(error_thrown_by([&] { port.pilot.register_object_instance(vessel, "Fram"); }),
            HlaError::object_instance_name_in_use);
  const ObjectHandle second =
      port.coast.register_object_instance(vessel, "Fram");  // it can't know yet
  EXPECT_THAT(port.told(port.coast_heard), ElementsAre("not Fram"));
  EXPECT_EQ(port.coast.get_object_instance_handle("Fram"), first);
  EXPECT_NE(port.pilot.get_object_instance_name(second), "Fram");
  EXPECT_EQ(port.pilot.get_object_instance_name(second),
            port.coast.get_object_instance_name(second));
  EXPECT_EQ(error_thrown_by([&] { port.coast.register_object_instance(vessel, "Fram"); }),
            HlaError::object_instance_name_in_use);
  port.pilot.reserve_object_instance_name("Maud");
  port.settle();
  port.coast.register_object_instance(vessel, "Maud");
  EXPECT_THAT(port.told(port.coast_heard), ElementsAre("not Maud"))
      << "another federate reserved it";
  port.coast.reserve_object_instance_name("Fram");
  EXPECT_THAT(port.told(port.coast_heard), ElementsAre("not Fram")) << "in use";
  EXPECT_EQ(port.pilot.get_object_instance_name(first), "Fram");
}

// 6.2, 6.14, 4.10
TEST(Conformance, ANameIsFreeAgainWhenItsObjectIsDeletedOrItsFederateHasLeft) {
  Port port;
  const ObjectHandle fram = port.pilot.register_object_instance(vessel, "Fram");
  port.pilot.register_object_instance(vessel, "Maud");
  port.pilot.reserve_object_instance_name("Gjoa");
  port.settle();
  port.pilot.delete_object_instance(fram);
  port.settle();
  port.coast.reserve_object_instance_name("Fram");
  EXPECT_THAT(port.told(port.coast_heard), ElementsAre("got Fram"));
  port.pilot.resign();
  port.settle();
  const std::array<std::string_view, 2> names{"Gjoa", "Maud"};
  port.coast.reserve_multiple_object_instance_names(names);
  EXPECT_THAT(port.told(port.coast_heard), ElementsAre("got all Gjoa,Maud"));
}

// 6.16
TEST(Conformance, AnObjectThatWasDeletedLocallyIsUnknownHereAndMayBeDiscoveredAgain) {
  Port port;
  const RegionHandle place = port.pilot.create_region(), view = port.coast.create_region();
  const auto look = [&](double x) {
    port.coast.set_region(view, {x, 0.0, x + 1.0, 1.0});
    port.coast.commit_region_modifications(view);
    port.settle();
  };
  port.pilot.set_region(place, {0.0, 0.0, 1.0, 1.0});
  port.pilot.commit_region_modifications(place);
  port.coast.subscribe_object_class_attributes(vessel, motion, view);
  look(0.0);
  const ObjectHandle fram = port.pilot.register_object_instance(vessel, "Fram");
  port.pilot.associate_regions_for_updates(fram, place);
  port.pilot.update_attribute_values(fram, AttributeSet{speed}, values_of(1.0f), {});
  port.settle();
  EXPECT_EQ(error_thrown_by([&] { port.pilot.local_delete_object_instance(fram); }),
            HlaError::federate_owns_attributes);
  port.pilot.unconditional_attribute_ownership_divestiture(fram, AttributeSet{position});
  port.settle();
  port.coast.attribute_ownership_acquisition(fram, AttributeSet{speed});
  EXPECT_EQ(error_thrown_by([&] { port.coast.local_delete_object_instance(fram); }),
            HlaError::ownership_acquisition_pending);
  port.coast.cancel_attribute_ownership_acquisition(fram, AttributeSet{speed});
  port.settle();
  port.coast.local_delete_object_instance(fram);
  port.coast_heard.objects.erase(fram.value);
  EXPECT_EQ(error_thrown_by([&] { port.coast.get_object_instance_handle("Fram"); }),
            HlaError::object_instance_not_known);
  EXPECT_EQ(error_thrown_by([&] { port.coast.local_delete_object_instance(fram); }),
            HlaError::object_instance_not_known);
  for (int i = 0; i < 3; ++i) {  // said while the RTI may not know yet
    port.pilot.update_attribute_values(fram, AttributeSet{speed}, values_of(2.0f), {});
    port.settle();
  }
  EXPECT_THAT(port.coast_heard.objects, IsEmpty());
  EXPECT_EQ(port.coast_heard.lost, "");
  look(5.0);
  look(0.0);
  EXPECT_EQ(port.coast_heard.discoveries.at(fram.value), 2);
  EXPECT_EQ(port.coast_heard.objects.at(fram.value).values.at(speed.value), values_of(2.0f));
  EXPECT_EQ(port.coast.get_object_instance_handle("Fram"), fram);
  port.coast.local_delete_object_instance(fram);
  port.pilot.unpublish_object_class(vessel);
  port.settle();
  EXPECT_EQ(port.coast_heard.lost, "");
}

// 6.14
TEST(Conformance, WhoDeletesAnObjectHearsNoMoreOfItWhateverWasUnderWay) {
  Port port;
  port.coast.subscribe_object_class_attributes(vessel, motion);
  port.settle();
  const ObjectHandle fram = port.pilot.register_object_instance(vessel);
  port.settle();
  port.pilot.unconditional_attribute_ownership_divestiture(
      fram, AttributeSet{privilege_to_delete_object});
  port.settle();
  port.coast.attribute_ownership_acquisition_if_available(fram,
                                                          AttributeSet{privilege_to_delete_object});
  port.settle();
  // The update is on its way to the one who deletes the object meanwhile.
  port.pilot.update_attribute_values(fram, AttributeSet{speed}, values_of(1.0f), {});
  port.execution.receive(0, port.pilot.outgoing());
  port.pilot.clear_outgoing();
  port.coast.delete_object_instance(fram);
  const std::vector<std::byte> deletion(port.coast.outgoing().begin(), port.coast.outgoing().end());
  port.coast.clear_outgoing();
  port.execution.match();
  port.settle();
  EXPECT_EQ(port.coast_heard.lost, "");
  port.execution.receive(1, deletion);
  port.settle();
  EXPECT_EQ(port.execution.object_count(), 0u);
  EXPECT_EQ(port.coast_heard.lost, "");
  EXPECT_EQ(port.pilot_heard.lost, "");
}

// 6.19, 6.20
TEST(Conformance, OwnersAreAskedForValuesByClassOrByObjectWithTheTagOfTheRequest) {
  Port port;
  port.coast.subscribe_object_class_attributes(vessel, motion);
  const ObjectHandle one = port.pilot.register_object_instance(vessel),
                     two = port.pilot.register_object_instance(vessel);
  port.coast.register_object_instance(vessel);
  port.settle();
  port.coast.request_attribute_value_update(vessel, AttributeSet{speed}, bytes_of("now"));
  EXPECT_THAT(port.told(port.pilot_heard),
              ElementsAre("provide 2 of " + std::to_string(one.value) + " now",
                          "provide 2 of " + std::to_string(two.value) + " now"));
  port.coast.request_attribute_value_update(two, motion);
  EXPECT_THAT(port.told(port.pilot_heard),
              ElementsAre("provide 3 of " + std::to_string(two.value) + " "));
  EXPECT_THAT(port.told(port.coast_heard), IsEmpty());
  EXPECT_EQ(error_thrown_by([&] {
              port.coast.request_attribute_value_update(vessel, AttributeSet{destination});
            }),
            HlaError::attribute_not_defined);
  EXPECT_EQ(error_thrown_by(
                [&] { port.coast.request_attribute_value_update(ObjectHandle{777}, motion); }),
            HlaError::object_instance_not_known);
}

// 6.23 to 6.26
TEST(Conformance, TheTransportationOfAttributesIsChangedByTheirOwnerConfirmedAndReported) {
  Port port;
  port.coast.subscribe_object_class_attributes(vessel, motion);
  const ObjectHandle fram = port.pilot.register_object_instance(vessel);
  port.settle();
  port.coast.query_attribute_transportation_type(fram, speed);
  EXPECT_THAT(port.told(port.coast_heard), ElementsAre("attribute 1 HLAreliable"));
  port.pilot.request_attribute_transportation_type_change(fram, AttributeSet{speed},
                                                          Transportation::best_effort);
  EXPECT_THAT(port.told(port.pilot_heard), ElementsAre("confirmed 2 HLAbestEffort"));
  port.coast.query_attribute_transportation_type(fram, speed);
  port.coast.query_attribute_transportation_type(fram, position);
  EXPECT_THAT(port.told(port.coast_heard),
              ElementsAre("attribute 1 HLAbestEffort", "attribute 0 HLAreliable"));
  EXPECT_EQ(error_thrown_by([&] {
              port.coast.request_attribute_transportation_type_change(fram, AttributeSet{speed},
                                                                      Transportation::reliable);
            }),
            HlaError::attribute_not_owned);
  port.pilot.update_attribute_values(fram, AttributeSet{speed}, values_of(3.0f), {});
  port.settle();
  EXPECT_EQ(port.coast_heard.objects.at(fram.value).values.at(speed.value), values_of(3.0f));
}

// 6.27 to 6.30
TEST(Conformance, TheTransportationOfInteractionsIsTheSendersOwn) {
  Port port;
  EXPECT_EQ(error_thrown_by([&] {
              port.pilot.request_interaction_transportation_type_change(
                  hail, Transportation::best_effort);
            }),
            HlaError::interaction_class_not_published);
  port.pilot.publish_interaction_class(hail);
  port.pilot.request_interaction_transportation_type_change(hail, Transportation::best_effort);
  EXPECT_THAT(port.told(port.pilot_heard), ElementsAre("confirmed Hail HLAbestEffort"));
  for (const Ambassador* each : {&port.pilot, &port.coast})
    port.coast.query_interaction_transportation_type(each->federate(), hail);
  EXPECT_THAT(port.told(port.coast_heard),
              ElementsAre("0 Hail HLAbestEffort", "1 Hail HLAreliable"));
}

// 6.12
TEST(Conformance, AnInteractionOfAClassThatIsNotPublishedIsRefusedBeforeItIsSent) {
  Port port;
  EXPECT_EQ(error_thrown_by([&] { port.pilot.send_interaction(hail, bytes_of("ahoy"), Stamp{}); }),
            HlaError::interaction_class_not_published);
  EXPECT_EQ(error_thrown_by(
                [&] { port.pilot.send_interaction(InteractionClassHandle{99}, {}, Stamp{}); }),
            HlaError::interaction_class_not_defined);
  port.settle();
  EXPECT_EQ(port.dropped, 0u);
}

// 4.9
TEST(Conformance, ARefusalAtTheJoinHasTheStandardsName) {
  Rig rig(Carrier::in_process);
  rig.join("one");
  EXPECT_EQ(error_of(*rig.join("one").heard.refusal), HlaError::federate_name_already_in_use);
  EXPECT_EQ(error_of(*rig.join("").heard.refusal), HlaError::illegal_name);
  Station& stray = rig.connect();
  stray.ambassador.join("nowhere", "stray", "tester");
  rig.settle();
  EXPECT_EQ(error_of(*stray.heard.refusal), HlaError::federation_execution_does_not_exist);
  const Fom other = Fom::parse(
      "<objectModel><objects><objectClass><name>Root</name></objectClass></objects></objectModel>",
      "other.xml");
  Station& stranger = rig.connect(other);
  stranger.ambassador.join("rink", "stranger", "tester");
  rig.settle();
  EXPECT_EQ(error_of(*stranger.heard.refusal), HlaError::inconsistent_fdd);
  EXPECT_EQ(error_of(Refusal::not_admitted), HlaError::unauthorized);
  EXPECT_EQ(error_of(Refusal::wrong_version), HlaError::rti_internal_error);
}

}  // namespace
}  // namespace rink::rti::testing
