// Each call is one arrow between two phases.
#include "game/control/match_flow.h"

#include <cassert>

namespace rink::game {

void MatchFlow::begin_match(double now_s) {
  state_ = {.number = state_.number + 1, .winner = std::nullopt};
  count_down(now_s);
}

void MatchFlow::count_down(double now_s) {
  state_.phase = MatchPhase::countdown;
  state_.until_s = now_s + times_.countdown_s;
}

void MatchFlow::advance(double now_s) {
  if (now_s < state_.until_s) return;
  if (state_.phase == MatchPhase::countdown) {
    state_.phase = MatchPhase::playing;
  } else if (state_.phase == MatchPhase::away) {
    win(is_here_[0] ? Team::left : Team::right);
  }
}

void MatchFlow::enter(std::uint32_t player, double now_s) {
  assert(player < is_here_.size());
  if (is_here_[player]) return;
  is_here_[player] = true;
  if (!are_all_here()) return;
  // Over, but for lack of the other: that one's successor plays anew.
  if (state_.phase == MatchPhase::waiting || state_.phase == MatchPhase::over) begin_match(now_s);
  else if (state_.phase == MatchPhase::away) count_down(now_s);
}

void MatchFlow::leave(std::uint32_t player, double now_s) {
  assert(player < is_here_.size());
  is_here_[player] = false;
  state_.wants_rematch[player] = false;
  const bool is_anybody_here = is_here_[0] || is_here_[1];
  if (!is_anybody_here || state_.phase == MatchPhase::over) {
    state_.phase = MatchPhase::waiting;  // who stays after the end waits for somebody new
    state_.winner.reset();
    state_.wants_rematch = {};
  } else if (state_.phase == MatchPhase::countdown || state_.phase == MatchPhase::playing || state_.phase == MatchPhase::paused) {
    state_.phase = MatchPhase::away;
    state_.until_s = now_s + times_.patience_s;
  }
}

void MatchFlow::pause(bool is_wanted, double now_s) {
  if (is_wanted && (state_.phase == MatchPhase::playing || state_.phase == MatchPhase::countdown)) state_.phase = MatchPhase::paused;
  else if (!is_wanted && state_.phase == MatchPhase::paused) count_down(now_s);
}

void MatchFlow::ask_rematch(std::uint32_t player, double now_s) {
  assert(player < is_here_.size());
  if (state_.phase != MatchPhase::over || !is_here_[player]) return;
  state_.wants_rematch[player] = true;
  if (state_.wants_rematch[0] && state_.wants_rematch[1]) begin_match(now_s);
}

void MatchFlow::win(Team winner) {
  state_.phase = MatchPhase::over;
  state_.winner = winner;
}

}  // namespace rink::game
