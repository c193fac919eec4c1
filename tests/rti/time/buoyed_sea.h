// A sea of buoys for tests of how often and how late who is told of what is far.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "tests/rti/rig.h"

namespace rink::rti::testing {

struct Buoy {
  ObjectHandle object;
  RegionHandle region;
  double x = 0.0, y = 0.0;
  std::vector<float> said;  ///< speeds, the newest last
};

/// Buoys on a sea of 100 m x 100 m, each a point, said by a pilot; watchers who see squares of it.
struct BuoyedSea {
  explicit BuoyedSea(const std::string& filter, Carrier carrier = Carrier::in_process,
                     unsigned seed = 1)
      : rig(carrier, settings(filter)), pilot(rig.join("pilot")), random(seed) {
    pilot.ambassador.publish_object_class_attributes(ferry, {position, speed, destination});
  }
  static FederationSettings settings(const std::string& filter) {
    FederationSettings settings;
    settings.filter = filter;
    settings.filter_settings.world = {0.0, 0.0, 100.0, 100.0};
    return settings;
  }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  void move(Buoy& buoy, double x, double y) {
    buoy.x = x, buoy.y = y;
    pilot.ambassador.set_region(buoy.region, {x, y, x, y});
    pilot.ambassador.commit_region_modifications(buoy.region);
  }
  Buoy& add_buoy(double x, double y) {
    Buoy& added = buoys.emplace_back();
    added.object = pilot.ambassador.register_object_instance(ferry);
    added.region = pilot.ambassador.create_region();
    pilot.ambassador.associate_regions_for_updates(added.object, added.region);
    move(added, x, y);
    say(added, 0.5f);
    return added;
  }
  void say(Buoy& buoy, float value) {
    pilot.ambassador.update_attribute_values(buoy.object, AttributeSet{speed}, values_of(value),
                                             {});
    buoy.said.push_back(value);
  }
  Station& add_watcher(const im::Region& view) {
    Station& watcher = rig.join("watcher " + std::to_string(watchers.size()));
    views.push_back(watcher.ambassador.create_region());
    watchers.push_back(&watcher);
    watcher.ambassador.subscribe_object_class_attributes(ferry, {speed, destination}, views.back());
    look(watchers.size() - 1, view);
    return watcher;
  }
  void look(std::size_t watcher, const im::Region& view) {
    watchers[watcher]->ambassador.set_region(views[watcher], view);
    watchers[watcher]->ambassador.commit_region_modifications(views[watcher]);
  }
  void round() { rig.round(); }
  const Recorder::Known& known(std::size_t watcher, const Buoy& buoy) {
    return watchers[watcher]->heard.objects.at(buoy.object.value);
  }
  float heard(std::size_t watcher, const Buoy& buoy) {
    float value = 0.0f;
    std::memcpy(&value, known(watcher, buoy).values.at(speed.value).data(), sizeof value);
    return value;
  }
  const FederationCounters& counters() { return rig.execution().counters(); }
  std::uint64_t state_bytes() { return counters().entry_bytes_sent + counters().update_bytes_sent; }

  Rig rig;
  Station& pilot;
  std::mt19937 random;
  std::vector<Buoy> buoys;
  std::vector<Station*> watchers;
  std::vector<RegionHandle> views;
};

/// Everything wanders, comes and goes; whoever is in scope is never staler than its tier allows,
/// and right once all is quiet.
inline void wander(const std::string& filter, unsigned seed, int stale_max) {
  BuoyedSea sea(filter, Carrier::in_process, seed);
  SCOPED_TRACE(filter + ", seed " + std::to_string(seed));
  const auto box = [&] {
    const double x = sea.uniform(0.0, 100.0), y = sea.uniform(0.0, 100.0),
                 half = sea.uniform(5.0, 40.0);
    return im::Region{x - half, y - half, x + half, y + half};
  };
  for (int i = 0; i < 4; ++i) sea.add_watcher(box());
  for (int i = 0; i < 60; ++i) sea.add_buoy(sea.uniform(0.0, 100.0), sea.uniform(0.0, 100.0));
  sea.rig.settle();
  const auto in_scope = [&](std::size_t watcher, const Buoy& buoy) {
    return sea.rig.execution().is_in_scope(sea.watchers[watcher]->ambassador.federate(),
                                           buoy.object);
  };
  for (int match = 1; match <= 150; ++match) {
    for (Buoy& each : sea.buoys) {
      if (sea.uniform(0.0, 1.0) < 0.3)
        sea.move(each, sea.uniform(0.0, 100.0), sea.uniform(0.0, 100.0));
      if (sea.uniform(0.0, 1.0) < 0.7) sea.say(each, static_cast<float>(match));
    }
    for (std::size_t i = 0; i < 4; ++i)
      if (sea.uniform(0.0, 1.0) < 0.1) sea.look(i, box());
    if (sea.uniform(0.0, 1.0) < 0.3) {
      sea.pilot.ambassador.delete_object_instance(sea.buoys.front().object);
      sea.pilot.ambassador.delete_region(sea.buoys.front().region);
      sea.buoys.erase(sea.buoys.begin());
      sea.add_buoy(sea.uniform(0.0, 100.0), sea.uniform(0.0, 100.0));
    }
    sea.round();
    for (std::size_t i = 0; i < 4; ++i)
      for (const Buoy& each : sea.buoys) {
        if (!in_scope(i, each) || stale_max == 0) continue;
        const float heard = sea.heard(i, each);
        const auto newer = std::count_if(each.said.begin(), each.said.end(),
                                         [heard](float said) { return said > heard; });
        ASSERT_LT(newer, stale_max) << "match " << match;
      }
  }
  for (int match = 0; match < (stale_max > 0 ? stale_max : 400); ++match) sea.round();
  std::size_t compared = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (const Buoy& each : sea.buoys)
      if (in_scope(i, each)) {
        EXPECT_EQ(sea.heard(i, each), each.said.back());
        ++compared;
      }
  EXPECT_GT(compared, 10u);
  const std::uint64_t told = sea.counters().updates_sent;
  for (int match = 0; match < 70; ++match) sea.round();
  EXPECT_EQ(sea.counters().updates_sent, told) << "what rests costs nothing";
  for (const std::uint64_t drops : sea.counters().drops) EXPECT_EQ(drops, 0u);
}

}  // namespace rink::rti::testing
