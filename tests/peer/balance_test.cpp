// Zones that shift: toward equal load where it is uneven, not at all where it is not, and never
// with another outcome.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numeric>

#include "game/peer/assembly.h"
#include "game/peer/cuts.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

/// Events per square metre, evenly or mostly about one place.
double density(double x, double y, double peak) {
  return 1.0 + peak * std::exp(-((x - 0.9) * (x - 0.9) + (y - 0.6) * (y - 0.6)) / 0.2);
}

/// Of each peer, by the midpoints of a fine grid.
std::vector<double> loads(const Cuts& cuts, PeerNumber peer_count, double peak) {
  constexpr int columns = 400, rows = 200;
  const Division division = cuts.division(peer_count);
  std::vector<double> all(peer_count, 0.0);
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const Vector2 place(4.0 * (i + 0.5) / columns, 2.0 * (j + 0.5) / rows);
      all[division.owner_of(place)] += density(place.x(), place.y(), peak);
    }
  return all;
}

double unevenness(const std::vector<double>& loads) {
  return *std::max_element(loads.begin(), loads.end()) * static_cast<double>(loads.size()) /
         std::accumulate(loads.begin(), loads.end(), 0.0);
}

/// With nothing in it, the field is cut by area.
Cuts by_area(PeerNumber peer_count) { return Cuts::by_count(field, {}, peer_count); }

TEST(Cuts, StayWhereTheLoadIsEven) {
  for (const PeerNumber peer_count : {2u, 3u, 7u, 16u})
    EXPECT_FALSE(by_area(peer_count).balanced(loads(by_area(peer_count), peer_count, 0.0), 1.1))
        << peer_count;
  const std::vector<double> nothing(4, 0.0);
  EXPECT_FALSE(by_area(4).balanced(nothing, 1.1));
}

TEST(Cuts, ShiftUntilEveryCutIsWithinTheTolerance) {
  constexpr double tolerance = 1.1;
  for (const PeerNumber peer_count : {2u, 3u, 5u, 8u, 16u}) {
    Cuts cuts = by_area(peer_count);
    const double before = unevenness(loads(cuts, peer_count, 60.0));
    int rounds = 0;
    for (; rounds < 100; ++rounds) {
      const auto shifted = cuts.balanced(loads(cuts, peer_count, 60.0), tolerance);
      if (!shifted) break;
      cuts = *shifted;
    }
    const double after = unevenness(loads(cuts, peer_count, 60.0));
    std::cout << peer_count << " peers: busiest over mean " << before << ", after " << rounds
              << " shifts " << after << '\n';
    EXPECT_LT(rounds, 100);
    EXPECT_LE(after, std::pow(tolerance, std::ceil(std::log2(peer_count))));
    EXPECT_GT(before, 1.5 * after);
  }
}

TEST(Cuts, KeepAZoneForEverybodyHoweverUnevenTheLoad) {
  Random random(3);
  for (PeerNumber peer_count = 2; peer_count <= 16; ++peer_count) {
    Cuts cuts = by_area(peer_count);
    for (int round = 0; round < 50; ++round) {
      std::vector<double> all(peer_count, 0.0);
      all[below(random, peer_count)] = 1000.0;
      cuts = cuts.balanced(all, 1.1).value();
      std::vector<Zone> zones;
      const Division division = cuts.division(peer_count);
      for (PeerNumber peer = 0; peer < peer_count; ++peer) {
        const Box box = division.zones_of(peer).front();
        zones.push_back({{std::max(box.low_x, 0.0), std::max(box.low_y, 0.0),
                          std::min(box.high_x, 4.0), std::min(box.high_y, 2.0)},
                         peer});
      }
      ASSERT_EQ(Division::objection(field, zones, peer_count), std::nullopt);
    }
  }
}

