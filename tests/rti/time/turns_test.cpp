// Rates by tier and a budget in a federation: how often and how late each is told of what is far,
// against what was said; and that the newest state comes in the end.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

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

constexpr const char* four_tiers = "region with tiers(at=0.25 at=0.5 at=0.75)";

/// Sixteen of each tier, by distances of a watcher's middle at (50, 50) who sees 50 m.
void fill(BuoyedSea& sea) {
  for (int tier = 0; tier < 4; ++tier)
    for (int i = 0; i < 16; ++i) {
      const double far = 6.0 + 12.0 * tier, angle = 0.3 + 0.39 * i;
      sea.add_buoy(50.0 + far * std::cos(angle), 50.0 + far * std::sin(angle));
    }
}
int tier_of(std::size_t buoy) { return static_cast<int>(buoy / 16); }

TEST(Tiers, AreToldEverySecondFourthAndEighthMatch) {
  BuoyedSea sea(four_tiers);
  fill(sea);
  sea.add_watcher({0.0, 0.0, 100.0, 100.0});
  sea.rig.settle();
  std::vector<int> before;
  for (const Buoy& each : sea.buoys) {
    EXPECT_EQ(sea.heard(0, each), 0.5f) << "the state on entry comes at once, whatever the tier";
    before.push_back(sea.known(0, each).updates);
  }
  const FederationCounters start = sea.counters();
  for (int match = 1; match <= 64; ++match) {
    for (Buoy& each : sea.buoys) sea.say(each, static_cast<float>(match));
    sea.round();
    for (std::size_t i = 0; i < sea.buoys.size(); ++i)
      ASSERT_LT(match - static_cast<int>(sea.heard(0, sea.buoys[i])), 1 << tier_of(i))
          << "buoy " << i << " at match " << match;
  }
  for (int match = 0; match < 8; ++match) sea.round();
  for (std::size_t i = 0; i < sea.buoys.size(); ++i) {
    const int told = sea.known(0, sea.buoys[i]).updates - before[i], due = 64 >> tier_of(i);
    EXPECT_TRUE(told == due || told == due + 1)
        << told << " instead of " << due << ", and one at the end if it fell between two turns";
    EXPECT_EQ(sea.heard(0, sea.buoys[i]), 64.0f) << "who came to rest is right in the end";
  }
  EXPECT_EQ(sea.counters().updates_put_off - start.updates_put_off, 16u * (32u + 48u + 56u));
  EXPECT_LE(sea.counters().updates_caught_up - start.updates_caught_up, 3u * 16u)
      << "where an update says all that is late, it is sent itself";
}

TEST(Tiers, ThatBecomeOthersTellAtOnceWhatIsLate) {
  BuoyedSea sea(
      "region with tiers(at=0.01 at=0.02 at=0.03 at=0.04 at=0.05 at=0.5)");  // the last is told
                                                                             // every 64th match
  Buoy& buoy = sea.add_buoy(95.0, 50.0);
  sea.add_watcher({0.0, 0.0, 100.0, 100.0});
  sea.rig.settle();
  const auto say_until_late = [&](float value) {
    do sea.say(buoy, value += 1.0f), sea.round();
    while (sea.heard(0, buoy) == value);
    return value;
  };
  const float late = say_until_late(10.0f);
  ASSERT_NE(sea.heard(0, buoy), late);
  sea.move(buoy, 60.0, 50.0);
  sea.round();
  EXPECT_EQ(sea.heard(0, buoy), late) << "nearer, without another word of its owner";
  const float later = say_until_late(100.0f);
  sea.look(0, {57.0, 47.0, 63.0, 53.0});
  sea.round();
  EXPECT_EQ(sea.heard(0, buoy), later) << "since who looks came nearer";
  sea.say(buoy, 1000.0f);
  sea.round();
  EXPECT_EQ(sea.heard(0, buoy), 1000.0f) << "tier 0 never waits";
}

TEST(Tiers, TellAllAttributesThatAreLateInOne) {
  BuoyedSea sea("region with tiers(at=0.01 at=0.02)");
  Buoy& buoy = sea.add_buoy(95.0, 50.0);
  sea.add_watcher({0.0, 0.0, 100.0, 100.0});
  sea.rig.settle();
  sea.pilot.ambassador.update_attribute_values(buoy.object, AttributeSet{destination},
                                               varying("Bergen"), {});
  for (int match = 0; match < 4; ++match) {
    sea.say(buoy, static_cast<float>(match));
    sea.round();
  }
  sea.rig.settle(4);
  EXPECT_EQ(sea.known(0, buoy).values.at(destination.value), varying("Bergen"));
  EXPECT_EQ(sea.heard(0, buoy), 3.0f);
}

