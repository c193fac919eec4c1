// Windows played by tiles have the bits, the events and the physical counters of the plain loop,
// whatever the tiles, the windows and the block radius.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "game/physics/event_budget.h"
#include "game/physics/world.h"
#include "tests/physics/scenes.h"
#include "tests/physics/slab_scene.h"

namespace rink::physics::test {
namespace {

SlabCounters play(std::uint64_t seed, const SlabPlan& plan) {
  SCOPED_TRACE(testing::Message() << "seed " << seed << ", tiles " << plan.tile_cells << ", radius "
                                  << plan.block_radius << ", windows " << plan.window);
  SlabScene scene(seed);
  World plain = scene.world(QueuePolicy::calendar), slabs = scene.world(QueuePolicy::windows, plan);
  const int stops = 1 + static_cast<int>(scene.random() % 4);
  for (int stop = 1; stop <= stops; ++stop) {
    plain.advance(scene.duration * stop / stops), slabs.advance(scene.duration * stop / stops);
    expect_same(slabs, plain);
    if (testing::Test::HasFatalFailure()) break;
  }
  EXPECT_EQ(slabs.max_overlap(), plain.max_overlap());
  return slabs.counters().slabs;
}

void play_many(std::uint64_t first, std::uint64_t last) {
  SlabCounters sum, forced;
  for (std::uint64_t seed = first; seed < last; ++seed) {
    std::mt19937_64 random(seed + 77);
    // Every other one with so wide a window, and without a rim, that it goes wrong now and then.
    const bool is_forced = seed % 2 == 0;
    const SlabCounters played =
        play(seed, small_tiles(4 + static_cast<int>(random() % 13),
                               is_forced ? 0 : 1 + static_cast<int>(random() % 2),
                               is_forced ? uniform(random, 2.0, 12.0) : 1.0));
    if (testing::Test::HasFatalFailure()) return;
    (is_forced ? forced : sum).windows += played.windows;
    (is_forced ? forced : sum).undone += played.undone;
    (is_forced ? forced : sum).late += played.late;
  }
  EXPECT_GT(sum.windows, 0u);
  EXPECT_GT(forced.late, 0u);
  EXPECT_GT(forced.undone, 0u);
  EXPECT_LT(sum.undone, sum.windows / 2u);
  testing::Test::RecordProperty("undone", static_cast<int>(forced.undone));
}

TEST(Slabs, HaveTheBitsOfThePlainLoop) { play_many(1, 60); }
TEST(SlabsLong, HaveTheBitsOfThePlainLoopInAThousandScenes) { play_many(1000, 2000); }

/// A puck at rest that a tile had awakened was unknown to the plain loop, which played the rest.
TEST(Slabs, TellThePlainLoopWhoWasAwakened) { play(1105, small_tiles(15, 1, 1.0)); }

/// With bats under keys, and now and then goals, which undo the window that they come in.
SlabCounters play_with_bats(std::uint64_t seed) {
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  SlabScene scene(seed);
  if (seed % 4 == 0) scene.spec.field.goal_width = 0.3 * scene.spec.field.width;
  scene.duration *= 2.0;
  World plain = scene.world(QueuePolicy::calendar),
        slabs = scene.world(QueuePolicy::windows, small_tiles(6, 1, 1.0));
  std::vector<RandomKeys> keys;
  std::vector<std::vector<BodyId>> bats;
  for (World* world : {&plain, &slabs}) {
    std::mt19937_64 random(seed);
    bats.push_back(scatter_bats(*world, random, 1 + static_cast<int>(seed % 4)));
    keys.push_back({random, scene.duration / 10.0});
  }
  for (int stop = 1; stop <= 3 && !bats[0].empty(); ++stop) {
    keys[0].play(plain, bats[0], scene.duration * stop / 3);
    keys[1].play(slabs, bats[1], scene.duration * stop / 3);
    expect_same(slabs, plain);
    if (testing::Test::HasFatalFailure()) break;
  }
  return slabs.counters().slabs;
}

void play_many_with_bats(std::uint64_t first, std::uint64_t last) {
  SlabCounters sum;
  for (std::uint64_t seed = first; seed < last; ++seed) {
    const SlabCounters played = play_with_bats(seed);
    if (testing::Test::HasFatalFailure()) return;
    sum.windows += played.windows, sum.undone += played.undone;
  }
  EXPECT_GT(sum.windows, 5 * (last - first));
  EXPECT_LT(sum.undone, sum.windows / 2u);
}

TEST(Slabs, HaveTheBitsOfThePlainLoopWithBatsAndGoals) { play_many_with_bats(1, 30); }
TEST(SlabsLong, HaveTheBitsOfThePlainLoopWithBatsAndGoalsInManyScenes) {
  play_many_with_bats(1000, 1300);
}

void expect_same_charges(const EventBudget& slabs, const EventBudget& plain) {
  ASSERT_EQ(slabs.spent(), plain.spent());
  const std::vector<ChargedEvent> found = slabs.recent(), expected = plain.recent();
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    const ChargedEvent &x = found[k], &y = expected[k];
    ASSERT_TRUE(x.time == y.time && x.count == y.count && x.is_hop == y.is_hop &&
                std::minmax(x.body, x.partner) == std::minmax(y.body, y.partner))
        << k << " at " << x.time << " and " << y.time;
  }
}

/// With bats in many cells, and goals, at which time stops and no window goes on.
SlabCounters play_match(std::uint64_t seed) {
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  const MatchScene scene(seed);
  World plain = scene.world(QueuePolicy::calendar),
        slabs = scene.world(QueuePolicy::windows, small_tiles(6, 1, 1.0));
  for (int stop = 1; stop <= 3; ++stop) {
    const double until = scene.duration * stop / 3;
    for (bool is_over = false; !is_over;) {
      const auto of_plain = plain.advance(until), of_slabs = slabs.advance(until);
      EXPECT_EQ(of_slabs.has_value(), of_plain.has_value());
      if (of_plain && of_slabs) {
        EXPECT_EQ(of_slabs->puck, of_plain->puck);
        EXPECT_EQ(of_slabs->time, of_plain->time);
      }
      is_over = !of_plain || !of_slabs;
    }
    expect_same(slabs, plain);
    if (testing::Test::HasFatalFailure()) break;
  }
  EXPECT_EQ(slabs.max_overlap(), plain.max_overlap());
  return slabs.counters().slabs;
}

void play_many_matches(std::uint64_t first, std::uint64_t last) {
  SlabCounters sum;
  for (std::uint64_t seed = first; seed < last; ++seed) {
    const SlabCounters played = play_match(seed);
    if (testing::Test::HasFailure()) return;
    sum.windows += played.windows, sum.undone += played.undone;
  }
  EXPECT_GT(sum.windows, 10 * (last - first));
  EXPECT_LT(sum.undone, sum.windows / 2u);
}

TEST(Slabs, HaveTheBitsOfThePlainLoopInMatches) { play_many_matches(1, 40); }
TEST(SlabsLong, HaveTheBitsOfThePlainLoopInManyMatches) { play_many_matches(1000, 1500); }

TEST(Slabs, SpendABudgetAsThePlainLoopDoes) {
  constexpr std::uint64_t events_per_s = 2000;
  std::uint64_t windows = 0, stops = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const SlabScene scene(seed);
    World plain = scene.world(QueuePolicy::calendar),
          slabs = scene.world(QueuePolicy::windows, small_tiles(6, 1, 1.0));
    EventBudget of_plain(events_per_s), of_slabs(events_per_s);
    while (plain.now() < scene.duration) {
      plain.advance(scene.duration, of_plain), slabs.advance(scene.duration, of_slabs);
      ASSERT_EQ(slabs.now(), plain.now());
      expect_same_charges(of_slabs, of_plain);
      expect_same(slabs, plain);
      if (testing::Test::HasFatalFailure()) return;
      if (!of_plain.is_exceeded()) continue;
      of_plain.grant(1500), of_slabs.grant(1500), ++stops;
    }
    windows += slabs.counters().slabs.windows;
  }
  EXPECT_GT(windows, 20u);
  EXPECT_GT(stops, 0u);
}

