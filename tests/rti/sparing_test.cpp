// What nobody hears is not sent, and nobody hears the difference: the same random federation twice,
// once with one more federate that listens to everything, so that nothing is spared.
#include <gtest/gtest.h>

#include "tests/rti/scenes/sailors.h"

namespace rink::rti::testing {
namespace {

/// What a federate holds now, of objects in its scope.
using HeldState = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::byte>>;
HeldState state_of(const Historian& heard) {
  HeldState state;
  for (const auto& [object, known] : heard.objects)
    if (known.is_in_scope)
      for (const auto& [attribute, value] : known.values) state[{object, attribute}] = value;
  return state;
}

constexpr std::size_t sailor_count = 5;

TEST(Sparing, NobodyHearsTheDifferenceOverRandomDeclarations) {
  std::uint64_t updates = 0, interactions = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Weather weather(seed);
    // One more sailor, idle in the first sea, so that both have the same handles.
    Sea spared(sailor_count + 1, false), unspared(sailor_count, true);
    for (int step = 0; step < 300; ++step) {
      const auto act = weather.draw(sailor_count, true);
      for (Sea* sea : {&spared, &unspared}) {
        act(*sea);
        sea->settle();
      }
      for (std::size_t i = 0; i < sailor_count; ++i) {
        const Historian &a = *spared.all[i].heard, &b = *unspared.all[i].heard;
        ASSERT_EQ(a.history, b.history) << "sailor " << i << ", step " << step;
        ASSERT_EQ(state_of(a), state_of(b)) << "sailor " << i << ", step " << step;
        ASSERT_EQ(a.interactions, b.interactions) << "sailor " << i << ", step " << step;
        ASSERT_EQ(a.discoveries, b.discoveries);
        ASSERT_EQ(a.ownership, b.ownership);
      }
    }
    EXPECT_EQ(spared.violations(), 0u);
    EXPECT_EQ(unspared.updates_spared() + unspared.interactions_spared(), 0u);
    updates += spared.updates_spared();
    interactions += spared.interactions_spared();
  }
  EXPECT_GT(updates, 500u);
  EXPECT_GT(interactions, 50u);
}

/// Every owner says anew all that it owns, so that the histories tell what each hears.
void ask_all(Sea& sea, float value) {
  for (Sailor& sailor : sea.all) sailor.heard->history.clear();
  for (Sailor& sailor : sea.all)
    for (std::uint32_t i = 0; i < sailor.objects.size(); ++i)
      Weather::update(sailor, *sailor.ambassador, i, harbour().attributes(ferry), value);
  sea.settle();
}

/// Updates cross subscriptions on their way: what is heard meanwhile may differ, what is known in
/// the end, of all that is heard then, may not.
TEST(Sparing, ARaceOfSubscriptionsAndUpdatesEndsInTheSameState) {
  std::uint64_t updates = 0, compared = 0;
  for (unsigned seed = 101; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Weather weather(seed);
    Sea spared(sailor_count + 1, false), unspared(sailor_count, true);
    for (int step = 0; step < 60; ++step) {
      const std::uint32_t acts = 1 + weather.below(6);
      for (std::uint32_t act = 0; act < acts; ++act) {
        const auto drawn = weather.draw(sailor_count, false);
        const bool is_said = weather.below(2) == 0;
        for (Sea* sea : {&spared, &unspared}) {
          drawn(*sea);
          if (is_said) sea->round();
        }
      }
      std::array<std::deque<HeldState>, 2> states;
      for (const std::size_t k : {0u, 1u}) {
        Sea& sea = k == 0 ? spared : unspared;
        sea.settle();
        for (const Sailor& sailor : sea.all) states[k].push_back(state_of(*sailor.heard));
        ask_all(sea, static_cast<float>(-step));
      }
      for (std::size_t i = 0; i < sailor_count; ++i) {
        ASSERT_EQ(spared.all[i].heard->history, unspared.all[i].heard->history)
            << "sailor " << i << ", step " << step;
        for (const auto& [heard, values] : unspared.all[i].heard->history) {
          ASSERT_EQ(states[0][i][heard], states[1][i][heard])
              << "sailor " << i << ", object " << heard.first << ", attribute " << heard.second
              << ", step " << step;
          ++compared;
        }
      }
    }
    EXPECT_EQ(spared.violations(), 0u);
    updates += spared.updates_spared();
  }
  EXPECT_GT(updates, 5000u);
  EXPECT_GT(compared, 5000u);
}

TEST(Sparing, WhatNobodyHeardIsToldOnceAsTheNewestStateToWhoListensFirst) {
  Rig rig(Carrier::in_process);
  Station &pilot = rig.join("pilot"), &coast = rig.join("coast");
  Ambassador& ambassador = pilot.ambassador;
  ambassador.publish_object_class_attributes(vessel, motion);
  ambassador.publish_interaction_class(hail);
  rig.settle();
  const ObjectHandle fram = ambassador.register_object_instance(vessel, "Fram");
  for (int i = 0; i < 100; ++i) {
    ambassador.update_attribute_values(fram, AttributeSet{speed},
                                       testing::values_of(static_cast<float>(i)),
                                       {static_cast<double>(i), 7});
    ambassador.send_interaction(hail, bytes_of("is anybody there?"), {});
  }
  const std::uint64_t before = rig.execution().counters().updates_received;
  rig.settle();
  EXPECT_EQ(rig.execution().counters().updates_received, before);
  EXPECT_EQ(rig.execution().counters().interactions_received, 0u);
  EXPECT_EQ(ambassador.counters().updates_spared, 100u);
  EXPECT_EQ(ambassador.counters().interactions_spared, 100u);
  coast.ambassador.subscribe_object_class_attributes(vessel, motion);
  coast.ambassador.subscribe_interaction_class(hail);
  rig.settle();
  const Recorder::Known& known = coast.heard.objects.at(fram.value);
  EXPECT_EQ(known.updates, 1);
  EXPECT_EQ(known.values.at(speed.value), testing::values_of(99.0f));
  EXPECT_EQ(known.stamp, (Stamp{99.0, 7}));
  EXPECT_TRUE(coast.heard.interactions.empty());
  ambassador.send_interaction(hail, bytes_of("ahoy"), {});
  ambassador.update_attribute_values(fram, AttributeSet{speed}, testing::values_of(1.0f),
                                     {100.0, 7});
  rig.settle();
  EXPECT_EQ(known.values.at(speed.value), testing::values_of(1.0f));
  EXPECT_EQ(coast.heard.interactions.size(), 1u);
  EXPECT_EQ(ambassador.counters().updates_spared, 100u);
}

TEST(Sparing, TheDeathOfTheLastListenerStopsUpdatesAndAnotherOneStartsThemAgain) {
  Rig rig(Carrier::in_process);
  Station &pilot = rig.join("pilot"), &first = rig.join("first");
  pilot.ambassador.publish_object_class_attributes(vessel, motion);
  first.ambassador.subscribe_object_class_attributes(vessel, AttributeSet{speed});
  rig.settle();
  const ObjectHandle fram = pilot.ambassador.register_object_instance(vessel);
  const auto go = [&](float knots) {
    pilot.ambassador.update_attribute_values(fram, AttributeSet{speed}, testing::values_of(knots),
                                             {});
    rig.settle();
  };
  go(1.0f);
  EXPECT_EQ(pilot.ambassador.counters().updates_spared, 0u);
  first.link->close();
  rig.settle();
  go(2.0f);
  go(3.0f);
  EXPECT_EQ(pilot.ambassador.counters().updates_spared, 2u);
  Station& second = rig.join("second");
  second.ambassador.subscribe_object_class_attributes(vessel, AttributeSet{speed});
  rig.settle();
  EXPECT_EQ(second.heard.objects.at(fram.value).values.at(speed.value), testing::values_of(3.0f));
  EXPECT_EQ(second.heard.objects.at(fram.value).updates, 1)
      << "nothing that was out of date was told first";
}

TEST(Sparing, WhatOutlivesItsFederateIsNeverKeptBack) {
  Rig rig(Carrier::in_process);
  Station& pilot = rig.join("pilot");
  pilot.ambassador.publish_object_class_attributes(vessel, motion);
  rig.settle();
  const ObjectHandle fram = pilot.ambassador.register_object_instance(vessel);
  pilot.ambassador.update_attribute_values(fram, AttributeSet{speed}, testing::values_of(1.0f), {});
  EXPECT_EQ(pilot.ambassador.counters().updates_spared, 1u);
  pilot.ambassador.set_automatic_resign_directive(ResignAction::unconditionally_divest_attributes);
  pilot.ambassador.update_attribute_values(fram, AttributeSet{position},
                                           testing::values_of(2.0f, 3.0f), {});
  EXPECT_EQ(pilot.ambassador.counters().updates_spared, 1u);
  rig.settle();
  EXPECT_EQ(rig.execution().counters().updates_received, 2u);
  pilot.ambassador.set_automatic_resign_directive(ResignAction::delete_objects);
  pilot.ambassador.update_attribute_values(fram, AttributeSet{speed}, testing::values_of(4.0f), {});
  EXPECT_EQ(pilot.ambassador.counters().updates_spared, 2u);
  pilot.ambassador.unconditional_attribute_ownership_divestiture(fram, AttributeSet{position});
  rig.settle();
  EXPECT_EQ(rig.execution().counters().updates_received, 3u) << "what may be divided from now on";
}

TEST(Sparing, WhoseCallbacksAreDisabledSendsEverything) {
  Rig rig(Carrier::in_process);
  Station &pilot = rig.join("pilot"), &coast = rig.join("coast");
  pilot.ambassador.publish_object_class_attributes(vessel, motion);
  pilot.ambassador.publish_interaction_class(hail);
  rig.settle();
  const ObjectHandle fram = pilot.ambassador.register_object_instance(vessel);
  pilot.ambassador.update_attribute_values(fram, AttributeSet{speed}, testing::values_of(1.0f), {});
  pilot.ambassador.disable_callbacks();
  coast.ambassador.subscribe_object_class_attributes(vessel, motion);
  coast.ambassador.subscribe_interaction_class(hail);
  rig.settle();
  EXPECT_EQ(coast.heard.objects.at(fram.value).values.at(speed.value), testing::values_of(1.0f));
  pilot.ambassador.update_attribute_values(fram, AttributeSet{speed}, testing::values_of(2.0f), {});
  pilot.ambassador.send_interaction(hail, bytes_of("ahoy"), {});
  rig.settle();
  EXPECT_EQ(coast.heard.objects.at(fram.value).values.at(speed.value), testing::values_of(2.0f));
  EXPECT_EQ(coast.heard.interactions.size(), 1u);
}

TEST(Sparing, MessagesInTimeStampOrderAlwaysTravelAndTakeWhatWasKeptBackWithThem) {
  Rig rig(Carrier::in_process);
  Station &pilot = rig.join("pilot"), &coast = rig.join("coast");
  pilot.ambassador.publish_object_class_attributes(ferry, harbour().attributes(ferry));
  pilot.ambassador.enable_time_regulation(1.0);
  rig.settle();
  const ObjectHandle object = pilot.ambassador.register_object_instance(ferry);
  pilot.ambassador.update_attribute_values(object, AttributeSet{speed}, testing::values_of(1.0f),
                                           {});
  EXPECT_EQ(pilot.ambassador.counters().updates_spared, 1u);
  pilot.ambassador.update_attribute_values(object, AttributeSet{destination}, varying("Oslo"),
                                           LogicalTime(2.0));
  rig.settle();
  EXPECT_EQ(rig.execution().counters().updates_received, 1u) << "the speed";
  EXPECT_EQ(rig.execution().counters().timed_received, 1u);
  coast.ambassador.subscribe_object_class_attributes(ferry, harbour().attributes(ferry));
  rig.settle();
  EXPECT_EQ(coast.heard.objects.at(object.value).values.at(speed.value), testing::values_of(1.0f));
  EXPECT_EQ(coast.heard.objects.at(object.value).values.at(destination.value), varying("Oslo"));
}

}  // namespace
}  // namespace rink::rti::testing