TEST(Tiers, OfSeveralRegionsGoByTheNearest) {
  BuoyedSea sea("region with tiers(at=0.1 at=0.2 at=0.3 at=0.4 at=0.5)");
  Buoy& buoy = sea.add_buoy(95.0, 50.0);
  Station& watcher = sea.add_watcher({0.0, 0.0, 100.0, 100.0});
  const RegionHandle close = watcher.ambassador.create_region();
  watcher.ambassador.set_region(close, {90.0, 45.0, 100.0, 55.0});
  watcher.ambassador.commit_region_modifications(close);
  watcher.ambassador.subscribe_object_class_attributes(ferry, {speed, destination}, close);
  sea.rig.settle();
  for (int match = 1; match < 20; ++match) {
    sea.say(buoy, static_cast<float>(match));
    sea.round();
    ASSERT_EQ(sea.heard(0, buoy), static_cast<float>(match));
  }
}

/// Everything wanders, comes and goes; whoever is in scope is never staler than its tier allows,
/// and right once all is quiet.
void wander(const std::string& filter, unsigned seed, int stale_max) {
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

TEST(Tiers, KeepEverybodyAsFreshAsTheySayWhateverHappens) {
  for (unsigned seed = 1; seed <= 6; ++seed) wander(four_tiers, seed, 8);
  wander("region with hysteresis(margin=2) with tiers(at=0.2)", 7, 2);
}

TEST(HeldUpdates, AreToldWhenTheirBoundIsExceeded) {
  BuoyedSea sea("region with vfc(at=0.25 matches=5)");
  sea.add_buoy(52.0, 50.0);
  sea.add_buoy(95.0, 50.0);
  sea.add_watcher({0.0, 0.0, 100.0, 100.0});
  sea.rig.settle();
  const int before = sea.known(0, sea.buoys[1]).updates;
  for (int match = 1; match <= 60; ++match) {
    for (Buoy& each : sea.buoys) sea.say(each, static_cast<float>(match));
    sea.round();
    ASSERT_EQ(sea.heard(0, sea.buoys[0]), static_cast<float>(match)) << "near";
    ASSERT_EQ(sea.heard(0, sea.buoys[1]), match < 6 ? 0.5f : static_cast<float>(match / 6 * 6));
  }
  EXPECT_EQ(sea.known(0, sea.buoys[1]).updates - before, 10);
  sea.say(sea.buoys[1], 100.0f);
  for (int match = 0; match < 5; ++match) sea.round();
  sea.round();
  EXPECT_EQ(sea.heard(0, sea.buoys[1]), 100.0f) << "at rest, too";
}

TEST(HeldUpdates, OfOneWhoSubscribesEverywhereDoNotWait) {
  BuoyedSea sea("region with vfc(at=0 matches=60)");
  Buoy& buoy = sea.add_buoy(95.0, 50.0);
  Station& watcher = sea.add_watcher({0.0, 0.0, 100.0, 100.0});
  sea.rig.settle();
  sea.say(buoy, 1.0f);
  sea.round();
  EXPECT_EQ(sea.heard(0, buoy), 0.5f);
  watcher.ambassador.subscribe_object_class_attributes(ferry, {speed, destination}, {});
  sea.round();
  EXPECT_EQ(sea.heard(0, buoy), 1.0f);
  sea.say(buoy, 2.0f);
  sea.round();
  EXPECT_EQ(sea.heard(0, buoy), 2.0f);
}

TEST(HeldUpdates, AreToldWhenTheirObjectComesIntoAnotherSubscriptionOrGetsAnotherRegion) {
  BuoyedSea sea("region with vfc(at=0 matches=60)");
  Buoy& buoy = sea.add_buoy(95.0, 50.0);
  Station& watcher = sea.add_watcher({0.0, 0.0, 100.0, 100.0});
  sea.rig.settle();
  const auto say = [&](float value) {
    sea.say(buoy, value);
    sea.round();
  };
  say(1.0f);
  EXPECT_EQ(sea.heard(0, buoy), 0.5f);
  const RegionHandle close = watcher.ambassador.create_region();
  watcher.ambassador.set_region(close, {90.0, 40.0, 100.0, 56.0});
  watcher.ambassador.commit_region_modifications(close);
  watcher.ambassador.subscribe_object_class_attributes(ferry, {speed, destination}, close);
  sea.round();
  EXPECT_EQ(sea.heard(0, buoy), 1.0f);
  say(2.0f);
  EXPECT_EQ(sea.heard(0, buoy), 1.0f);
  const RegionHandle other = sea.pilot.ambassador.create_region();
  sea.pilot.ambassador.set_region(other, {94.0, 50.0, 94.0, 50.0});
  sea.pilot.ambassador.commit_region_modifications(other);
  sea.pilot.ambassador.associate_regions_for_updates(buoy.object, other);
  sea.round(), sea.round();
  EXPECT_EQ(sea.heard(0, buoy), 2.0f);
}

TEST(HeldUpdates, OfAnObjectThatJoinsAnothersRegionAreToldByItsBounds) {
  BuoyedSea sea("region with vfc(at=0 matches=3)");
  sea.add_buoy(95.0, 50.0), sea.add_buoy(96.0, 50.0);
  sea.add_watcher({0.0, 0.0, 100.0, 100.0});
  sea.rig.settle();
  sea.say(sea.buoys[0], 1.0f);
  sea.round();
  sea.pilot.ambassador.associate_regions_for_updates(sea.buoys[0].object, sea.buoys[1].region);
  for (int match = 0; match < 6; ++match) sea.round();
  EXPECT_EQ(sea.heard(0, sea.buoys[0]), 1.0f);
}

TEST(HeldUpdates, KeepEverybodyWithinTheirBoundsWhateverHappens) {
  for (unsigned seed = 1; seed <= 4; ++seed) wander("region with vfc(at=0 matches=4)", seed, 5);
  for (unsigned seed = 1; seed <= 4; ++seed)
    wander("region with dyconits(cell_size=20 matches=2)", seed, 11);
  for (unsigned seed = 1; seed <= 4; ++seed)
    wander("region with vfc(at=0.3 matches=4) with priority(budget=60)", seed, 0);
}

TEST(Budget, IsKeptAndStarvesNobody) {
  for (unsigned seed = 1; seed <= 4; ++seed) wander("region with priority(budget=60)", seed, 0);
  wander(std::string(four_tiers) + " with priority(budget=60)", 5, 0);
}

TEST(Budget, BoundsTheBytesOfAMatchAndTellsTheNearestMoreOften) {
  constexpr std::uint64_t budget =
      60;  // ten of the sixty-four: as many as a tier has would go round in step
  BuoyedSea sea("region with priority(budget=60)");
  fill(sea);
  sea.add_watcher({0.0, 0.0, 100.0, 100.0});
  for (int match = 0; match < 20; ++match) sea.round();
  for (const Buoy& each : sea.buoys)
    ASSERT_EQ(sea.heard(0, each), 0.5f) << "all have come in by and by";
  std::vector<int> before;
  for (const Buoy& each : sea.buoys) before.push_back(sea.known(0, each).updates);
  for (int match = 1; match <= 200; ++match) {
    for (Buoy& each : sea.buoys) sea.say(each, static_cast<float>(match));
    const std::uint64_t bytes = sea.state_bytes();
    sea.round();
    EXPECT_LE(sea.state_bytes() - bytes, budget + 16) << "a block's header apart";
  }
  std::vector<int> told(4);
  for (std::size_t i = 0; i < sea.buoys.size(); ++i) {
    EXPECT_GT(sea.known(0, sea.buoys[i]).updates - before[i], 10) << "buoy " << i;
    told[i / 16] += sea.known(0, sea.buoys[i]).updates - before[i];
  }
  EXPECT_NEAR(static_cast<double>(told[0]) / told[3], (1.0 + 42.0 / 50.0) / (1.0 + 6.0 / 50.0),
              0.25)
      << "by 1 + d / r";
  EXPECT_TRUE(told[0] > told[1] && told[1] > told[2] && told[2] > told[3]);
}

/// Who enters all the time can't keep those waiting who are there, nor these the former.
TEST(Budget, IsSharedByStatesOnEntryAndUpdates) {
  BuoyedSea sea("region with priority(budget=20)");
  for (int i = 0; i < 8; ++i) sea.add_buoy(52.0 + i, 50.0);
  sea.add_watcher({0.0, 0.0, 100.0, 100.0});
  for (int i = 0; i < 60; ++i) sea.round();
  for (int i = 0; i < 8; ++i) sea.add_buoy(200.0, 50.0);
  for (int match = 1; match <= 200; ++match) {
    for (std::size_t i = 0; i < 8; ++i) sea.say(sea.buoys[i], static_cast<float>(match));
    for (std::size_t i = 8; i < 16; ++i)
      sea.move(sea.buoys[i], (match + static_cast<int>(i)) % 8 < 4 ? 50.5 : 200.0,
               50.0);  // half of them come, half of them go
    sea.round();
  }
  for (std::size_t i = 0; i < 8; ++i) EXPECT_GT(sea.heard(0, sea.buoys[i]), 150.0f) << "buoy " << i;
  EXPECT_GT(sea.counters().entry_bytes_sent, 500u);
}

TEST(Turns, CostNothingUnderAFilterWithout) {
  BuoyedSea sea("region with priority");
  fill(sea);
  sea.add_watcher({0.0, 0.0, 100.0, 100.0});
  sea.rig.settle();
  for (int match = 1; match <= 5; ++match) {
    for (Buoy& each : sea.buoys) sea.say(each, static_cast<float>(match));
    sea.round();
    for (const Buoy& each : sea.buoys) ASSERT_EQ(sea.heard(0, each), static_cast<float>(match));
  }
  EXPECT_EQ(sea.counters().updates_put_off, 0u);
  for (std::uint64_t match = 0; match < 70; ++match)
    for (std::uint32_t tier = 0; tier <= Turns::tier_max; ++tier)
      for (std::uint32_t slot = 0; slot < 64; ++slot)
        ASSERT_EQ((turn_of(match, tier) >> slot & 1u) != 0, (match + slot) % (1u << tier) == 0);
}

}  // namespace
}  // namespace rink::rti::testing
