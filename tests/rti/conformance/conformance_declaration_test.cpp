// What the standard says of declaration management and its advisories, sentence by sentence (IEEE
// 1516.1-2010, clauses 5, 6.19 to 6.22 and 10.27 to 10.34).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/rti/company.h"

namespace rink::rti::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Writes down its advisories alone.
struct Advised : Recorder {
  std::vector<std::string> told;
  std::map<std::uint32_t, AttributeSet> updates_on;  ///< by object
  void start_registration_for_object_class(ObjectClassHandle each) override {
    told.push_back("start " + harbour().at(each).name);
  }
  void stop_registration_for_object_class(ObjectClassHandle each) override {
    told.push_back("stop " + harbour().at(each).name);
  }
  void turn_interactions_on(InteractionClassHandle each) override {
    told.push_back("on " + harbour().at(each).name);
  }
  void turn_interactions_off(InteractionClassHandle each) override {
    told.push_back("off " + harbour().at(each).name);
  }
  void turn_updates_on_for_object_instance(ObjectHandle object, AttributeSet set) override {
    EXPECT_TRUE((updates_on[object.value] & set).is_empty()) << "on twice";
    updates_on[object.value] = updates_on[object.value] | set;
  }
  void turn_updates_off_for_object_instance(ObjectHandle object, AttributeSet set) override {
    EXPECT_TRUE(updates_on[object.value].includes(set)) << "off twice";
    updates_on[object.value] = updates_on[object.value].without(set);
  }
};

using AdvisedCompany = Company<Advised>;

// 5.10, 5.11
TEST(Conformance,
     RegistrationIsAdvisedWhileAnAttributeThatIsPublishedIsActivelySubscribedByAnother) {
  AdvisedCompany here;
  here.pilot.publish_object_class_attributes(vessel, AttributeSet{position});
  here.pilot.subscribe_object_class_attributes(vessel, motion);
  EXPECT_THAT(here.told(here.pilot_heard), IsEmpty()) << "its own subscription is none of another";
  here.coast.subscribe_object_class_attributes(vessel, AttributeSet{speed});
  EXPECT_THAT(here.told(here.pilot_heard), IsEmpty()) << "not what it publishes";
  here.coast.subscribe_object_class_attributes(vessel, motion);
  EXPECT_THAT(here.told(here.pilot_heard), ElementsAre("start Vessel"));
  here.coast.subscribe_object_class_attributes(vessel, AttributeSet{position});
  EXPECT_THAT(here.told(here.pilot_heard), IsEmpty()) << "told once";
  here.coast.unsubscribe_object_class(vessel);
  EXPECT_THAT(here.told(here.pilot_heard), ElementsAre("stop Vessel"));
}

// 5.10
TEST(Conformance, ASubscriptionToASuperclassCountsForItsSubclasses) {
  AdvisedCompany here;
  here.coast.subscribe_object_class_attributes(vessel, motion);
  here.settle();
  here.pilot.publish_object_class_attributes(ferry, AttributeSet{speed});
  EXPECT_THAT(here.told(here.pilot_heard), ElementsAre("start Ferry"));
  here.pilot.publish_object_class_attributes(ferry, AttributeSet{destination});
  EXPECT_THAT(here.told(here.pilot_heard), ElementsAre("stop Ferry"))
      << "which the superclass has not";
}

// 5.10, 5.12
TEST(Conformance, AFederateThatLeavesOrIsLostListensNoLonger) {
  AdvisedCompany here;
  Ambassador& third = here.join("third");
  here.pilot.publish_object_class_attributes(vessel, motion);
  here.pilot.publish_interaction_class(mayday);
  for (Ambassador* each : {&here.coast, &third}) {
    each->subscribe_object_class_attributes(vessel, motion);
    each->subscribe_interaction_class(hail);
  }
  EXPECT_THAT(here.told(here.pilot_heard), ElementsAre("start Vessel", "on Mayday"));
  here.coast.resign();
  EXPECT_THAT(here.told(here.pilot_heard), IsEmpty());
  here.execution.disconnect(2, "died");
  EXPECT_THAT(here.told(here.pilot_heard), ElementsAre("stop Vessel", "off Mayday"));
}

