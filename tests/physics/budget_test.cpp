// A limit to the events of a simulated second: where it stops, whom it names and why, and that
// going on gives the bits of a world that never stopped.
#include "game/physics/event_budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "game/physics/overrun.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {
namespace {

/// Pucks that fill a row from wall to wall but for 1e-13 m; one goes 50 m/s.
World full_row() {
  constexpr int count = 15;
  const double radius = 1.0 / 32.0;
  World world(rink_of(2.0 * radius * count + 1e-13, 0.25));
  for (int k = 0; k < count; ++k)
    world.add(PuckSpec{.position = {radius * (2 * k + 1), 0.125},
                       .velocity = {k == 7 ? 50.0 : 0.0, 0.0},
                       .radius = radius});
  return world;
}

/// Pucks of 1 kg and 1 m/s, and one of 1e-8 kg that has as much energy.
World equipartition() {
  World world(rink_of(2.0, 2.0));
  std::mt19937_64 random(1);
  for (int k = 0; k < 9; ++k)
    world.add(PuckSpec{.position = {0.4 + 0.6 * (k % 3), 0.4 + 0.6 * (k / 3)},
                       .velocity = {uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)},
                       .radius = 0.2});
  world.add(PuckSpec{.position = {0.7, 0.7}, .velocity = {6e3, 8e3}, .mass = 1e-8});
  return world;
}

/// A bat that presses a puck to a lossless wall.
World lossless_press() {
  World world(rink_of(2.0, 1.0));
  world.add(PuckSpec{.position = {1.9, 0.5}, .velocity = {0.1, 0.0}, .mass = 1e-6});
  const BodyId bat = world.add(BatSpec{.position = {1.7, 0.5}, .mass = 1e3});
  world.set_thrust(bat, {5.0, 0.0});
  return world;
}

World gas() {
  World world(rink_of(4.0, 2.0));
  std::mt19937_64 random(5);
  scatter_pucks(world, random, 100);
  return world;
}

/// What stops `world` on its way to `until`; nothing if it gets there.
std::optional<Overrun> overrun_on_the_way(World& world, double until, std::uint64_t events_per_s) {
  EventBudget budget(events_per_s);
  EXPECT_EQ(world.advance(until, budget), std::nullopt);
  if (!budget.is_exceeded()) return std::nullopt;
  return overrun_of(world, budget);
}

