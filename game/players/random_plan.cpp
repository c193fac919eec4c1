// Makes seeded key plans by own distributions, since those of the standard library differ between
// libraries.
#include "game/players/random_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "game/model/random_stream.h"

namespace rink::game {
namespace {

constexpr Key keys_of_axis[2][2] = {{Key::left, Key::right}, {Key::up, Key::down}};

/// An exponential wait that is never below `shortest_s` and keeps the mean, in whole microseconds:
/// a last-bit difference between two libraries' logarithms cannot reach the plan. The logarithm's
/// argument is within (0, 1].
std::int64_t wait_us(RandomStream& random, double mean_s, double shortest_s) {
  assert(shortest_s > 0.0 && mean_s > shortest_s);
  return std::llround((shortest_s - (mean_s - shortest_s) * std::log(random.uniform() + 0x1p-53)) *
                      1e6);
}

/// A player's axis whose keys are planned.
struct PlayerAxis {
  std::uint32_t player;
  std::size_t axis;
};

void plan_axis(std::vector<InputEvent>& keys, std::uint64_t seed, const PlayerAxis& of,
               double duration_s, const PressHabits& habits) {
  const auto [player, axis] = of;
  RandomStream random(seed, 2 * std::uint64_t{player} + axis);
  assert(axis < 2 && std::isfinite(duration_s));
  const auto end_us = static_cast<std::int64_t>(std::floor(duration_s * 1e6));
  std::int64_t now_us = 0;
  while (true) {
    now_us += wait_us(random, habits.pause_mean_s, habits.shortest_s);
    if (now_us >= end_us) return;
    const Key key = keys_of_axis[axis][random.next() >> 63];
    keys.push_back({static_cast<double>(now_us) / 1e6, player, InputKind::key_down, key});
    now_us += wait_us(random, habits.press_mean_s, habits.shortest_s);
    if (now_us >= end_us) return;
    keys.push_back({static_cast<double>(now_us) / 1e6, player, InputKind::key_up, key});
  }
}

void sort_by_time(std::vector<InputEvent>& keys) {
  std::sort(keys.begin(), keys.end(), [](const InputEvent& a, const InputEvent& b) {
    return std::tuple(a.time, a.player, a.key) < std::tuple(b.time, b.player, b.key);
  });
}

}  // namespace

std::vector<InputEvent> random_player_plan(std::uint64_t seed, std::uint32_t player,
                                           double duration_s, const PressHabits& habits) {
  assert(habits.shortest_s > 0.0 && habits.press_mean_s > habits.shortest_s &&
         habits.pause_mean_s > habits.shortest_s);
  std::vector<InputEvent> keys;
  for (const std::size_t axis : {0u, 1u}) plan_axis(keys, seed, {player, axis}, duration_s, habits);
  sort_by_time(keys);
  assert(keys.empty() || keys.back().time < duration_s);
  return keys;
}

std::vector<InputEvent> random_plan(std::uint64_t seed, std::uint32_t players, double duration_s,
                                    const PressHabits& habits) {
  std::vector<InputEvent> keys;
  for (std::uint32_t player = 0; player < players; ++player) {
    const std::vector<InputEvent> own = random_player_plan(seed, player, duration_s, habits);
    keys.insert(keys.end(), own.begin(), own.end());
  }
  sort_by_time(keys);
  return keys;
}

}  // namespace rink::game
