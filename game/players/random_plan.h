// Which keys each player will press and when, decided by a seed before a run starts.
#pragma once

#include <cstdint>
#include <vector>

#include "game/model/key.h"

namespace rink::game {

/// How a player's thumbs behave. Each of the two axes is its own alternation of pauses and presses,
/// both exponential, so at most two keys are held and never two opposed ones; the defaults give 3.3
/// key events per second and player (2 axes x 2 events per 1.2 s).
struct PressHabits {
  double press_mean_s = 0.4;
  double pause_mean_s = 0.8;
  double shortest_s = 0.03;  ///< no press and no pause is shorter: nobody's fingers are faster
};

/// The keys of `players` players within [0, duration_s) seconds of play, ordered by (time, player,
/// key), at whole microseconds. A run never changes them: a bot that is late is late, its plan is
/// not (open loop). The same arguments give the same keys on every machine, and player k's keys
/// depend on `seed` and k alone: neither on how many others play nor (but for the cut) on the
/// duration. Keys held at the end stay held.
std::vector<InputEvent> random_plan(std::uint64_t seed, std::uint32_t players, double duration_s,
                                    const PressHabits& habits = {});

/// The keys of player `player` alone, as `random_plan` gives them.
std::vector<InputEvent> random_player_plan(std::uint64_t seed, std::uint32_t player,
                                           double duration_s, const PressHabits& habits = {});

}  // namespace rink::game