TEST(Budget, NamesTheRowWithoutRoom) {
  World world = full_row();
  const std::optional<Overrun> overrun = overrun_on_the_way(world, 1.0, 100'000);
  ASSERT_TRUE(overrun);
  EXPECT_EQ(overrun->time, world.now());
  EXPECT_LT(overrun->time, 1e-6);
  EXPECT_GT(overrun->events, 100'000u);
  EXPECT_EQ(overrun->looked_at, EventBudget::recent_max);
  ASSERT_EQ(overrun->busiest.size(), Overrun::busiest_max);
  for (const BusyBody& busy : overrun->busiest) {
    EXPECT_EQ(busy.reason, OverrunReason::no_room) << busy.body.index;
    EXPECT_LT(busy.free_path, 1e-12);
    EXPECT_GT(busy.free_path, 0.0);
  }
  EXPECT_NE(text_of(*overrun).find("with no room"), std::string::npos) << text_of(*overrun);
}

TEST(Budget, NamesTheLightOneAmongTheHeavy) {
  World world = equipartition();
  const std::optional<Overrun> overrun = overrun_on_the_way(world, 1.0, 5'000);
  ASSERT_TRUE(overrun);
  ASSERT_FALSE(overrun->busiest.empty());
  const BusyBody& light = overrun->busiest.front();
  EXPECT_EQ(light.body.index, 9u);
  EXPECT_EQ(light.reason, OverrunReason::light);
  EXPECT_DOUBLE_EQ(light.mass_ratio, 1e8);
  EXPECT_GT(light.share, 0.9);
}

TEST(Budget, NamesWhatThrustPresses) {
  World world = lossless_press();
  const std::optional<Overrun> overrun = overrun_on_the_way(world, 20.0, 100);
  ASSERT_TRUE(overrun);
  for (const BusyBody& busy : overrun->busiest)
    EXPECT_EQ(busy.reason, OverrunReason::pressed) << text_of(*overrun);
}

TEST(Budget, SaysOfAGasThatNobodyStandsOut) {
  World world = gas();
  const std::optional<Overrun> overrun = overrun_on_the_way(world, 10.0, 100);
  ASSERT_TRUE(overrun);
  EXPECT_EQ(overrun->looked_at, 101u);
  for (const BusyBody& busy : overrun->busiest) {
    EXPECT_EQ(busy.reason, OverrunReason::common) << text_of(*overrun);
    EXPECT_GT(busy.free_path, 1e-3);
  }
}

TEST(Budget, StopsNobodyWhoKeepsToIt) {
  World with = gas(), without = gas();
  EXPECT_FALSE(overrun_on_the_way(with, 2.0, 100'000));
  without.advance(2.0);
  EXPECT_EQ(with.hash(), without.hash());
  EXPECT_EQ(with.counters(), without.counters());
}

TEST(Budget, StopsWhereTheEventsSayWhereverAdvanceStoppedBefore) {
  World at_once = gas(), in_parts = gas();
  const double stop = overrun_on_the_way(at_once, 10.0, 100)->time;
  EXPECT_GT(stop, 0.0);
  EventBudget budget(100);
  for (int k = 1; k < 640 && !budget.is_exceeded(); ++k) in_parts.advance(k / 64.0, budget);
  EXPECT_EQ(in_parts.now(), stop);
  EXPECT_EQ(in_parts.hash(), at_once.hash());
}

TEST(Budget, StopsAtTheFirstInstantOfASceneThatExceedsItThere) {
  World world(rink_of(4.0, 1.0));  // eight pairs that touch and close
  for (int k = 0; k < 8; ++k)
    for (int side = 0; side < 2; ++side)
      world.add(PuckSpec{.position = {0.25 + 0.5 * k + 0.125 * side, 0.5},
                         .velocity = {side == 0 ? 1.0 : -1.0, 0.0},
                         .radius = 0.0625});
  World without = *World::restore(world.save());
  EventBudget budget(1);
  world.advance(0.0, budget);
  ASSERT_TRUE(budget.is_exceeded());
  EXPECT_EQ(world.now(), 0.0);
  EXPECT_EQ(overrun_of(world, budget).span, 0.0);
  world.advance(1.0);
  without.advance(1.0);
  EXPECT_EQ(world.hash(), without.hash());
}

/// Random scenes of bats under keys among pucks and posts; `advance` goes to an instant.
class Keyed {
 public:
  explicit Keyed(std::uint64_t number)
      : world(rink_of(3.0, 2.0, number % 3 == 0 ? 1.0 : 0.3 * static_cast<double>(number % 3),
                      number % 2 == 0 ? 0.2 : 0.0, 1.0)),
        random_(number) {
    scatter_posts(world, random_, 2);
    bats_ = scatter_bats(world, random_, 6);
    scatter_pucks(world, random_, 30, 0.1, 1.0);
  }
  template <class Advance>
  void play(double until, Advance&& advance) {
    for (double time = 0.05; time < until; time += uniform(random_, 0.0, 0.1)) {
      advance(time);
      const double x = static_cast<double>(random_() % 3) - 1.0,
                   y = static_cast<double>(random_() % 3) - 1.0;
      world.set_thrust(bats_[random_() % bats_.size()], {6.0 * x, 6.0 * y});
    }
    advance(until);
  }

  World world;

 private:
  std::mt19937_64 random_;
  std::vector<BodyId> bats_;
};

TEST(Budget, WhoGoesOnComesToTheSameBitsFromASnapshotToo) {
  for (std::uint64_t number = 0; number < 12; ++number) {
    SCOPED_TRACE(number);
    Keyed with(number), restored(number), without(number);
    without.play(3.0, [&](double time) { without.world.advance(time); });
    EventBudget budget(20), other(20);
    int stops = 0;
    const auto go = [&](World& world, EventBudget& limit, double time, auto&& at_stop) {
      for (world.advance(time, limit); limit.is_exceeded(); world.advance(time, limit)) {
        at_stop();
        limit.grant(3);
      }
    };
    with.play(3.0, [&](double time) { go(with.world, budget, time, [&] { ++stops; }); });
    restored.play(3.0, [&](double time) {
      go(restored.world, other, time,
         [&] { restored.world = *World::restore(restored.world.save()); });
    });
    EXPECT_GT(stops, 10);
    EXPECT_EQ(with.world.hash(), without.world.hash());
    EXPECT_EQ(restored.world.hash(), without.world.hash());
    EXPECT_EQ(with.world.counters(), without.world.counters());
  }
}

TEST(Budget, EndsAtGoalsToo) {
  WorldSpec spec = rink_of(2.0, 1.0);
  spec.field.goal_width = 0.5;
  World world(spec);
  const BodyId puck = world.add(PuckSpec{.position = {0.5, 0.5}, .velocity = {-1.0, 0.0}});
  EventBudget budget(100);
  const std::optional<Goal> goal = world.advance(2.0, budget);
  ASSERT_TRUE(goal);
  EXPECT_EQ(goal->puck, puck);
  EXPECT_FALSE(budget.is_exceeded());
}

TEST(Budget, CountsBySecondsAndGrantsAtMostOne) {
  EventBudget budget(2);
  for (const double time : {0.5, 1.0, 1.5, 2.0}) budget.charge({.time = time});
  EXPECT_EQ(budget.spent(), 2u) << "1.5 s begins a second of its own";
  EXPECT_FALSE(budget.is_exceeded());
  budget.charge({.time = 2.0, .count = 5});
  EXPECT_EQ(budget.spent(), 7u);
  EXPECT_TRUE(budget.is_exceeded());
  budget.grant(1'000);
  EXPECT_EQ(budget.spent(), 0u);
  budget.grant(1);
  EXPECT_EQ(budget.spent(), 1u);
}

TEST(Budget, KeepsTheLastEventsInTheirOrder) {
  EventBudget budget(1'000'000);
  for (std::uint32_t k = 0; k < 10'000; ++k) budget.charge({.time = 0.0, .body = k});
  const std::vector<ChargedEvent> recent = budget.recent();
  ASSERT_EQ(recent.size(), EventBudget::recent_max);
  for (std::size_t k = 0; k < recent.size(); ++k)
    ASSERT_EQ(recent[k].body, 10'000 - EventBudget::recent_max + k);
}

/// Of a gas among posts, whose impacts are left to the last pass, and walls.
TEST(Budget, NamesTheSameEventsWhetherTilesPlayedThemOrNot) {
  WorldSpec spec = rink_of(12.0, 6.0, 1.0);
  spec.slabs = SlabPlan{.tile_cells = 8, .bodies_min = 0, .last_pass_max = 1.0};
  WorldSpec plain = spec;
  plain.slabs.reset();
  World by_tiles(spec), in_order(plain);
  EventBudget budgets[] = {EventBudget(1'000'000), EventBudget(1'000'000)};
  for (World* world : {&by_tiles, &in_order}) {
    std::mt19937_64 random(11);
    scatter_posts(*world, random, 5);
    scatter_pucks(*world, random, 600);
    world->advance(2.5, budgets[world == &in_order]);
  }
  EXPECT_GT(by_tiles.counters().slabs.windows, 10u);
  EXPECT_GT(by_tiles.counters().slabs.windows, 2 * by_tiles.counters().slabs.undone);
  EXPECT_EQ(by_tiles.hash(), in_order.hash());
  EXPECT_EQ(budgets[0].spent(), budgets[1].spent());
  const std::vector<ChargedEvent> recent = budgets[0].recent(), expected = budgets[1].recent();
  ASSERT_EQ(recent.size(), expected.size());
  EXPECT_GT(recent.size(), 1000u);
  for (std::size_t k = 0; k < recent.size(); ++k) {
    ASSERT_EQ(recent[k].time, expected[k].time) << k;
    EXPECT_EQ(std::minmax(recent[k].body, recent[k].partner),
              std::minmax(expected[k].body, expected[k].partner))
        << k;
    EXPECT_EQ(recent[k].count, expected[k].count) << k;
  }
}

#ifndef NDEBUG

TEST(BudgetDeathTest, NamesWhatIsWrong) {
  EXPECT_DEATH(EventBudget(0), "events_per_s > 0");
  EventBudget budget(1);
  World world = gas();
  EXPECT_DEATH(overrun_of(world, budget), "is_exceeded");
  world.advance(10.0, budget);
  EXPECT_DEATH(world.advance(10.0, budget), "is_exceeded");
  EXPECT_DEATH(budget.charge({.time = 20.0}), "is_exceeded");
}

#endif

}  // namespace
}  // namespace rink::physics::test