/// Cells are made anew for the small ones when the world advances, and the large ones, which move,
/// become too wide for them.
TEST(Slabs, LeaveBodiesThatTheGridHasMadeWideToTheLastPass) {
  const auto world_of = [](const std::optional<SlabPlan>& plan) {
    WorldSpec spec = rink_of(5.4 + 1.4, 3.0);
    spec.queue = QueuePolicy::windows, spec.slabs = plan;
    World world(spec);
    for (int k = 0; k < 100; ++k)
      world.add(PuckSpec{.position = {5.5 + 0.13 * (k % 10), 0.1 + 0.13 * (k / 10)},
                         .velocity = {0.1, 0.2},
                         .radius = 0.06});
    std::mt19937_64 random(3);
    for (int k = 0; k < 5400; ++k) {
      const double angle = uniform(random, 0.0, 6.283185307179586);
      world.add(PuckSpec{.position = {0.03 * (k % 180 + 0.5), 0.03 * (k / 180 + 0.5)},
                         .velocity = {std::cos(angle), std::sin(angle)},
                         .radius = 0.005});
    }
    world.record_events(true);
    world.advance(0.05);
    return world;
  };
  expect_same(world_of(small_tiles(15, 1, 1.0)), world_of(std::nullopt));
}

/// One falls onto a wall, another comes along it, and they meet at the very instant.
TEST(Slabs, LeavePairsThatHitAWallAtTheSameInstantToThePlainLoop) {
  std::uint64_t joint = 0;
  for (const double up : {0.005, 0.01, 0.03})
    for (int nudge = -10; nudge <= 10; ++nudge) {
      SCOPED_TRACE(testing::Message() << up << ", " << nudge);
      const auto world_of = [&](QueuePolicy queue, const std::optional<SlabPlan>& plan) {
        WorldSpec spec = rink_of(4.0, 4.0, 1.0);
        spec.queue = queue, spec.slabs = plan, spec.cell_size = 0.1;
        World world(spec);
        world.record_events(true);
        world.add(PuckSpec{.position = {2.0, 0.54}, .velocity = {0.0, -1.0}});
        world.add(
            PuckSpec{.position = {2.5 + std::sqrt(0.0064 - up * up) + nudge * 4.44e-16, 0.04 + up},
                     .velocity = {-1.0, 0.0}});
        std::mt19937_64 random(1);
        for (int k = 0; k < 300; ++k) {
          const Vector2 place(uniform(random, 0.1, 3.9), uniform(random, 1.2, 3.9));
          const double angle = uniform(random, 0.0, 6.283185307179586);
          if (world.is_free(place, 0.04))
            world.add(PuckSpec{.position = place, .velocity = {std::cos(angle), std::sin(angle)}});
        }
        world.advance(0.7);
        return world;
      };
      const World plain = world_of(QueuePolicy::calendar, std::nullopt);
      expect_same(world_of(QueuePolicy::windows, small_tiles(12, 1, 1.0)), plain);
      joint += plain.counters().joint_impacts;
    }
  EXPECT_GT(joint, 20u);
}

