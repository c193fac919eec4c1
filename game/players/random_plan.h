// A plan of each player's keys and their instants, drawn from a seed before a run.
#pragma once

#include <cstdint>
#include <vector>

#include "game/model/key.h"

namespace rink::game {

/// The statistics of a random player's keys. Each of the two axes alternates independently between
/// pauses and presses, both exponential, so at most two keys are held and never two opposed ones;
/// the defaults give 3.3 key events per second and player (2 axes x 2 events per 1.2 s).
struct PressHabits {
  double press_mean_s = 0.4;
  double pause_mean_s = 0.8;
  double shortest_s = 0.03;  ///< no press and no pause is shorter, as with human fingers
};

/// The keys of `players` players within [0, duration_s) seconds of play, ordered by (time, player,
/// key), at whole microseconds. A run never changes the plan (open loop): a bot may be late for it.
/// The same arguments give the same keys on every machine, and player k's keys depend on `seed` and
/// k alone: neither on how many others play nor (but for the cut) on the duration. Keys held at the
/// end stay held.
std::vector<InputEvent> random_plan(std::uint64_t seed, std::uint32_t players, double duration_s,
                                    const PressHabits& habits = {});

/// The keys of player `player` alone, as `random_plan` gives them.
std::vector<InputEvent> random_player_plan(std::uint64_t seed, std::uint32_t player,
                                           double duration_s, const PressHabits& habits = {});

}  // namespace rink::game
