// Hosts matches. Simulated time stops on a coarse grid during a match, so that its stamps are
// short.
#include "game/net/server/hosted_match.h"

#include <algorithm>
#include <cassert>

#include "game/control/begun_match.h"
#include "game/control/replay.h"
#include "game/model/time_grid.h"

namespace rink::game {

HostedMatch::HostedMatch(const Hosting& hosting, const Scene& scene)
    : hosting_(hosting), scene_(scene), flow_(hosting.times) {
  assert(!match_objection(scene));
}

void HostedMatch::pass(double now_s) {
  if (!led_ && passed_s_ && now_s > *passed_s_ + stood_still_s)
    flow_.stand_still(*passed_s_, now_s);
  passed_s_ = std::max(now_s, passed_s_.value_or(now_s));
}

bool HostedMatch::advance(double now_s) {
  if (!led_) flow_.advance(now_s);
  return present().number != number_;
}

Game HostedMatch::begin(const Game& last) {
  is_recorded_ = false;
  number_ = present().number;
  earlier_s_ += last.now();
  if (!hosting_.begun || led_) return Game(scene_);
  BegunMatch begun =
      begun_match(*std::exchange(hosting_.begun, std::nullopt), scene_, "the record");
  begun_events_ = std::move(begun.events);
  flow_.begin_at(begun.game.now());
  return std::move(begun.game);
}

double HostedMatch::goal(double now_s, double played) const {
  if (present().phase == MatchPhase::countdown) return played;
  const double now = simulated(now_s);
  return std::max(played, present().phase == MatchPhase::playing ? last_on(tick_grid, now) : now);
}

void HostedMatch::judge(const Game& game) {
  ending_possession_ = ending_possession(game);
  if (led_ || !flow_.runs() || !game.is_over()) return;
  const MatchState& match = flow_.state();
  flow_.win(game.score().left > game.score().right ? Team::left : Team::right,
            match.clock_real_s + game.now() - match.clock_simulated_s);
}

bool HostedMatch::are_keys_felt() const {
  const MatchPhase phase = present().phase;
  return phase != MatchPhase::waiting && phase != MatchPhase::over;
}

MatchState HostedMatch::state() const {
  MatchState state = present();
  state.is_unrecorded = is_unrecorded_;
  state.takes_keys_alone = led_.has_value();
  if (ending_possession_ && state.phase == MatchPhase::playing) {
    state.holder = ending_possession_->team;
    state.until_s = state.clock_real_s + ending_possession_->until - state.clock_simulated_s;
  }
  return state;
}

std::optional<KeyLog> HostedMatch::record_so_far(const Game& game,
                                                 const std::vector<InputEvent>& events) const {
  if (is_recorded_ || game.now() == 0.0) return std::nullopt;
  return log_of(game, scene_, hosting_.scene_text, events);
}

void HostedMatch::finish(const Game& game, const std::vector<InputEvent>& events) {
  std::optional<KeyLog> log = record_so_far(game, events);
  if (!log) return;
  is_recorded_ = true;
  finished_.push_back(*std::move(log));
}

}  // namespace rink::game
