// When bots press keys and decide: in one order of all, or each by itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "game/players/player.h"
#include "loadgen/run/bots/decision_schedule.h"
#include "loadgen/run/bots/key_schedule.h"

namespace rink::loadgen {
namespace {

game::InputEvent key(double time, std::uint32_t player,
                     game::InputKind kind = game::InputKind::key_down) {
  return {.time = time, .player = player, .kind = kind, .key = game::Key::up};
}

TEST(AKeySchedule, TakesTheKeysOfItsPlayersInOrderAndNothingElse) {
  KeySchedule keys(
      std::vector{key(0.1, 4), key(0.2, 5), key(0.3, 7), key(0.4, 5, game::InputKind::leave),
                  key(0.5, 6, game::InputKind::key_up), key(0.9, 5)},
      {.first = 5, .count = 2, .until_s = 0.9});
  EXPECT_EQ(keys.next_s(), 0.2);
  EXPECT_EQ(keys.take().bot, 0u);
  const DueKey& last = keys.take();
  EXPECT_EQ(last.bot, 1u);
  EXPECT_FALSE(last.change.is_down);
  EXPECT_FALSE(keys.next_s()) << "the one at the end comes too late";
}

TEST(AKeySchedule, LeavesOutWhatWasPressedInASavedGame) {
  const std::vector plan{key(0.0, 0), key(1.0, 0), key(2.0, 0)};
  EXPECT_EQ(KeySchedule(plan, {.count = 1, .until_s = 9.0}).next_s(), 0.0);
  EXPECT_EQ(KeySchedule(plan, {.count = 1, .begun_s = 1.0, .until_s = 9.0}).next_s(), 2.0);
}

TEST(AKeySchedule, GivesEachBotItsOwnKeysAtItsTurns) {
  const unsigned seed = 11;
  std::mt19937 random(seed);
  constexpr std::uint32_t bots = 7;
  std::vector<game::InputEvent> plan;
  for (int i = 0; i < 500; ++i)
    plan.push_back(key(0.01 * i, static_cast<std::uint32_t>(random() % bots)));
  KeySchedule keys(plan, {.count = bots, .until_s = 100.0});
  std::vector<std::size_t> walked(bots);
  for (double instant = 0.0; instant < 6.0; instant += 0.33)
    for (std::uint32_t bot = 0; bot < bots; ++bot) {
      std::vector<double> expected, taken;
      for (std::size_t& at = walked[bot]; at < plan.size() && plan[at].time <= instant; ++at)
        if (plan[at].player == bot) expected.push_back(plan[at].time);
      while (const DueKey* due = keys.take_due(bot, instant)) taken.push_back(due->time);
      EXPECT_EQ(taken, expected) << "bot " << bot << " at " << instant << ", seed " << seed;
    }
  EXPECT_EQ(keys.take_due(bots, 100.0), nullptr) << "there is no such bot";
}

TEST(ADecisionSchedule, GoesRoundAllBotsByTheirPhasesInEachPeriod) {
  constexpr std::uint32_t first = 3, count = 20;
  DecisionSchedule decisions(first, count);
  double before = 0.0;
  for (int period = 0; period < 3; ++period) {
    std::vector<std::uint32_t> bots;
    for (std::uint32_t i = 0; i < count; ++i) {
      const double instant = decisions.next_s();
      EXPECT_GE(instant, before);
      before = instant;
      bots.push_back(decisions.take());
      EXPECT_DOUBLE_EQ(instant,
                       period * game::decision_period + game::decision_phase(first + bots.back()));
    }
    std::ranges::sort(bots);
    for (std::uint32_t bot = 0; bot < count; ++bot) EXPECT_EQ(bots[bot], bot);
  }
}

TEST(ADecisionSchedule, BeginsInTheMiddleOfAGameThatRuns) {
  DecisionSchedule decisions(0, 3);
  decisions.begin(1.01);
  EXPECT_GE(decisions.next_s(), 1.0);
  EXPECT_LT(decisions.next_s(), 1.0 + game::decision_period);
}

TEST(ADecisionSchedule, LetsABotDecideOnceInAPeriodWhereItTakesTurns) {
  DecisionSchedule decisions(0, 2);
  EXPECT_TRUE(decisions.take_due(1, 0.0));
  EXPECT_FALSE(decisions.take_due(1, 0.5 * game::decision_period));
  EXPECT_TRUE(decisions.take_due(0, 0.5 * game::decision_period));
  EXPECT_TRUE(decisions.take_due(1, game::decision_period));
  DecisionSchedule nobody;
  EXPECT_TRUE(nobody.is_empty());
  EXPECT_FALSE(nobody.take_due(0, 1.0));
}

}  // namespace
}  // namespace rink::loadgen
