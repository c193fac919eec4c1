// A server's game that has more events than it can play in time: it falls behind, says so, and goes
// on to the same game.
#include "game/net/server/tick_budget.h"

#include <gmock/gmock.h>

#include "game/model/scene_file.h"
#include "tests/places.h"

namespace rink::game {
namespace {

using testing::HasSubstr;

Scene crowd() {
  return scaled_to_bats(load_scene(test::source_folder() + "/scenes/crowd.toml"), 5);
}

TEST(ATickBudget, LetsAGamePlayThatKeepsToIt) {
  Game with(crowd()), without(crowd());
  TickBudget budget({.events_per_s = 1'000'000, .tick_s = 0.1}), none({});
  EXPECT_TRUE(budget.advance(with, 1.0));
  EXPECT_TRUE(none.advance(without, 1.0));
  EXPECT_EQ(with.hash(), without.hash());
  EXPECT_EQ(budget.counters().ticks_cut_short, 0u);
  EXPECT_EQ(budget.counters().pace(), 1.0);
  EXPECT_FALSE(budget.take_complaint());
}

TEST(ATickBudget, CutsTicksShortSaysSoOnceInTenTimesAsManyAndChangesNothing) {
  Game with(crowd()), without(crowd());
  TickBudget budget({.events_per_s = 40, .tick_s = 0.1});
  int ticks = 0, complaints = 0;
  for (double until = 0.1; with.now() < 3.0 && ticks < 10'000; ++ticks) {
    budget.advance(with, std::min(until, 3.0));
    until = with.now() + 0.1;
    if (const auto complaint = budget.take_complaint()) {
      if (++complaints == 1)
        EXPECT_THAT(*complaint, HasSubstr("more slowly, by at most 1 events a tick"));
      else EXPECT_THAT(*complaint, HasSubstr("of its pace"));
    }
  }
  without.advance(3.0);
  EXPECT_EQ(with.hash(), without.hash());
  EXPECT_GE(budget.counters().ticks_cut_short, 10u);
  EXPECT_EQ(complaints, budget.counters().ticks_cut_short < 100 ? 2 : 3);
  EXPECT_GT(ticks, 30);
  EXPECT_LT(budget.counters().pace(), 1.0);
  EXPECT_GT(budget.counters().pace(), 0.0);
}

TEST(ATickBudget, PlaysWholeTicksInPartsAndCountsAllOfThem) {
  constexpr double tick_s = 0.1;
  Game with(crowd()), without(crowd());
  TickBudget budget({.events_per_s = 40, .tick_s = tick_s, .has_whole_ticks = true});
  std::uint64_t parts = 0;
  for (int tick = 1; tick <= 30; ++tick)
    while (!budget.advance(with, tick * tick_s)) ++parts;
  without.advance(30 * tick_s);
  EXPECT_EQ(with.hash(), without.hash());
  EXPECT_GE(parts, 10u);
  EXPECT_EQ(budget.counters().ticks_cut_short, parts);
  EXPECT_NEAR(budget.counters().wanted_s - budget.counters().played_s,
              static_cast<double>(parts) * tick_s, 1e-9)
      << "each part but a tick's last has cost a tick";
  const auto complaint = budget.take_complaint();
  ASSERT_TRUE(complaint);
  EXPECT_THAT(*complaint, HasSubstr("of its pace"));
}

TEST(ATickBudget, BeginsAnewWithAnotherGame) {
  Game first(crowd()), second(crowd()), alone(crowd());
  TickBudget budget({.events_per_s = 40, .tick_s = 0.1});
  for (int tick = 0; tick < 50; ++tick) budget.advance(first, 3.0);
  ASSERT_GT(budget.counters().ticks_cut_short, 0u);
  budget.begin();
  while (second.now() < 3.0) budget.advance(second, 3.0);
  alone.advance(3.0);
  EXPECT_EQ(second.hash(), alone.hash());
}

}  // namespace
}  // namespace rink::game