/// The second of them is due when the first has been told.
TEST(Slabs, TellTwoGoalsOfOneInstantOneAfterTheOther) {
  const auto goals_of = [](QueuePolicy queue, const std::optional<SlabPlan>& plan) {
    WorldSpec spec = rink_of(4.0, 4.0);
    spec.field.goal_width = 1.2;
    spec.queue = queue, spec.slabs = plan;
    World world(spec);
    for (const double y : {1.8, 2.2})
      world.add(PuckSpec{.position = {0.5, y}, .velocity = {-1.0, 0.0}});
    for (int k = 0; k < 400; ++k)
      world.add(PuckSpec{.position = {1.2 + 0.13 * (k % 20), 0.2 + 0.18 * (k / 20)},
                         .velocity = {k * 7 % 11 * 0.02 - 0.1, k * 5 % 13 * 0.02 - 0.12}});
    std::vector<std::uint32_t> pucks;
    for (int goal = 0; goal < 2; ++goal)
      if (const std::optional<Goal> scored = world.advance(2.0))
        pucks.push_back(scored->puck.index);
    return std::pair(pucks, world.hash());
  };
  const auto plain = goals_of(QueuePolicy::calendar, std::nullopt);
  EXPECT_EQ(plain.first.size(), 2u);
  EXPECT_EQ(goals_of(QueuePolicy::windows, small_tiles(6, 1, 1.0)), plain);
}

