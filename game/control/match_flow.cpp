// The transitions between phases of a match.
#include "game/control/match_flow.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "im/basics/checked.h"

namespace rink::game {

double simulated_at(const MatchState& state, double real_s) {
  if (state.phase == MatchPhase::playing)
    return state.clock_simulated_s + std::max(0.0, real_s - state.clock_real_s);
  if (state.phase == MatchPhase::countdown)
    return state.clock_simulated_s + std::max(0.0, real_s - state.until_s);
  return state.clock_simulated_s;
}

std::optional<std::string> match_objection(const Scene& scene) {
  const std::vector<Bat>& bats = scene.bodies.bats;
  if (!scene.populations.empty())
    return "it has populations, but a match has only bodies that are placed one by one";
  if (bats.size() != 2 || bats[0].team != Team::left || bats[1].team != Team::right)
    return "a match has two bats, first that of the team left, then that of the team right";
  if (!scene.rules.goals_to_win) return "[match] goals_to_win is missing, so no player could win";
  if (scene.world.field.goal_width == 0.0 || scene.bodies.pucks.empty())
    return "a match needs goals and a puck";
  return std::nullopt;
}

std::optional<EndingPossession> ending_possession(const Game& game) {
  const std::vector<physics::HalfStay> stays = stays_in(game);
  const auto first = std::ranges::min_element(stays, {}, &physics::HalfStay::until);
  if (first == stays.end() || first->until > game.now() + possession_shown_s) return std::nullopt;
  return EndingPossession{first->half == physics::Half::left ? Team::left : Team::right,
                          first->until};
}

MatchFlow::MatchFlow(const FlowTimes& times, const MatchState& state, std::array<bool, 2> are_here)
    : times_(times), state_(state), is_here_(are_here) {
  const MatchPhase phase = state.phase;
  if (phase == MatchPhase::waiting && are_all_here()) is_here_[1] = false;
  if (phase == MatchPhase::away && is_here_[0] == is_here_[1]) is_here_ = {true, false};
  if (phase == MatchPhase::countdown || phase == MatchPhase::playing || phase == MatchPhase::paused)
    is_here_ = {true, true};
  for (std::size_t player = 0; player < is_here_.size(); ++player)
    is_here_[player] = is_here_[player] || state.wants_rematch[player];
  if constexpr (checks_whole_structures) check();
}

void MatchFlow::begin_match(double now_s) {
  assert(are_all_here());
  state_ = {.number = state_.number + 1, .winner = std::nullopt};
  count_down(now_s);
}

void MatchFlow::count_down(double now_s) {
  state_.phase = MatchPhase::countdown;
  state_.until_s = now_s + times_.countdown_s;
}

/// Stops simulated time.
void MatchFlow::stop(double now_s) {
  state_.clock_simulated_s = simulated_at(state_, now_s);
  state_.clock_real_s = now_s;
}

void MatchFlow::check() const {
  [[maybe_unused]] const MatchPhase phase = state_.phase;
  assert((phase == MatchPhase::waiting || state_.number > 0) && phase != MatchPhase::lost);
  assert(phase != MatchPhase::waiting || !are_all_here());
  assert(phase != MatchPhase::away || is_here_[0] != is_here_[1]);
  assert((phase != MatchPhase::countdown && phase != MatchPhase::playing &&
          phase != MatchPhase::paused) ||
         are_all_here());
  assert(state_.winner.has_value() == (phase == MatchPhase::over) && state_.winner != Team::none);
  for (std::size_t player = 0; player < is_here_.size(); ++player)
    assert(!state_.wants_rematch[player] || (phase == MatchPhase::over && is_here_[player]));
}

void MatchFlow::advance(double now_s) {
  assert(std::isfinite(now_s));
  if (now_s < state_.until_s) return;
  if (state_.phase == MatchPhase::countdown) {
    state_.clock_real_s = state_.until_s;
    state_.phase = MatchPhase::playing;
  } else if (state_.phase == MatchPhase::away) {
    win(is_here_[0] ? Team::left : Team::right, now_s);
  }
  if constexpr (checks_whole_structures) check();
}

void MatchFlow::enter(std::uint32_t player, double now_s) {
  assert(player < is_here_.size());
  advance(now_s);
  if (is_here_[player]) return;
  is_here_[player] = true;
  if (!are_all_here()) return;
  // Over because the other player left: a successor begins a new match.
  if (state_.phase == MatchPhase::waiting || state_.phase == MatchPhase::over) begin_match(now_s);
  else if (state_.phase == MatchPhase::away) count_down(now_s);
  if constexpr (checks_whole_structures) check();
}

void MatchFlow::leave(std::uint32_t player, double now_s) {
  assert(player < is_here_.size());
  advance(now_s);
  is_here_[player] = false;
  state_.wants_rematch[player] = false;
  stop(now_s);
  const bool is_anybody_here = is_here_[0] || is_here_[1];
  if (!is_anybody_here || state_.phase == MatchPhase::over) {
    state_.phase = MatchPhase::waiting;  // a player that stays after the end waits for a new one
    state_.winner.reset();
    state_.wants_rematch = {};
  } else if (state_.phase != MatchPhase::waiting) {
    state_.phase = MatchPhase::away;
    state_.until_s = now_s + times_.patience_s;
  }
  if constexpr (checks_whole_structures) check();
}

void MatchFlow::pause(bool is_wanted, double now_s) {
  advance(now_s);
  if (is_wanted && (state_.phase == MatchPhase::playing || state_.phase == MatchPhase::countdown)) {
    stop(now_s);
    state_.phase = MatchPhase::paused;
  } else if (!is_wanted && state_.phase == MatchPhase::paused) {
    count_down(now_s);
  }
  if constexpr (checks_whole_structures) check();
}

void MatchFlow::ask_rematch(std::uint32_t player, double now_s) {
  assert(player < is_here_.size());
  advance(now_s);
  if (state_.phase != MatchPhase::over || !is_here_[player]) return;
  state_.wants_rematch[player] = true;
  if (state_.wants_rematch[0] && state_.wants_rematch[1]) begin_match(now_s);
  if constexpr (checks_whole_structures) check();
}

void MatchFlow::fall_behind(double now_s, double simulated_s) {
  if (!runs()) return;
  assert(simulated_s <= simulated_at(state_, now_s));
  state_.clock_real_s = now_s;
  state_.clock_simulated_s = simulated_s;
}

void MatchFlow::stand_still(double from_s, double now_s) {
  assert(from_s <= now_s);
  advance(from_s);
  if (state_.phase == MatchPhase::playing) {
    state_.clock_simulated_s = simulated_at(state_, from_s);
    state_.clock_real_s = now_s;
    count_down(now_s);
  } else if (state_.phase == MatchPhase::countdown) {
    count_down(now_s);
  } else if (state_.phase == MatchPhase::away) {
    state_.until_s += now_s - from_s;
  }
  if constexpr (checks_whole_structures) check();
}

void MatchFlow::begin_at(double simulated_s) {
  assert(state_.phase == MatchPhase::countdown && state_.clock_simulated_s == 0.0);
  state_.clock_simulated_s = simulated_s;
}

void MatchFlow::win(Team winner, double now_s) {
  assert(winner != Team::none);
  assert((state_.phase == MatchPhase::playing || state_.phase == MatchPhase::countdown ||
          state_.phase == MatchPhase::away) &&
         "a match goes on; that a countdown has ended may not have been noticed yet");
  stop(now_s);
  state_.phase = MatchPhase::over;
  state_.winner = winner;
}

}  // namespace rink::game
