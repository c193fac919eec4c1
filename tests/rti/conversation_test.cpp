// Two federates and the RTI talk, the same way over either transport.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/rti/rig.h"

#include "rti/wire/frame.h"
#include "rti/wire/message.h"

namespace rink::rti::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::Pair;

class Conversation : public ::testing::TestWithParam<Carrier> {
 protected:
  Rig rig{GetParam()};
  const AttributeSet all{position, speed};

  Station& publisher(const std::string& name) {
    Station& station = rig.join(name);
    station.ambassador.publish_object_class_attributes(vessel, all);
    station.ambassador.publish_object_class_attributes(ferry,
                                                       AttributeSet{position, speed, destination});
    station.ambassador.publish_interaction_class(hail);
    station.ambassador.publish_interaction_class(mayday);
    return station;
  }
  Station& subscriber(const std::string& name) {
    Station& station = rig.join(name);
    station.ambassador.subscribe_object_class_attributes(vessel, all);
    rig.settle();
    return station;
  }
};

TEST_P(Conversation, AFederateJoinsAndIsGivenAHandle) {
  Station& pilot = rig.join("pilot");
  EXPECT_TRUE(pilot.ambassador.is_joined());
  EXPECT_TRUE(pilot.ambassador.federate());
  EXPECT_THAT(pilot.heard.log, ElementsAre("joined"));
  EXPECT_EQ(rig.execution().federate_count(), 1u);
}

TEST_P(Conversation, AnUpdateIsReflectedWithItsStampToSubscribersAndNeverToItsSender) {
  Station &pilot = publisher("pilot"), &coast = subscriber("coast");
  pilot.ambassador.subscribe_object_class_attributes(vessel, all);
  const ObjectHandle object = pilot.ambassador.register_object_instance(vessel, "Aurora");
  const auto values = values_of(1.0f, 2.0f, 3.0f);
  pilot.ambassador.update_attribute_values(object, all, values, {7.5, 99});
  rig.settle();
  ASSERT_EQ(coast.heard.objects.count(object.value), 1u);
  const Recorder::Known& known = coast.heard.objects[object.value];
  EXPECT_EQ(known.name, "Aurora");
  EXPECT_EQ(known.object_class, vessel);
  EXPECT_EQ(known.values.at(position.value), values_of(1.0f, 2.0f));
  EXPECT_EQ(known.values.at(speed.value), values_of(3.0f));
  EXPECT_EQ(known.stamp, (Stamp{7.5, 99}));
  EXPECT_EQ(known.updates, 1);
  EXPECT_THAT(pilot.heard.objects, IsEmpty());
}

TEST_P(Conversation, ASubscriberHearsOnlyOfTheAttributesItNamed) {
  Station &pilot = publisher("pilot"), &coast = rig.join("coast");
  coast.ambassador.subscribe_object_class_attributes(vessel, AttributeSet{speed});
  const ObjectHandle object = pilot.ambassador.register_object_instance(vessel);
  rig.settle();
  for (int i = 0; i < 3; ++i) {
    pilot.ambassador.update_attribute_values(object, all,
                                             values_of(1.0f, 2.0f, static_cast<float>(i)), {});
    pilot.ambassador.update_attribute_values(object, AttributeSet{position}, values_of(1.0f, 2.0f),
                                             {});
    rig.settle();
  }
  EXPECT_EQ(coast.heard.objects[object.value].values.count(position.value), 0u);
  EXPECT_EQ(coast.heard.objects[object.value].values.at(speed.value), values_of(2.0f));
  EXPECT_EQ(coast.heard.objects[object.value].updates, 3);
}

TEST_P(Conversation, SubscribingAClassBringsItsSubclassesWithWhatTheyInherit) {
  Station &pilot = publisher("pilot"), &coast = subscriber("coast");
  const ObjectHandle object = pilot.ambassador.register_object_instance(ferry, "Princess");
  auto values = values_of(1.0f, 2.0f, 3.0f);
  const auto town = varying("Bergen");
  values.insert(values.end(), town.begin(), town.end());
  pilot.ambassador.update_attribute_values(object, AttributeSet{position, speed, destination},
                                           values, {});
  rig.settle();
  EXPECT_EQ(coast.heard.objects[object.value].object_class, ferry);
  EXPECT_EQ(coast.heard.objects[object.value].values.count(destination.value), 0u);
  coast.ambassador.subscribe_object_class_attributes(ferry, AttributeSet{destination});
  rig.settle();
  EXPECT_EQ(coast.heard.objects[object.value].values.at(destination.value), town);
  pilot.ambassador.update_attribute_values(object, AttributeSet{destination}, varying("Oslo"), {});
  rig.settle();
  EXPECT_EQ(coast.heard.objects[object.value].values.at(destination.value), varying("Oslo"));
  EXPECT_EQ(coast.heard.discoveries[object.value], 1);
}

