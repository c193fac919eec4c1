// Tiles of a world played by any number of threads: the bits, events and counters of one.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "game/physics/world.h"
#include "game/process/thread_team.h"
#include "tests/physics/slab_journal.h"
#include "tests/physics/slab_scene.h"

namespace rink::physics::test {
namespace {

using game::ThreadTeam;

SlabPlan shared_tiles(int cells, int radius, double window) {
  SlabPlan plan = small_tiles(cells, radius, window);
  plan.shared_min = 0;
  return plan;
}

std::vector<BodyId> all_changes(const World& world, ChangeCursor& cursor) {
  const auto changes = world.changed(cursor);
  return {changes.begin(), changes.end()};
}

/// Plays `world` beside `alone`, which nobody helps, and beside the plain loop.
void expect_same_with(std::uint32_t threads, const SlabScene& scene, const SlabPlan& plan) {
  SCOPED_TRACE(testing::Message() << threads << " threads");
  ThreadTeam team(threads);
  SlabPlan with_team = plan;
  with_team.workers = &team;
  World plain = scene.world(QueuePolicy::calendar), alone = scene.world(QueuePolicy::windows, plan),
        shared = scene.world(QueuePolicy::windows, with_team);
  ChangeCursor of_alone, of_shared;
  for (int stop = 1; stop <= 3; ++stop) {
    const double until = scene.duration * stop / 3;
    plain.advance(until), alone.advance(until), shared.advance(until);
    expect_same(shared, plain);
    if (testing::Test::HasFatalFailure()) return;
    EXPECT_EQ(shared.counters(), alone.counters()) << "bookkeeping, too";
    EXPECT_EQ(shared.save(), alone.save());
    EXPECT_EQ(all_changes(shared, of_shared), all_changes(alone, of_alone));
  }
  EXPECT_GT(shared.counters().slabs.windows, 0u);
}

TEST(ThreadedSlabs, HaveTheSameBitsForAnyNumberOfThreads) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    // Every other one with so wide a window, and without a rim, that it goes wrong now and then.
    const bool is_forced = seed % 2 == 0;
    const SlabScene scene(seed);
    const SlabPlan plan =
        shared_tiles(4 + static_cast<int>(seed % 5), is_forced ? 0 : 1, is_forced ? 6.0 : 1.0);
    for (const std::uint32_t threads : {1u, 2u, 3u, 5u}) {
      expect_same_with(threads, scene, plan);
      if (HasFatalFailure()) return;
    }
  }
}

/// Each worker writes its part of it.
TEST(ThreadedSlabs, WriteTheJournalOfThePlainLoop) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    for (const std::uint32_t threads : {1u, 2u}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << threads << " threads");
      const bool is_forced = seed % 2 == 0;
      ThreadTeam team(threads);
      SlabPlan plan = shared_tiles(5, is_forced ? 0 : 1, is_forced ? 6.0 : 1.0);
      plan.workers = &team;
      const MatchScene scene(seed);
      const World whole = scene.world(QueuePolicy::calendar);
      PartsBySlabs parts(whole, plan, seed);
      EXPECT_GT(parts.play(scene.duration, 4).slabs.windows, 0u);
      if (HasFatalFailure()) return;
    }
}

TEST(ThreadedSlabs, MayHaveMoreThreadsThanBodies) {
  SlabScene scene(3);
  scene.pucks.resize(12), scene.posts = 0;
  expect_same_with(19, scene, shared_tiles(4, 1, 1.0));
}

TEST(ThreadedTeam, RunsEachWorkerOnceAndWaits) {
  for (const std::uint32_t count : {1u, 2u, 7u}) {
    ThreadTeam team(count);
    ASSERT_EQ(team.count(), count);
    std::vector<int> calls(count);
    for (int round = 1; round <= 50; ++round) {
      auto task = [&](std::uint32_t worker) { ++calls[worker]; };
      run_on(team, task);
      EXPECT_EQ(calls, std::vector<int>(count, round));
    }
  }
}

}  // namespace
}  // namespace rink::physics::test
