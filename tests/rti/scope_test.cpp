// Who hears of what, against brute force, under every filter.
#include <gtest/gtest.h>

#include <random>

#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

bool overlaps(const im::Region& a, const im::Region& b) {
  return a.low_x <= b.high_x && b.low_x <= a.high_x && a.low_y <= b.high_y && b.low_y <= a.high_y;
}

im::Region middle_of(const im::Region& region) {
  const double x = 0.5 * region.low_x + 0.5 * region.high_x,
               y = 0.5 * region.low_y + 0.5 * region.high_y;
  return {x, y, x, y};
}

struct Scheme {
  const char* filter;
  bool is_exact;  ///< exactly the overlapping pairs; otherwise at least those whose vessel's middle
                  ///< is seen
  Carrier carrier;
  std::size_t entry_room = FederationSettings().entry_bytes_per_flush_max;
};

class Scope : public ::testing::TestWithParam<Scheme> {};

/// Vessels and watchers wander over 100 m x 60 m; vessels come and go, and some have no region.
struct WatchedSea {
  static FederationSettings settings(const Scheme& scheme) {
    FederationSettings settings;
    settings.filter = scheme.filter;
    settings.entry_bytes_per_flush_max = scheme.entry_room;
    settings.filter_settings.world = {0.0, 0.0, 100.0, 60.0};
    return settings;
  }
  WatchedSea(const Scheme& scheme, unsigned seed)
      : rig(scheme.carrier, settings(scheme)), random(seed), pilot(rig.join("pilot")) {
    pilot.ambassador.publish_object_class_attributes(vessel, AttributeSet{position, speed});
    for (int i = 0; i < 6; ++i) {
      Station& watcher = rig.join("watcher " + std::to_string(i));
      const RegionHandle region = watcher.ambassador.create_region();
      watcher.ambassador.subscribe_object_class_attributes(vessel, AttributeSet{position, speed},
                                                           region);
      watchers.push_back({&watcher, region, {}, false});
    }
  }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  im::Region box(double half) {
    const double x = uniform(0.0, 100.0), y = uniform(0.0, 60.0);
    return {x - half, y - half, x + half, y + half};
  }
  void add_vessel() {
    Vessel added{pilot.ambassador.register_object_instance(vessel), {}, {}, 0.0f};
    if (uniform(0.0, 1.0) < 0.9) {
      added.region = pilot.ambassador.create_region();
      pilot.ambassador.associate_regions_for_updates(added.object, added.region);
      move(added);
    }
    vessels.push_back(added);
  }
  struct Vessel {
    ObjectHandle object;
    RegionHandle region;
    im::Region bounds;
    float speed;
  };
  struct Watcher {
    Station* station;
    RegionHandle region;
    im::Region bounds;
    bool has_bounds;
  };
  void move(Vessel& moved) {
    moved.bounds = box(0.5);
    pilot.ambassador.set_region(moved.region, moved.bounds);
    pilot.ambassador.commit_region_modifications(moved.region);
  }
  void step() {
    change();
    rig.settle(rig.port() == 0 ? 1 : 3);
  }
  void change() {
    for (Vessel& each : vessels)
      if (each.region && uniform(0.0, 1.0) < 0.5) move(each);
    for (Watcher& each : watchers) {
      if (uniform(0.0, 1.0) < 0.4) continue;
      each.bounds = box(uniform(1.0, 25.0));
      each.has_bounds = true;
      each.station->ambassador.set_region(each.region, each.bounds);
      each.station->ambassador.commit_region_modifications(each.region);
    }
    if (uniform(0.0, 1.0) < 0.5) add_vessel();
    if (!vessels.empty() && uniform(0.0, 1.0) < 0.3) {
      std::swap(vessels.back(), vessels[static_cast<std::size_t>(
                                    uniform(0.0, static_cast<double>(vessels.size()) - 0.01))]);
      pilot.ambassador.delete_object_instance(vessels.back().object);
      if (vessels.back().region) pilot.ambassador.delete_region(vessels.back().region);
      vessels.pop_back();
    }
    for (Vessel& each : vessels) {
      if (uniform(0.0, 1.0) < 0.3) continue;
      each.speed = static_cast<float>(uniform(0.0, 30.0));
      pilot.ambassador.update_attribute_values(each.object, AttributeSet{position, speed},
                                               values_of(0.0f, 0.0f, each.speed), {});
    }
  }

  Rig rig;
  std::mt19937 random;
  Station& pilot;
  std::vector<Watcher> watchers;
  std::vector<Vessel> vessels;
};

