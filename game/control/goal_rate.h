// How many goals players score in a minute, over many games of a scene.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "game/model/scene.h"

namespace rink::game {

/// `games` games of `seconds` [s] each. Game k has the seed `seed` + k, by which players decide and
/// pucks start, each in another direction at its speed. Nobody wins, so all last as long.
struct GoalRatePlan {
  std::vector<std::string> players;  ///< as Playing's kinds
  std::uint32_t games = 1;
  double seconds = 60.0;
  std::uint64_t seed = 1;
  std::function<bool()> is_interrupted{};  ///< asked before each game but the first, if there
};

struct GoalRate {
  std::uint32_t games = 0;                         ///< that were played
  double left_per_min = 0.0, right_per_min = 0.0;  ///< goals that each side scored
  double error_per_min = 0.0;   ///< of both together: half of the 95 % interval of the mean
  double serves_per_min = 0.0;  ///< pucks that went to the other side as their time was over
  double longest_wait_s = 0.0;  ///< the longest time without a goal in any game
  std::uint64_t hash = 0;       ///< of all games' hashes
};

/// At least one game, of more than 0 s (both asserted).
GoalRate goal_rate(const Scene& scene, const GoalRatePlan& plan);

}  // namespace rink::game
