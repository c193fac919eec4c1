// Random federations: one goes on undisturbed, its twin is saved, disturbed and restored. From then
// on both are told the same.
#include <random>

#include "tests/rti/save/saved_fleet.h"

namespace rink::rti::testing {
namespace {

/// What the federates of a script have; a copy is what they had when they saved.
struct CrewScript {
  struct Hand {
    std::vector<ObjectHandle> ships;
    std::vector<RegionHandle> regions;
    double time = 0.0;
  };
  std::vector<Hand> hands{3};
  std::vector<ObjectHandle> all;
};

void random_step(SavedFleet& fleet, CrewScript& script, std::mt19937_64& random) {
  const std::size_t who = random() % script.hands.size();
  CrewScript::Hand& hand = script.hands[who];
  Ambassador& rti = *fleet.members[who].ambassador;
  const auto number = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
  const std::size_t what = number(15);
  const auto x = static_cast<float>(number(100)), y = static_cast<float>(number(100));
  const ObjectClassHandle kind = number(2) == 0 ? vessel : ferry;
  const ObjectHandle any =
      script.all.empty() ? ObjectHandle{} : script.all[number(script.all.size())];
  const ObjectHandle own =
      hand.ships.empty() ? ObjectHandle{} : hand.ships[number(hand.ships.size())];
  const RegionHandle region =
      hand.regions.empty() ? RegionHandle{} : hand.regions[number(hand.regions.size())];
  const double ahead = 0.25 * static_cast<double>(1 + number(8));
  const std::string name = number(2) == 0 ? "" : "ship " + std::to_string(number(20));
  const bool is_on = number(2) == 0;
  try {
    switch (what) {
      case 0:
      case 1:
        if (const ObjectHandle made = rti.register_object_instance(kind, name)) {
          hand.ships.push_back(made);
          script.all.push_back(made);
        }
        break;
      case 2:
      case 3:
      case 4:
        if (own)
          rti.update_attribute_values(own, motion, motion_of(x, y, x), {hand.time, number(9)});
        break;
      case 5:
        if (const RegionHandle made = rti.create_region()) hand.regions.push_back(made);
        break;
      case 6:
        if (region) {
          rti.set_region(region, {x, y, x + 30.0, y + 30.0});
          rti.commit_region_modifications(region);
        }
        break;
      case 7:
        if (own) rti.associate_regions_for_updates(own, is_on ? region : RegionHandle{});
        break;
      case 8:
        rti.subscribe_object_class_attributes(kind, is_on ? motion : AttributeSet{position},
                                              number(3) == 0 ? RegionHandle{} : region);
        break;
      case 9:
        if (own && number(3) == 0) rti.delete_object_instance(own);
        break;
      case 10:
        rti.send_interaction(is_on ? hail : mayday, varying(std::to_string(x)), {hand.time, 0});
        break;
      case 11:
        if (own && is_on) rti.unconditional_attribute_ownership_divestiture(own, {speed});
        else if (any) rti.attribute_ownership_acquisition_if_available(any, {speed});
        break;
      case 12:
        rti.reserve_object_instance_name(name);
        break;
      case 13:
        if (own)
          rti.update_attribute_values(own, {destination}, varying(std::to_string(y)),
                                      LogicalTime(hand.time + 1.0 + ahead));
        break;
      case 14:
        rti.time_advance_request(LogicalTime(hand.time + ahead));
        hand.time += ahead;
        break;
      default:
        break;
    }
  } catch (const RtiException&) {
    // Refused for both twins or for neither: what follows would differ.
  }
  fleet.tick(1 + static_cast<int>(number(2)));
}

void join_crew(SavedFleet& fleet) {
  for (const char* name : {"anna", "bob", "carl"}) fleet.join(name);
}

/// Everybody publishes, and bob and carl use time.
void declare_crew(SavedFleet& fleet) {
  for (SavedFleet::Member& each : fleet.members) {
    each.ambassador->publish_object_class_attributes(vessel, motion);
    each.ambassador->publish_object_class_attributes(ferry, motion | AttributeSet{destination});
    each.ambassador->publish_interaction_class(hail);
    each.ambassador->publish_interaction_class(mayday);
  }
  fleet.members[0].ambassador->subscribe_interaction_class(hail);
  fleet.members[1].ambassador->subscribe_object_class_attributes(
      ferry, motion | AttributeSet{destination});
  fleet.members[1].ambassador->enable_time_regulation(1.0);
  fleet.members[1].ambassador->enable_time_constrained();
  fleet.members[2].ambassador->enable_time_regulation(1.0);
  fleet.tick();
}

bool crew_owns(const SavedFleet& fleet, std::size_t member, ObjectHandle ship,
               AttributeHandle attribute) {
  bool is_owned = false;
  const HlaError error = error_thrown_by([&] {
    is_owned = fleet.members[member].ambassador->is_attribute_owned_by_federate(ship, attribute);
  });
  return error == HlaError::none && is_owned;
}

/// A whole state has the last values of attributes that had no owner at the time, too: of speed,
/// which is the one that federates give away.
void expect_twin_values(const std::map<std::uint32_t, std::vector<std::byte>>& a,
                        const std::map<std::uint32_t, std::vector<std::byte>>& b,
                        ObjectHandle ship) {
  for (const auto& [attribute, value] : a) {
    ASSERT_TRUE(b.contains(attribute)) << ship.value << ": " << attribute;
    EXPECT_EQ(value, b.at(attribute)) << ship.value << ": " << attribute;
  }
  for (const auto& [attribute, value] : b)
    EXPECT_TRUE(a.contains(attribute) || attribute == speed.value) << ship.value;
}

void expect_twins(const SavedFleet& one, const SavedFleet& twin, const CrewScript& script) {
  for (std::size_t i = 0; i < one.members.size(); ++i) {
    const Keeper &a = one.members[i].heard, &b = twin.members[i].heard;
    EXPECT_EQ(a.lost, b.lost);
    EXPECT_EQ(a.interactions, b.interactions) << i;
    EXPECT_EQ(a.granted, b.granted) << i;
    ASSERT_EQ(a.objects.size(), b.objects.size()) << i;
    for (const auto& [handle, known] : a.objects) {
      ASSERT_TRUE(b.objects.contains(handle)) << i << ": " << handle;
      const Recorder::Known& other = b.objects.at(handle);
      EXPECT_EQ(known.object_class, other.object_class);
      EXPECT_EQ(known.name, other.name);
      EXPECT_EQ(known.is_in_scope, other.is_in_scope) << i << ": " << handle;
      if (known.is_in_scope) expect_twin_values(known.values, other.values, {handle});
    }
    for (const ObjectHandle ship : script.all)
      for (const AttributeHandle attribute : {position, speed})
        EXPECT_EQ(crew_owns(one, i, ship, attribute), crew_owns(twin, i, ship, attribute))
            << i << ": " << ship.value;
  }
}

TEST(RestoredTwin, IsToldWhatTheUndisturbedOneIsTold) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SavedFleet one, twin;
    CrewScript script;
    for (SavedFleet* each : {&one, &twin}) {
      join_crew(*each);
      declare_crew(*each);
      script = {};
      std::mt19937_64 random(seed);
      for (int i = 0; i < 120; ++i) random_step(*each, script, random);
    }
    CrewScript of_twin = script, disturbed = script;
    twin.members[0].ambassador->request_federation_save("noon");
    twin.tick();
    one.tick();
    ASSERT_EQ(twin.members[2].heard.told.back(), "saved");
    if (seed % 2 == 0) {
      std::mt19937_64 random(seed + 1000);
      for (int i = 0; i < 60; ++i) random_step(twin, disturbed, random);
    } else {
      twin.begin();
      join_crew(twin);
    }
    twin.members[1].ambassador->request_federation_restore("noon");
    twin.tick();
    ASSERT_EQ(twin.members[2].heard.told.back(), "restored");
    for (SavedFleet* each : {&one, &twin})
      for (SavedFleet::Member& member : each->members) {
        member.heard.interactions.clear();
        member.heard.granted = 0.0;
      }
    expect_twins(one, twin, script);
    std::mt19937_64 random(seed + 2000), same(seed + 2000);
    for (int i = 0; i < 120; ++i) {
      random_step(one, script, random);
      random_step(twin, of_twin, same);
    }
    one.tick();
    twin.tick();
    EXPECT_EQ(script.all, of_twin.all);
    expect_twins(one, twin, script);
    if (HasFailure()) break;
  }
}

}  // namespace
}  // namespace rink::rti::testing