TEST_P(Scope, FollowsRandomMovesAsBruteForceDoesAndInScopeStateIsTheOwners) {
  const unsigned seed = 20260;
  SCOPED_TRACE("seed " + std::to_string(seed));
  WatchedSea sea(GetParam(), seed);
  for (int i = 0; i < 40; ++i) sea.add_vessel();
  for (int step = 0; step < 60; ++step) {
    for (int hasty = 0; GetParam().entry_room < 1000 && hasty < 3; ++hasty)
      sea.change(), sea.rig.round();  // while much is not told yet
    sea.step();
    for (const WatchedSea::Watcher& watcher : sea.watchers) {
      const Recorder& heard = watcher.station->heard;
      for (const WatchedSea::Vessel& vessel : sea.vessels) {
        const bool is_due =
            !vessel.region || (watcher.has_bounds && overlaps(vessel.bounds, watcher.bounds));
        const auto known = heard.objects.find(vessel.object.value);
        const bool is_in_scope = known != heard.objects.end() && known->second.is_in_scope;
        ASSERT_TRUE(is_in_scope == is_due || !GetParam().is_exact) << "step " << step;
        ASSERT_TRUE(is_in_scope || !is_due || !overlaps(middle_of(vessel.bounds), watcher.bounds))
            << "step " << step;
        ASSERT_EQ(is_in_scope, sea.rig.execution().is_in_scope(
                                   watcher.station->ambassador.federate(), vessel.object));
        if (!is_in_scope || vessel.speed == 0.0f) continue;  // never updated
        ASSERT_EQ(known->second.values.at(speed.value), values_of(vessel.speed)) << "step " << step;
      }
      for (const auto& [object, known] : heard.objects) {
        const bool is_alive = std::any_of(
            sea.vessels.begin(), sea.vessels.end(),
            [&](const WatchedSea::Vessel& each) { return each.object.value == object; });
        ASSERT_TRUE(is_alive) << "removed objects are gone, step " << step;
      }
      for (const auto& [object, count] : heard.discoveries) ASSERT_EQ(count, 1);
      ASSERT_EQ(heard.out_of_scope_updates, 0);
      ASSERT_EQ(heard.lost, "");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Under, Scope,
                         ::testing::Values(Scheme{"none", false, Carrier::in_process},
                                           Scheme{"grid", false, Carrier::in_process},
                                           Scheme{"region", true, Carrier::in_process},
                                           Scheme{"region", true, Carrier::tcp},
                                           Scheme{"region", true, Carrier::in_process, 100},
                                           Scheme{"grid", false, Carrier::in_process, 1}),
                         [](const auto& scheme) {
                           const std::string room =
                               scheme.param.entry_room < 1000
                                   ? "_" + std::to_string(scheme.param.entry_room) +
                                         "_bytes_of_entries_per_flush"
                                   : "";
                           return std::string(scheme.param.filter) + "_" +
                                  name_of(scheme.param.carrier) + room;
                         });

TEST(ScopeWithoutMotion, AnObjectThatEntersBringsItsStateOnceAndOneThatLeavesSaysNoMore) {
  WatchedSea sea({"region", true, Carrier::in_process}, 1);
  const auto& watcher = sea.watchers.front();
  Ambassador &pilot = sea.pilot.ambassador, &coast = watcher.station->ambassador;
  const ObjectHandle object = pilot.register_object_instance(vessel, "Aurora");
  const RegionHandle region = pilot.create_region();
  pilot.set_region(region, {50.0, 30.0, 51.0, 31.0});
  pilot.commit_region_modifications(region);
  pilot.associate_regions_for_updates(object, region);
  pilot.update_attribute_values(object, AttributeSet{speed}, values_of(5.0f), {});
  coast.set_region(watcher.region, {0.0, 0.0, 10.0, 10.0});
  coast.commit_region_modifications(watcher.region);
  sea.rig.settle();
  const Recorder& heard = watcher.station->heard;
  EXPECT_TRUE(heard.objects.empty());
  const auto look = [&](const im::Region& bounds) {
    coast.set_region(watcher.region, bounds);
    coast.commit_region_modifications(watcher.region);
    sea.rig.settle();
  };
  look({45.0, 25.0, 55.0, 35.0});
  ASSERT_EQ(heard.objects.size(), 1u);
  EXPECT_EQ(heard.objects.begin()->second.updates, 1);
  look({0.0, 0.0, 10.0, 10.0});
  pilot.update_attribute_values(object, AttributeSet{speed}, values_of(6.0f), {});
  sea.rig.settle();
  EXPECT_FALSE(heard.objects.begin()->second.is_in_scope);
  EXPECT_EQ(heard.objects.begin()->second.updates, 1);
  look({51.0, 31.0, 55.0, 35.0});  // touching is overlap
  EXPECT_EQ(heard.objects.begin()->second.updates, 2);
  EXPECT_EQ(heard.objects.begin()->second.values.at(speed.value), values_of(6.0f));
  EXPECT_EQ(heard.discoveries.at(object.value), 1);
}

/// 20,000 ferries, each some 60 bytes of name and 60 of state: twenty times what may wait for one
/// who does not read.
TEST(ScopeWithoutMotion, WhoComesIntoALargeWorldIsToldItInAsManyFlushesAsItsQueueNeeds) {
  constexpr std::size_t queue_max = 64u << 10, room = 16u << 10;
  constexpr int ferries = 20'000;
  FederationSettings settings;
  settings.entry_bytes_per_flush_max = room;
  Rig rig(Carrier::tcp, settings, {.queue_max = queue_max});
  Station &pilot = rig.join("pilot"), &coast = rig.join("coast");
  pilot.ambassador.publish_object_class_attributes(ferry, {position, destination});
  std::vector<ObjectHandle> registered;
  for (int i = 0; i < ferries; ++i) {
    registered.push_back(pilot.ambassador.register_object_instance(
        ferry, "a ferry with a name of its own, which is number " + std::to_string(i)));
    std::vector<std::byte> values = values_of(static_cast<float>(i), 0.0f);
    const std::vector<std::byte> text =
        varying("somewhere that takes some words to say: " + std::to_string(i));
    values.insert(values.end(), text.begin(), text.end());
    pilot.ambassador.update_attribute_values(registered.back(), {position, destination}, values,
                                             {});
    if (i % 500 == 0) rig.round();
  }
  rig.settle();
  coast.ambassador.subscribe_object_class_attributes(ferry, {position, destination});
  std::uint64_t before = rig.execution().counters().bytes_sent;
  int flushes = 0;
  for (; flushes < 2'000 && coast.heard.objects.size() < ferries; ++flushes) {
    rig.round();
    const std::uint64_t now = rig.execution().counters().bytes_sent;
    ASSERT_LE(now - before, room + 1000);
    before = now;
  }
  rig.settle();
  ASSERT_EQ(coast.heard.lost, "");
  EXPECT_GT(flushes, 50);
  EXPECT_GT(rig.execution().counters().entries_postponed, 19'000u);
  ASSERT_EQ(coast.heard.objects.size(), static_cast<std::size_t>(ferries));
  for (int i = 0; i < ferries; ++i) {
    const Recorder::Known& known =
        coast.heard.objects.at(registered[static_cast<std::size_t>(i)].value);
    ASSERT_EQ(known.updates, 1);
    ASSERT_EQ(known.values.at(destination.value),
              varying("somewhere that takes some words to say: " + std::to_string(i)));
  }
}

TEST(ScopeWithoutMotion, RegionsThatNameDifferentAttributesAddUp) {
  WatchedSea sea({"region", true, Carrier::in_process}, 1);
  const auto& watcher = sea.watchers.front();
  Ambassador &pilot = sea.pilot.ambassador, &coast = watcher.station->ambassador;
  const RegionHandle near = coast.create_region();
  coast.subscribe_object_class_attributes(vessel, AttributeSet{position}, watcher.region);
  coast.subscribe_object_class_attributes(vessel, AttributeSet{speed}, near);
  const std::array regions{RegionBounds{watcher.region, {0.0, 0.0, 100.0, 60.0}},
                           RegionBounds{near, {0.0, 0.0, 10.0, 10.0}}};
  coast.commit_region_modifications(regions);
  const ObjectHandle object = pilot.register_object_instance(vessel);
  const RegionHandle region = pilot.create_region();
  pilot.associate_regions_for_updates(object, region);
  const auto go = [&](double x, float knots) {
    pilot.set_region(region, {x, 5.0, x, 5.0});
    pilot.commit_region_modifications(region);
    pilot.update_attribute_values(object, AttributeSet{position, speed},
                                  values_of(static_cast<float>(x), 5.0f, knots), {});
    sea.rig.settle();
  };
  go(50.0, 1.0f);
  auto& known = watcher.station->heard.objects[object.value];
  EXPECT_EQ(known.values.at(position.value), values_of(50.0f, 5.0f));
  EXPECT_EQ(known.values.count(speed.value), 0u) << "too far for its speed";
  go(5.0, 2.0f);
  EXPECT_EQ(known.values.at(speed.value), values_of(2.0f));
  go(60.0, 3.0f);
  EXPECT_EQ(known.values.at(position.value), values_of(60.0f, 5.0f));
  EXPECT_EQ(known.values.at(speed.value), values_of(2.0f)) << "out of the near region again";
  EXPECT_EQ(watcher.station->heard.discoveries[object.value], 1);
}

}  // namespace
}  // namespace rink::rti::testing
