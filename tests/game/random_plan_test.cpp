// Key plans: reproducible, independent of the crowd's size, and as lively as a human's thumbs.
#include "game/players/random_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace rink::game {
namespace {

bool is_down(const InputEvent& key) { return key.kind == InputKind::key_down; }

std::vector<InputEvent> keys_of(const std::vector<InputEvent>& plan, std::uint32_t player) {
  std::vector<InputEvent> own;
  std::copy_if(plan.begin(), plan.end(), std::back_inserter(own),
               [player](const InputEvent& key) { return key.player == player; });
  return own;
}

TEST(Plan, TheSameSeedGivesTheSameKeysAndAnotherSeedOthers) {
  EXPECT_EQ(random_plan(7, 20, 10.0), random_plan(7, 20, 10.0));
  EXPECT_NE(random_plan(7, 20, 10.0), random_plan(8, 20, 10.0));
}

TEST(Plan, APlayersKeysDoNotDependOnHowManyOthersPlay) {
  const auto few = random_plan(3, 2, 20.0), many = random_plan(3, 300, 20.0);
  for (const std::uint32_t player : {0u, 1u}) {
    EXPECT_EQ(keys_of(few, player), keys_of(many, player));
    EXPECT_EQ(keys_of(few, player), random_player_plan(3, player, 20.0));
  }
}

TEST(Plan, AShorterPlanIsTheBeginningOfALongerOne) {
  const auto shorter = random_plan(5, 30, 4.0), longer = random_plan(5, 30, 9.0);
  ASSERT_LT(shorter.size(), longer.size());
  EXPECT_TRUE(std::equal(shorter.begin(), shorter.end(), longer.begin()));
}

TEST(Plan, KeysAreOrderedInsideTheRunAndAtWholeMicroseconds) {
  const auto plan = random_plan(9, 50, 10.0);
  EXPECT_TRUE(std::is_sorted(plan.begin(), plan.end(), [](const auto& a, const auto& b) {
    return std::tuple(a.time, a.player, a.key) < std::tuple(b.time, b.player, b.key);
  }));
  for (const InputEvent& key : plan) {
    EXPECT_GE(key.time, 0.0);
    EXPECT_LT(key.time, 10.0);
    EXPECT_EQ(key.time, std::round(key.time * 1e6) / 1e6);
  }
}

TEST(Plan, EveryKeyAlternatesAndOpposedKeysAreNeverHeldTogether) {
  std::map<std::uint32_t, std::array<bool, 4>> held;
  for (const InputEvent& key : random_plan(13, 40, 30.0)) {
    std::array<bool, 4>& keys = held[key.player];
    EXPECT_NE(keys[static_cast<std::size_t>(key.key)], is_down(key));
    keys[static_cast<std::size_t>(key.key)] = is_down(key);
    EXPECT_FALSE(keys[0] && keys[1]);
    EXPECT_FALSE(keys[2] && keys[3]);
  }
  EXPECT_EQ(held.size(), 40u);
}

TEST(Plan, PressesLastAsLongAndComeAsOftenAsTheHabitsSay) {
  const double duration_s = 200.0;
  const std::uint32_t players = 50;
  const auto plan = random_plan(17, players, duration_s);
  const double cycles =
      players * 2 * duration_s /
      1.2;  // about 16,700: the mean of as many exponentials is within 3 sigma = 2.4 %
  EXPECT_NEAR(static_cast<double>(plan.size()), 2 * cycles, 0.03 * 2 * cycles);
  std::map<std::pair<std::uint32_t, Key>, double> pressed_at;
  std::vector<double> lengths;
  std::array<double, 4> presses{};
  for (const InputEvent& key : plan) {
    if (is_down(key)) {
      pressed_at[{key.player, key.key}] = key.time;
      presses[static_cast<std::size_t>(key.key)] += 1.0;
    } else {
      lengths.push_back(key.time - pressed_at[{key.player, key.key}]);
    }
  }
  double sum = 0.0;
  for (const double length : lengths) sum += length;
  const double mean = sum / static_cast<double>(lengths.size());
  EXPECT_NEAR(mean, 0.4, 0.4 * 0.03);
  EXPECT_GE(*std::min_element(lengths.begin(), lengths.end()), 0.03 - 1e-6);
  // Memoryless: of the presses above the shortest, exp(-1) outlast their mean.
  const auto outlasting =
      std::count_if(lengths.begin(), lengths.end(), [](double length) { return length > 0.4; });
  EXPECT_NEAR(static_cast<double>(outlasting) / static_cast<double>(lengths.size()), std::exp(-1.0),
              0.015);
  for (const double count : presses) EXPECT_NEAR(count, cycles / 4.0, 0.06 * cycles / 4.0);
}

TEST(Plan, TwoPlayersAreUncorrelated) {
  // Held-right indicators of neighbouring players sampled once per second over 2,000 s: correlation
  // within 4 sigma of 0.
  const auto is_held = [](std::uint32_t player) {
    std::vector<double> samples(2'000, 0.0);
    double since = -1.0;
    for (const InputEvent& key : random_player_plan(23, player, 2'000.0)) {
      if (key.key != Key::right) continue;
      if (is_down(key)) {
        since = key.time;
      } else {
        for (auto second = static_cast<std::size_t>(std::ceil(since));
             static_cast<double>(second) < key.time; ++second)
          samples[second] = 1.0;
      }
    }
    return samples;
  };
  const auto a = is_held(0), b = is_held(1);
  double mean_a = 0.0, mean_b = 0.0, covariance = 0.0;
  for (std::size_t second = 0; second < a.size(); ++second)
    mean_a += a[second] / 2'000.0, mean_b += b[second] / 2'000.0;
  for (std::size_t second = 0; second < a.size(); ++second)
    covariance += (a[second] - mean_a) * (b[second] - mean_b) / 2'000.0;
  const double deviation = std::sqrt(mean_a * (1.0 - mean_a) * mean_b * (1.0 - mean_b));
  EXPECT_LT(std::abs(covariance / deviation), 4.0 / std::sqrt(2'000.0));
}

}  // namespace
}  // namespace rink::game
