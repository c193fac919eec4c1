// Phases are the players' own, so that a bot decides at the instants at which the same player
// inside the game would.
#include "loadgen/run/bots/decision_schedule.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "game/players/player.h"

namespace rink::loadgen {

DecisionSchedule::DecisionSchedule(std::uint32_t first, std::uint32_t count)
    : order_(count), next_of_bot_(count) {
  std::iota(order_.begin(), order_.end(), 0u);
  const auto phase = [first](std::uint32_t bot) { return game::decision_phase(first + bot); };
  std::stable_sort(order_.begin(), order_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return phase(a) < phase(b); });
  for (const std::uint32_t bot : order_) phases_.push_back(phase(bot));
}

void DecisionSchedule::begin(double simulated_s) {
  next_turn_ = static_cast<std::uint64_t>(simulated_s / game::decision_period) * order_.size();
}

double DecisionSchedule::next_s() const {
  assert(!is_empty());
  const std::uint64_t count = order_.size();
  return static_cast<double>(next_turn_ / count) * game::decision_period +
         phases_[next_turn_ % count];
}

std::uint32_t DecisionSchedule::take() {
  assert(!is_empty());
  return order_[next_turn_++ % order_.size()];
}

bool DecisionSchedule::take_due(std::uint32_t bot, double instant) {
  if (bot >= next_of_bot_.size() || next_of_bot_[bot] > instant) return false;
  next_of_bot_[bot] = instant + game::decision_period;
  return true;
}

}  // namespace rink::loadgen
