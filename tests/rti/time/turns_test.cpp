// Rates by tier and a budget in a federation: how often and how late each is told of what is far,
// against what was said; and that the newest state comes in the end.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/rti/time/buoyed_sea.h"

namespace rink::rti::testing {
namespace {

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

TEST(Tiers, KeepEverybodyAsFreshAsTheySayWhateverHappens) {
  for (unsigned seed = 1; seed <= 6; ++seed) wander(four_tiers, seed, 8);
  wander("region with hysteresis(margin=2) with tiers(at=0.2)", 7, 2);
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