TEST_P(Conversation, ALateJoinerGetsTheCurrentStateExactlyOnce) {
  Station& pilot = publisher("pilot");
  const ObjectHandle object = pilot.ambassador.register_object_instance(vessel, "Aurora");
  for (int i = 0; i < 5; ++i) {
    pilot.ambassador.update_attribute_values(object, AttributeSet{position},
                                             values_of(static_cast<float>(i), 0.0f), {});
    rig.settle();
  }
  pilot.ambassador.update_attribute_values(object, AttributeSet{speed}, values_of(9.0f), {});
  rig.settle();
  Station& coast = subscriber("coast");
  EXPECT_EQ(coast.heard.objects[object.value].updates, 1);
  EXPECT_EQ(coast.heard.objects[object.value].values.at(position.value), values_of(4.0f, 0.0f));
  EXPECT_EQ(coast.heard.objects[object.value].values.at(speed.value), values_of(9.0f));
  rig.settle();
  EXPECT_EQ(coast.heard.objects[object.value].updates, 1);
}

TEST_P(Conversation, UpdatesOfOneObjectArriveInTheOrderOfTheirSending) {
  Station &pilot = publisher("pilot"), &coast = subscriber("coast");
  const ObjectHandle a = pilot.ambassador.register_object_instance(vessel),
                     b = pilot.ambassador.register_object_instance(vessel);
  rig.settle();
  pilot.ambassador.update_attribute_values(a, AttributeSet{speed}, values_of(1.0f), {});
  pilot.ambassador.update_attribute_values(b, all, values_of(0.0f, 0.0f, 1.0f), {});
  pilot.ambassador.update_attribute_values(b, AttributeSet{speed}, values_of(2.0f), {});
  pilot.ambassador.update_attribute_values(a, all, values_of(0.0f, 0.0f, 2.0f), {});
  pilot.ambassador.update_attribute_values(a, AttributeSet{speed}, values_of(3.0f), {});
  rig.settle();
  EXPECT_EQ(coast.heard.objects[a.value].values.at(speed.value), values_of(3.0f));
  EXPECT_EQ(coast.heard.objects[b.value].values.at(speed.value), values_of(2.0f));
  EXPECT_EQ(coast.heard.objects[a.value].updates, 3);
}

TEST_P(Conversation, AnObjectIsRemovedForThoseWhoKnewIt) {
  Station &pilot = publisher("pilot"), &coast = subscriber("coast");
  const ObjectHandle object = pilot.ambassador.register_object_instance(vessel);
  pilot.ambassador.update_attribute_values(object, all, values_of(1.0f, 2.0f, 3.0f), {});
  rig.settle();
  ASSERT_EQ(coast.heard.objects.size(), 1u);
  pilot.ambassador.update_attribute_values(object, all, values_of(4.0f, 5.0f, 6.0f), {});
  pilot.ambassador.delete_object_instance(object);
  const ObjectHandle other = pilot.ambassador.register_object_instance(vessel);
  pilot.ambassador.update_attribute_values(other, all, values_of(7.0f, 8.0f, 9.0f), {});
  rig.settle();
  EXPECT_EQ(coast.heard.objects.count(object.value), 0u);
  EXPECT_EQ(coast.heard.objects.count(other.value), 1u);
  EXPECT_TRUE(coast.ambassador.is_joined());
}

TEST_P(Conversation, InteractionsReachSubscribersOfTheirClassOrAnAncestor) {
  Station &pilot = publisher("pilot"), &coast = rig.join("coast"), &deaf = rig.join("deaf");
  coast.ambassador.subscribe_interaction_class(hail);
  pilot.ambassador.subscribe_interaction_class(hail);
  rig.settle();
  pilot.ambassador.send_interaction(mayday, bytes_of("help"), {});
  pilot.ambassador.send_interaction(hail, bytes_of("ahoy"), {});
  rig.settle();
  EXPECT_THAT(coast.heard.interactions,
              ElementsAre(Pair(mayday.value, "help"), Pair(hail.value, "ahoy")));
  EXPECT_THAT(deaf.heard.interactions, IsEmpty());
  EXPECT_THAT(pilot.heard.interactions, IsEmpty());
}

TEST_P(Conversation, ADirectedInteractionReachesItsReceiverOnly) {
  Station &pilot = publisher("pilot"), &coast = rig.join("coast"), &other = rig.join("other");
  coast.ambassador.subscribe_interaction_class(hail);
  other.ambassador.subscribe_interaction_class(hail);
  rig.settle();
  pilot.ambassador.send_directed_interaction(hail, other.ambassador.federate(), bytes_of("you"),
                                             {});
  rig.settle();
  EXPECT_THAT(coast.heard.interactions, IsEmpty());
  EXPECT_THAT(other.heard.interactions, ElementsAre(Pair(hail.value, "you")));
}