/// Impacts without any bounce bring each other about at one instant, in an order that neither time
/// nor numbers tell.
TEST(Slabs, WriteChainsOfOneInstantAsTheyCameAbout) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SlabScene scene(seed);
    scene.spec.restitution = RestitutionTable(1, 0.0);
    World slabs = scene.world(QueuePolicy::windows, small_tiles(15, 1, 1.0)),
          plain = scene.world(QueuePolicy::calendar);
    slabs.advance(scene.duration), plain.advance(scene.duration);
    expect_same(slabs, plain);
  }
}

/// Those with friction, at surfaces or with the table, and those where bodies may overlap.
TEST(Slabs, LeaveWorldsOfOtherKindsToThePlainLoop) {
  WorldSpec on_table = rink_of(4.0, 2.0, 0.8, 0.2, 1.0), at_surfaces = on_table,
            overlapping = on_table;
  on_table.puck_friction = 0.1;
  at_surfaces.surface_friction = SurfaceFriction{PairTable(1, 0.3), RestitutionTable(1, 0.5)};
  overlapping.allow_overlap = true;
  for (const WorldSpec& kind : {on_table, at_surfaces, overlapping}) {
    WorldSpec spec = kind, plain_spec = kind;
    spec.queue = QueuePolicy::windows, spec.slabs = small_tiles(4, 2, 1.0);
    plain_spec.slabs.reset();
    World slabs(spec), plain(plain_spec);
    for (World* world : {&slabs, &plain}) {
      std::mt19937_64 random(5);
      scatter_bats(*world, random, 4);
      scatter_pucks(*world, random, 30);
    }
    slabs.advance(3.0), plain.advance(3.0);
    EXPECT_EQ(slabs.hash(), plain.hash());
    EXPECT_EQ(slabs.counters().slabs.windows, 0u);
  }
}

/// One puck runs into a field of resting ones; by and by all move.
TEST(Slabs, BeginToPlayWhenThereIsEnoughToDo) {
  const auto world_of = [](const std::optional<SlabPlan>& plan) {
    WorldSpec spec = rink_of(4.0, 4.0);
    spec.slabs = plan;
    World world(spec);
    world.add(PuckSpec{.position = {0.05, 2.03}, .velocity = {20.0, 1.0}});
    for (int k = 0; k < 400; ++k)
      world.add(PuckSpec{.position = {0.3 + 0.18 * (k % 20), 0.2 + 0.18 * (k / 20)}});
    world.record_events(true);
    world.advance(2.0);
    return world;
  };
  SlabPlan plan = small_tiles(6, 1, 1.0);
  plan.bodies_min = 300;
  const World slabs = world_of(plan);
  expect_same(slabs, world_of(std::nullopt));
  EXPECT_GT(slabs.counters().slabs.windows, 0u);
}

}  // namespace
}  // namespace rink::physics::test
