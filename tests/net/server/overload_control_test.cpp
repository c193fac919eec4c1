// A server with more clients than it holds, by a modelled clock: a tick costs a fixed time and one
// for each client that it tells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "game/net/server/overload/overload_control.h"

namespace rink::game {
namespace {

constexpr double tick_s = 1.0 / 60.0;

/// Ticks as the loop of a server does: each when it is due, or as soon as the one before has ended.
class ModelledServer {
 public:
  /// Parts of a tick that a tick costs whoever is told, and that telling all clients costs.
  double fixed = 0.1, telling = 0.5;
  double whoever = 0.0;  ///< of telling, what it costs however many are told
  double stall_s = 0.0;  ///< by which the next tick takes longer

  void run(double seconds) {
    const double until_s = now_s + seconds;
    while (now_s < until_s) tick();
  }
  void tick() {
    const std::uint64_t left_out = control.ticks_left_out(due_s(), now_s);
    ticks_left_out += left_out;
    number += left_out;
    const double begin_s = now_s = std::max(now_s, due_s());
    const double telling_s = tick_s * (whoever + telling / control.divisor());
    now_s += tick_s * fixed + telling_s + stall_s;
    stall_s = 0.0;
    behind_max_s = std::max(behind_max_s, now_s - due_s());
    if (control.ticked(due_s(), begin_s, now_s, telling_s)) divisors.push_back(control.divisor());
    is_on_time = now_s <= due_s() + tick_s;
    ++number;
  }
  double due_s() const { return static_cast<double>(number) * tick_s; }