TEST(Cuts, GiveTheZoneOfWhoGoesToItsNeighbours) {
  Random random(5);
  for (PeerNumber peer_count = 2; peer_count <= 16; ++peer_count) {
    Cuts cuts = by_area(peer_count);
    std::vector<PeerNumber> left(peer_count);
    std::iota(left.begin(), left.end(), PeerNumber{0});
    while (left.size() > 1) {
      const std::size_t which = below(random, static_cast<std::uint32_t>(left.size()));
      cuts = cuts.without(left[which]);
      EXPECT_FALSE(cuts.has(left[which]));
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(which));
      const std::vector<double> all = loads(cuts, peer_count, 0.0);
      EXPECT_NEAR(std::accumulate(all.begin(), all.end(), 0.0), 400.0 * 200.0, 1e-6);
      for (PeerNumber peer = 0; peer < peer_count; ++peer)
        EXPECT_EQ(all[peer] > 0.0, std::find(left.begin(), left.end(), peer) != left.end());
    }
  }
}

TEST(Zones, MayBecomeAnyOthersAtAnyWindowAndTheStatesAreThoseOfOneEngine) {
  std::uint64_t hand_overs = 0;
  for (std::uint64_t number = 0; number < 30 && !HasFailure(); ++number) {
    Random random(number);
    constexpr double window = 0.01;
    constexpr int window_count = 60;
    SharedScene scene = shared_scene(number, window * window_count);
    const PeerNumber peer_count = 2 + below(random, 6);
    Assembly assembly(scene.world, random_division(scene.world.spec().field, random, peer_count),
                      0.2, window);
    std::stable_sort(scene.keys.begin(), scene.keys.end(), [](const Key& a, const Key& b) {
      return a.time != b.time ? a.time < b.time : a.bat < b.bat;
    });
    for (const Key& key : scene.keys) assembly.press(key);
    std::size_t next = 0;
    for (int k = 1; k <= window_count && !HasFailure(); ++k) {
      for (; next < scene.keys.size() && scene.keys[next].time <= window * k; ++next) {
        physics::test::RandomKeys::advance(scene.world, scene.keys[next].time);
        scene.world.set_thrust({scene.keys[next].bat}, scene.keys[next].thrust);
      }
      physics::test::RandomKeys::advance(scene.world, window * k);
      if (below(random, 3) == 0)
        assembly.divide(random_division(scene.world.spec().field, random, peer_count));
      assembly.advance();
      EXPECT_EQ(assembly.misowned(), 0u);
      for (std::uint32_t body = 0; body < scene.world.body_count(); ++body)
        ASSERT_EQ(bytes_of(assembly.state(body)),
                  bytes_of(physics::Subdomain::state_in(scene.world, body)))
            << "scene " << number << ", window " << k << ", body " << body;
    }
    for (const Peer& peer : assembly.peers()) hand_overs += peer.counters().hand_overs;
  }
  std::cout << hand_overs << " bodies handed over\n";
  EXPECT_GT(hand_overs, 10'000u);
}

/// Whoever comes to own a place comes to know the posts there, and those who fly there come to know
/// them too.
TEST(Zones, ThatShiftBringTheirPostsAlong) {
  for (std::uint64_t number = 0; number < 8 && !HasFailure(); ++number) {
    Random random(number);
    constexpr double window = 0.02;
    physics::World whole(physics::test::rink_of(4.0, 2.0, 0.9, 0.1, 1.0));
    physics::test::scatter_posts(whole, random, 30);
    physics::test::scatter_pucks(whole, random, 40, 0.03, 2.0);
    const PeerNumber peer_count = 4;
    Assembly assembly(whole, random_division(whole.spec().field, random, peer_count), 0.1, window);
    for (int k = 1; k <= 100; ++k) {
      physics::test::RandomKeys::advance(whole, window * k);
      if (k % 5 == 0) assembly.divide(random_division(whole.spec().field, random, peer_count));
      assembly.advance();
      for (std::uint32_t body = 0; body < whole.body_count(); ++body)
        ASSERT_EQ(bytes_of(assembly.state(body)),
                  bytes_of(physics::Subdomain::state_in(whole, body)))
            << "scene " << number << ", window " << k << ", body " << body;
    }
  }
}

}  // namespace
}  // namespace rink::peer::test