// 5.12, 5.13
TEST(Conformance, InteractionsAreTurnedOnWhileTheClassOrASuperclassIsActivelySubscribedByAnother) {
  AdvisedCompany here;
  here.pilot.publish_interaction_class(hail);
  here.pilot.publish_interaction_class(mayday);
  EXPECT_THAT(here.told(here.pilot_heard), IsEmpty());
  here.coast.subscribe_interaction_class(mayday);
  EXPECT_THAT(here.told(here.pilot_heard), ElementsAre("on Mayday"));
  here.coast.subscribe_interaction_class(hail);
  EXPECT_THAT(here.told(here.pilot_heard), ElementsAre("on Hail"));
  here.coast.unsubscribe_interaction_class(mayday);
  EXPECT_THAT(here.told(here.pilot_heard), IsEmpty()) << "still by its superclass";
  here.coast.unsubscribe_interaction_class(hail);
  EXPECT_THAT(here.told(here.pilot_heard), ElementsAre("off Hail", "off Mayday"));
}

// 5.6, 5.8, 9.8, 9.10
TEST(Conformance, APassiveSubscriptionHearsAllAndAdvisesNobody) {
  AdvisedCompany here;
  here.pilot.publish_object_class_attributes(vessel, motion);
  here.pilot.publish_interaction_class(hail);
  const RegionHandle region = here.coast.create_region();
  here.coast.set_region(region, {0.0, 0.0, 1.0, 1.0});
  here.coast.commit_region_modifications(region);
  here.coast.subscribe_object_class_attributes(vessel, motion, {}, false);
  here.coast.subscribe_object_class_attributes(vessel, motion, region, false);
  here.coast.subscribe_interaction_class(hail, false);
  EXPECT_THAT(here.told(here.pilot_heard), IsEmpty());
  const ObjectHandle object = here.pilot.register_object_instance(vessel);
  here.pilot.update_attribute_values(object, AttributeSet{speed}, values_of(7.0f), {});
  here.pilot.send_interaction(hail, bytes_of("ahoy"), {});
  here.settle();
  EXPECT_EQ(here.members[1].heard.objects.at(object.value).values.at(speed.value), values_of(7.0f));
  EXPECT_EQ(here.members[1].heard.interactions.size(), 1u);
  here.coast.subscribe_object_class_attributes(vessel, AttributeSet{speed}, region);
  here.coast.subscribe_interaction_class(hail);
  EXPECT_THAT(here.told(here.pilot_heard), ElementsAre("start Vessel", "on Hail"))
      << "one active subscription is enough";
  here.coast.subscribe_interaction_class(hail, false);
  here.coast.unsubscribe_object_class(vessel, region);
  EXPECT_THAT(here.told(here.pilot_heard), ElementsAre("off Hail", "stop Vessel"));
}

// 10.27, 10.28, 10.33, 10.34
TEST(Conformance, WhileASwitchIsOffItsAdvisoriesAreNotTold) {
  AdvisedCompany here;
  here.pilot.publish_object_class_attributes(vessel, motion);
  here.pilot.publish_interaction_class(hail);
  here.pilot.disable_object_class_relevance_advisory_switch();
  here.pilot.disable_interaction_relevance_advisory_switch();
  here.coast.subscribe_object_class_attributes(vessel, motion);
  here.coast.subscribe_interaction_class(hail);
  EXPECT_THAT(here.told(here.pilot_heard), IsEmpty());
  here.pilot.enable_object_class_relevance_advisory_switch();
  here.pilot.enable_interaction_relevance_advisory_switch();
  EXPECT_THAT(here.told(here.pilot_heard), ElementsAre("start Vessel", "on Hail"));
}

// 10.27 to 10.34
TEST(Conformance, ASwitchThatIsSoAlreadyIsRefusedByItsName) {
  AdvisedCompany here;
  EXPECT_EQ(error_thrown_by([&] { here.pilot.enable_object_class_relevance_advisory_switch(); }),
            HlaError::object_class_relevance_advisory_switch_is_on);
  EXPECT_EQ(error_thrown_by([&] { here.pilot.disable_attribute_relevance_advisory_switch(); }),
            HlaError::attribute_relevance_advisory_switch_is_off);
  EXPECT_EQ(error_thrown_by([&] { here.pilot.enable_attribute_scope_advisory_switch(); }),
            HlaError::attribute_scope_advisory_switch_is_on);
  here.pilot.disable_interaction_relevance_advisory_switch();
  EXPECT_EQ(error_thrown_by([&] { here.pilot.disable_interaction_relevance_advisory_switch(); }),
            HlaError::interaction_relevance_advisory_switch_is_off);
  Recorder nobody;
  Ambassador stranger(harbour(), nobody);
  EXPECT_EQ(error_thrown_by([&] { stranger.disable_attribute_scope_advisory_switch(); }),
            HlaError::federate_not_execution_member);
}