  OverloadControl control{{.tick_s = tick_s}};
  double now_s = 0.0, behind_max_s = 0.0;
  std::uint64_t number = 0, ticks_left_out = 0;
  std::vector<std::uint32_t> divisors;  ///< after each change
  bool is_on_time = true;
};

TEST(OverloadControl, AServerThatHoldsItsClientsTellsThemAsOftenAsAskedFor) {
  ModelledServer server;
  server.fixed = 0.2, server.telling = 0.79;
  server.run(600.0);
  EXPECT_TRUE(server.divisors.empty());
  EXPECT_EQ(server.ticks_left_out, 0u);
}

/// It holds what costs a tick; of four times as many clients each is told in one of four turns or,
/// with what a tick costs else, of six.
TEST(OverloadControl, OfFourTimesTheClientsEachIsToldLessOftenAndTheTicksAreInTimeAgain) {
  for (const double fixed : {0.0, 0.05, 0.2}) {
    ModelledServer server;
    server.fixed = fixed, server.telling = 4.0 * (1.0 - fixed);
    server.run(10.0);
    EXPECT_TRUE(server.is_on_time) << fixed;
    ASSERT_FALSE(server.divisors.empty());
    EXPECT_LE(server.divisors.size(), 2u);
    EXPECT_GE(server.control.divisor(), 4u);
    EXPECT_LE(server.control.divisor(), 6u);
    EXPECT_LE(server.behind_max_s, 1.0 + 5.0 * tick_s) << "what clients hold is not much older";
    const std::vector<std::uint32_t> settled = server.divisors;
    server.run(600.0);
    EXPECT_EQ(server.divisors, settled) << "it does not swing";
    EXPECT_TRUE(server.is_on_time);
  }
}

TEST(OverloadControl, WhenClientsLeaveTheOthersAreToldAsOftenAsBefore) {
  ModelledServer server;
  server.fixed = 0.1, server.telling = 7.0;
  server.run(10.0);
  EXPECT_GE(server.control.divisor(), 8u);
  server.telling = 0.5;
  server.run(20.0);
  EXPECT_EQ(server.control.divisor(), 1u);
  EXPECT_GE(server.control.divisor_reached(), 8u);
  EXPECT_EQ(server.control.changes(), server.divisors.size());
  EXPECT_TRUE(std::is_sorted(server.divisors.rbegin(), server.divisors.rend() - 1))
      << "step by step";
}

TEST(OverloadControl, StallsThatTheTicksMakeUpForChangeNothing) {
  ModelledServer server;
  server.fixed = 0.1, server.telling = 0.6;
  for (int k = 0; k < 100; ++k) {
    server.stall_s = 0.1 + 0.008 * k;
    server.run(5.0);
    EXPECT_TRUE(server.is_on_time) << k;
  }
  EXPECT_TRUE(server.divisors.empty());
}

/// The last resort: what telling nobody would cost is more than there is.
TEST(OverloadControl, TicksAreLeftOutWhereEvenThatDoesNotDo) {
  ModelledServer server;
  server.fixed = 1.5, server.telling = 40.0;
  server.run(60.0);
  EXPECT_EQ(server.control.divisor(), OverloadControl::divisor_max);
  EXPECT_GT(server.ticks_left_out, 1000u);
  EXPECT_LE(server.behind_max_s, 1.0 + 42.0 * tick_s);
  EXPECT_NEAR(server.due_s(), server.now_s, 1.1) << "the game goes on at full pace";
}

/// Each client told at one tick of sixteen, which take half a second each, would wait 8 s for news
/// of what telling everybody adds a third of a second to.
TEST(OverloadControl, WhereTheGameAloneTakesTooLongClientsAreToldAsOftenAsBefore) {
  ModelledServer server;
  server.fixed = 30.0, server.telling = 20.0;
  server.run(60.0);
  EXPECT_EQ(server.control.divisor_reached(), 1u);
}

TEST(OverloadControl, WhereItDoesAndSoDoesTellingHalfOfTheTimeIsForTelling) {
  ModelledServer server;
  server.fixed = 10.0, server.telling = 21.0;
  server.run(60.0);
  EXPECT_EQ(server.control.divisor(), 2u);
  server.run(600.0);
  EXPECT_EQ(server.divisors.size(), 1u) << "it does not swing";
}

TEST(OverloadControl, WhenTheGameGrowsTooLongClientsAreToldMoreOftenAgain) {
  ModelledServer server;
  server.fixed = 0.5, server.telling = 10.0;
  server.run(20.0);
  EXPECT_EQ(server.control.divisor_reached(), 16u);
  server.fixed = 30.0;
  server.run(60.0);
  EXPECT_EQ(server.control.divisor(), 1u) << "telling all takes a quarter of the time";
}

/// Of telling only a part shrinks with the divisor.
TEST(OverloadControl, EachClientIsToldWithinTwoSecondsIfThatCanBe) {
  ModelledServer server;
  server.fixed = 0.5, server.telling = 12.0;
  server.run(20.0);
  EXPECT_EQ(server.control.divisor(), 16u);
  server.fixed = 6.0, server.whoever = 6.0;
  server.run(120.0);
  EXPECT_LE(server.control.divisor() * (12.0 + 12.0 / server.control.divisor()) * tick_s, 2.0);
  EXPECT_GE(server.control.divisor(), 4u);
  const std::vector<std::uint32_t> settled = server.divisors;
  server.run(600.0);
  EXPECT_EQ(server.divisors, settled) << "it does not swing";
}

TEST(OverloadControl, WhatTellingLessOftenMendsIsMended) {
  ModelledServer server;
  server.fixed = 0.7, server.telling = 0.5;
  server.run(20.0);
  EXPECT_TRUE(server.is_on_time);
  EXPECT_GT(server.control.divisor(), 1u);
}

/// A load of which nobody can say whether it fits: it is tried ever more rarely.
TEST(OverloadControl, ALoadOnTheBorderIsTriedEverMoreRarely) {
  ModelledServer server;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.3, 1.0);
  double load = 0.7;
  for (int second = 0; second < 1800; ++second) {
    if (server.control.divisor() == 1) load = 1.05;  // each client more often than half costs more
    else load = share(random);
    server.fixed = 0.0, server.telling = load;
    server.run(1.0);
  }
  EXPECT_GE(server.divisors.size(), 8u);
  EXPECT_LE(server.divisors.size(), 80u) << "1,800 s, of which each attempt lasts half of one";
}

}  // namespace
}  // namespace rink::game
