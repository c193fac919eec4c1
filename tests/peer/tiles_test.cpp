// Peers whose shares are played by tiles have the states of one engine that is played in order.
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>

#include "game/peer/assembly.h"
#include "tests/peer/shared_scenes.h"
#include "tests/physics/slab_scene.h"

namespace rink::peer::test {
namespace {

using physics::QueuePolicy;

struct PlayedByTiles {
  physics::SlabCounters slabs;
  PeerCounters counters;
};

/// Pucks, some of them with losses or drag, and posts.
PlayedByTiles expect_same_history(std::uint64_t number, const physics::SlabPlan& plan) {
  const physics::test::SlabScene scene(number);
  physics::World plain = scene.world(QueuePolicy::calendar);
  const physics::World whole = scene.world(QueuePolicy::windows, plan);
  constexpr int windows = 12;
  const double window = scene.duration / windows;
  Assembly assembly(whole, Division::into_strips(whole.spec().field, 2 + number % 2), 0.3, window);
  for (int k = 1; k <= windows && !testing::Test::HasFailure(); ++k) {
    plain.advance(window * k), assembly.advance();
    for (std::uint32_t body = 0; body < whole.body_count(); ++body)
      EXPECT_EQ(bytes_of(assembly.state(body)), bytes_of(physics::Subdomain::state_in(plain, body)))
          << "scene " << number << ", window " << k << ", body " << body;
  }
  PlayedByTiles played;
  for (const Peer& peer : assembly.peers()) {
    const physics::SlabCounters& slabs = peer.world().counters().slabs;
    played.slabs.windows += slabs.windows, played.slabs.undone += slabs.undone;
    played.counters += peer.counters();
  }
  return played;
}

TEST(Tiles, GivePeersTheStatesOfOneEngine) {
  PlayedByTiles sum;
  for (std::uint64_t number = 1; number <= 16; ++number) {
    // Every other one with so wide a window, and without a rim, that it goes wrong now and then.
    const bool is_forced = number % 2 == 0;
    const PlayedByTiles played = expect_same_history(
        number, physics::test::small_tiles(6, is_forced ? 0 : 1, is_forced ? 6.0 : 1.0));
    if (HasFailure()) return;
    sum.slabs.windows += played.slabs.windows, sum.slabs.undone += played.slabs.undone;
    sum.counters += played.counters;
  }
  EXPECT_GT(sum.slabs.windows, 200u);
  EXPECT_GT(sum.slabs.undone, 0u);
  EXPECT_GT(sum.counters.hand_overs, 0u);
}

}  // namespace
}  // namespace rink::peer::test