// 10.31, 10.32
TEST(Conformance, WithoutTheScopeAdvisoryValuesComeAllTheSame) {
  AdvisedCompany here;
  here.pilot.publish_object_class_attributes(vessel, motion);
  here.coast.disable_attribute_scope_advisory_switch();
  here.coast.subscribe_object_class_attributes(vessel, motion);
  here.settle();
  const ObjectHandle object = here.pilot.register_object_instance(vessel);
  here.pilot.update_attribute_values(object, AttributeSet{speed}, values_of(7.0f), {});
  here.settle();
  EXPECT_FALSE(here.members[1].heard.objects.at(object.value).is_in_scope);
  EXPECT_EQ(here.members[1].heard.objects.at(object.value).values.at(speed.value), values_of(7.0f));
}

// 5.2, 5.4, 5.6, 5.8
TEST(Conformance, ClassesAndAttributesThatAreNoneAreRefusedByTheirNames) {
  AdvisedCompany here;
  const ObjectClassHandle nothing{99};
  const InteractionClassHandle silence{99};
  EXPECT_EQ(error_thrown_by([&] { here.pilot.subscribe_object_class_attributes(nothing, motion); }),
            HlaError::object_class_not_defined);
  EXPECT_EQ(error_thrown_by([&] {
              here.pilot.subscribe_object_class_attributes(vessel, AttributeSet{destination});
            }),
            HlaError::attribute_not_defined);
  EXPECT_EQ(error_thrown_by([&] {
              here.pilot.publish_object_class_attributes(vessel, AttributeSet{destination});
            }),
            HlaError::attribute_not_defined);
  EXPECT_EQ(error_thrown_by([&] { here.pilot.publish_interaction_class(silence); }),
            HlaError::interaction_class_not_defined);
  EXPECT_EQ(error_thrown_by([&] { here.pilot.subscribe_interaction_class(silence); }),
            HlaError::interaction_class_not_defined);
}

// 6.21, 6.22, 10.29, 10.30
TEST(Conformance, UpdatesOfAnObjectAreTurnedOnWhileItsAttributesAreInTheScopeOfAnActiveSubscriber) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const auto below = [&random](std::uint32_t count) {
      return static_cast<std::uint32_t>(random() % count);
    };
    AdvisedCompany here;
    here.join("third");
    here.pilot.publish_object_class_attributes(vessel, motion);
    std::array<std::array<RegionHandle, 2>, 3> regions;
    std::array<std::array<double, 2>, 3> places{};  ///< west ends; regions are 3 m wide
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 2; ++k)
        regions[i][k] = here.members[i].ambassador.create_region();
    const auto move = [&](std::size_t i, std::size_t k) {
      places[i][k] = below(10);
      here.members[i].ambassador.set_region(regions[i][k],
                                            {places[i][k], 0.0, places[i][k] + 3.0, 1.0});
      here.members[i].ambassador.commit_region_modifications(regions[i][k]);
    };
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 2; ++k) move(i, k);
    struct Wish {
      AttributeSet set;
      bool is_active = true;
    };
    std::array<std::array<Wish, 3>, 3> wishes;  ///< by federate; regions 0 and 1, or everywhere
    std::vector<std::pair<ObjectHandle, std::size_t>> objects;  ///< and their region, 2 for none
    here.pilot.enable_attribute_relevance_advisory_switch();
    for (int step = 0; step < 40; ++step) {
      const std::size_t who = 1 + below(2), region = below(3);
      switch (below(4)) {
        case 0: {
          const AttributeSet set(below(4));
          const bool is_active = below(3) != 0;
          wishes[who][region] = {set, is_active};
          here.members[who].ambassador.subscribe_object_class_attributes(
              vessel, set, region == 2 ? RegionHandle{} : regions[who][region], is_active);
          break;
        }
        case 1:
          move(below(3), below(2));
          break;
        case 2: {
          objects.emplace_back(here.pilot.register_object_instance(vessel), region);
          if (region != 2)
            here.pilot.associate_regions_for_updates(objects.back().first, regions[0][region]);
          break;
        }
        default:
          if (objects.empty()) break;
          here.pilot.delete_object_instance(objects.front().first);
          here.pilot_heard.updates_on.erase(objects.front().first.value);
          objects.erase(objects.begin());
      }
      here.settle();
      for (const auto& [object, at] : objects) {
        AttributeSet due;
        for (std::size_t i = 1; i < 3; ++i)
          for (std::size_t k = 0; k < 3; ++k) {
            const bool overlaps =
                at == 2 || k == 2 || std::abs(places[0][at] - places[i][k]) <= 3.0;
            if (wishes[i][k].is_active && overlaps) due = due | wishes[i][k].set;
          }
        ASSERT_EQ(here.pilot_heard.updates_on[object.value], due)
            << "object " << object.value << ", step " << step;
      }
    }
  }
}

}  // namespace
}  // namespace rink::rti::testing