TEST_P(Conversation, ABarrierOpensWhenTheLastHasComeOrGone) {
  Station &a = rig.join("a"), &b = rig.join("b"), &c = rig.join("c");
  a.ambassador.register_synchronization_point("start");
  rig.settle();
  Station& late = rig.join("late");
  for (Station* each : {&a, &b, &c}) EXPECT_THAT(each->heard.log, Contains("announced start"));
  EXPECT_THAT(late.heard.log, ElementsAre("joined", "announced start"))
      << "a point without a set is for all, late ones too";
  a.ambassador.synchronization_point_achieved("start");
  b.ambassador.synchronization_point_achieved("start");
  rig.settle();
  EXPECT_THAT(a.heard.log, Not(Contains("synchronized start")));
  c.ambassador.resign();
  rig.settle();
  EXPECT_THAT(a.heard.log, Not(Contains("synchronized start")));
  late.ambassador.synchronization_point_achieved("start");
  rig.settle();
  for (Station* each : {&a, &b, &late})
    EXPECT_THAT(each->heard.log, Contains("synchronized start"));
}

TEST_P(Conversation, WatchersAreToldWhoIsThereWhoComesAndHowTheyGo) {
  Station &a = rig.join("a"), &b = rig.join("b");
  a.ambassador.watch_federates();
  rig.settle();
  EXPECT_EQ(a.heard.federates.size(), 2u);
  Station& c = rig.join("c");
  EXPECT_EQ(a.heard.federates.at(c.ambassador.federate().value), "c");
  b.ambassador.resign();
  rig.settle();
  c.link->close();
  rig.settle();
  EXPECT_THAT(a.heard.log, ElementsAre("joined", "b resigned", "c lost"));
  EXPECT_EQ(a.heard.federates.size(), 1u);
}

TEST_P(Conversation, AResignedFederatesObjectsAreRemovedAndItsNameIsFree) {
  Station &pilot = publisher("pilot"), &coast = subscriber("coast");
  const ObjectHandle object = pilot.ambassador.register_object_instance(vessel);
  rig.settle();
  ASSERT_EQ(coast.heard.objects.size(), 1u);
  pilot.ambassador.resign();
  rig.settle();
  EXPECT_THAT(coast.heard.objects, IsEmpty());
  Station& again = publisher("pilot");
  EXPECT_TRUE(again.ambassador.is_joined());
  EXPECT_NE(again.ambassador.register_object_instance(vessel), object)
      << "handles that have been seen are not used again";
}

TEST_P(Conversation, UnsubscribingEndsScopeAndSubscribingAgainRenewsTheState) {
  Station &pilot = publisher("pilot"), &coast = subscriber("coast");
  const ObjectHandle object = pilot.ambassador.register_object_instance(vessel);
  pilot.ambassador.update_attribute_values(object, all, values_of(1.0f, 2.0f, 3.0f), {});
  rig.settle();
  coast.ambassador.unsubscribe_object_class(vessel);
  rig.settle();
  EXPECT_FALSE(coast.heard.objects[object.value].is_in_scope);
  pilot.ambassador.update_attribute_values(object, all, values_of(4.0f, 5.0f, 6.0f), {});
  rig.settle();
  EXPECT_EQ(coast.heard.objects[object.value].updates, 1);
  coast.ambassador.subscribe_object_class_attributes(vessel, all);
  rig.settle();
  EXPECT_TRUE(coast.heard.objects[object.value].is_in_scope);
  EXPECT_EQ(coast.heard.objects[object.value].updates, 2);
  EXPECT_EQ(coast.heard.objects[object.value].values.at(speed.value), values_of(6.0f));
  EXPECT_EQ(coast.heard.discoveries[object.value], 1);
}

TEST_P(Conversation, ThousandsOfUpdatesTravelAsOneBlockOfNineBytesEach) {
  Station &pilot = publisher("pilot"), &coast = rig.join("coast");
  coast.ambassador.subscribe_object_class_attributes(vessel, AttributeSet{position});
  std::vector<ObjectHandle> fleet;
  for (int i = 0; i < 8000; ++i) fleet.push_back(pilot.ambassador.register_object_instance(vessel));
  rig.settle();
  ASSERT_EQ(coast.heard.objects.size(), fleet.size());
  const std::uint64_t before = coast.ambassador.counters().bytes_received,
                      frames = coast.ambassador.counters().frames_received;
  for (const ObjectHandle object : fleet)
    pilot.ambassador.update_attribute_values(object, AttributeSet{position}, values_of(1.0f, 2.0f),
                                             {1.0, 2});
  EXPECT_GT(pilot.ambassador.outgoing().size(), frame_max_to_rti)
      << "so it takes two frames upwards";
  rig.settle();
  const std::uint64_t received = coast.ambassador.counters().bytes_received - before;
  const std::uint64_t down_frames = coast.ambassador.counters().frames_received - frames;
  // Frame's length, stamp, the block's kind, class and attributes, its end; a second byte for the
  // first handle's step, which is not from its neighbour.
  EXPECT_LE(received, 8000 * 9 + down_frames * (4 + StampMessage::size_max + 3 + 1 + 1));
  EXPECT_GE(received, 8000u * 9u);
  EXPECT_EQ(coast.ambassador.counters().updates_reflected, 8000u);
}

INSTANTIATE_TEST_SUITE_P(Over, Conversation,
                         ::testing::Values(Carrier::in_process, Carrier::tcp,
                                           Carrier::virtual_network),
                         [](const auto& carrier) { return name_of(carrier.param); });

}  // namespace
}  // namespace rink::rti::testing
