// Follows the flow of matches at the referee, and shows each match to its end before the next.
#include "game/node/node_match.h"

#include <algorithm>

namespace rink::game {

void NodeMatch::wish(const MatchWish& wish) {
  const std::lock_guard lock(mutex_);
  std::erase(wishes_, wish);  // a player may repeat it as often as it likes
  wishes_.push_back(wish);
}

std::vector<MatchWish> NodeMatch::take_wishes() {
  const std::lock_guard lock(mutex_);
  for (const MatchWish& each : wishes_)
    if (each.kind == MatchWish::Kind::rematch) {
      std::erase(rematches_, each);
      rematches_.push_back(each);
    }
  return std::exchange(wishes_, {});
}

void NodeMatch::ask_again() {
  for (const MatchWish& each : std::exchange(rematches_, {}))
    if (each.player < news_.state.wants_rematch.size() && !news_.state.wants_rematch[each.player])
      wish(each);
}

/// Before a match's session has begun here, nobody plays it here.
MatchState NodeMatch::state() {
  const std::lock_guard lock(mutex_);
  while (sessions_.size() > 1 && sessions_.front().has_ended &&
         sessions_.front().stretches == shown_)
    sessions_.pop_front();
  if (sessions_.empty()) return {.winner = std::nullopt};
  const Session& front = sessions_.front();
  MatchState state = state_;
  if (front.has_ended) state.clock_simulated_s = std::max(state.clock_simulated_s, front.until_s);
  if (front.match == state.number) return state;
  return {.number = front.match, .clock_simulated_s = front.until_s, .winner = std::nullopt};
}

void NodeMatch::note_shown(std::uint64_t stretches) {
  const std::lock_guard lock(mutex_);
  shown_ = stretches;
}

bool NodeMatch::has_shown_all() const {
  const std::lock_guard lock(mutex_);
  return sessions_.empty() ||
         (sessions_.front().has_ended && sessions_.front().stretches == shown_);
}

bool NodeMatch::follow(const MatchNews& news) {
  const bool may_be = news.session == news_.session || news.session == news_.session + 1;
  if (!may_be) return false;
  news_ = news;
  if (news.session == begun_) last_window_ = news.last_window;
  const std::lock_guard lock(mutex_);
  if (news.state.phase != MatchPhase::over) rematches_.clear();
  state_ = news.state;
  return true;
}

void NodeMatch::begin_session() {
  assert(begins());
  ++begun_, rounds_.begin_session();
  last_window_ = news_.last_window, match_ = news_.match;
  const std::lock_guard lock(mutex_);
  sessions_.push_back({.match = match_});
}

void NodeMatch::end_session(double until_s, std::uint64_t stretches) {
  const std::lock_guard lock(mutex_);
  assert(!sessions_.empty() && !sessions_.back().has_ended);
  sessions_.back().has_ended = true;
  sessions_.back().until_s = until_s;
  sessions_.back().stretches = ended_stretches_ += stretches;
}

void NodeMatch::close(std::optional<Team> winner) {
  const std::lock_guard lock(mutex_);
  assert(!sessions_.empty() && sessions_.back().has_ended);
  state_.phase = MatchPhase::over, state_.winner = winner;
}

void NodeMatch::take_part(std::uint32_t player, bool is_here, double now_s) {
  if (flow_.is_here(player) == is_here) return;
  if (is_here) flow_.enter(player, now_s);
  else flow_.leave(player, now_s);
}

void NodeMatch::apply(const MatchWish& wish, double now_s) {
  if (wish.kind == MatchWish::Kind::rematch) flow_.ask_rematch(wish.player, now_s);
  else flow_.pause(wish.kind == MatchWish::Kind::pause, now_s);
}

std::optional<MatchNews> NodeMatch::advance(double now_s) {
  constexpr double silence_s_max = 0.25;
  flow_.advance(now_s);
  next_.state = flow_.state();
  const bool is_heard = news_.state.phase == MatchPhase::playing || now_s < told_s_ + silence_s_max;
  if (next_ == news_ && is_heard) return std::nullopt;
  told_s_ = now_s;
  [[maybe_unused]] const bool may_be = follow(next_);
  assert(may_be);
  return news_;
}

bool NodeMatch::wants_session() const {
  return flow_.state().number > 0 && flow_.state().number != next_.match &&
         flow_.state().phase != MatchPhase::waiting;
}

void NodeMatch::call_session() {
  assert(wants_session());
  ++next_.session;
  next_.match = flow_.state().number;
  next_.last_window = 0;
}

bool NodeMatch::is_given_up() const {
  return next_.last_window == 0 &&
         MatchNews{.state = flow_.state(), .match = next_.match}.is_given_up();
}

/// Its last window was played before a pause that came meanwhile, if one came.
void NodeMatch::follow_win() {
  const MatchState& state = flow_.state();
  if (!won_ || won_->match != next_.match || state.number != next_.match ||
      state.phase == MatchPhase::waiting || state.phase == MatchPhase::over)
    return;
  const double real_s = state.clock_real_s + won_->time - state.clock_simulated_s;
  if (state.phase == MatchPhase::paused) flow_.pause(false, state.clock_real_s);
  flow_.win(won_->winner, real_s);
}

/// Nobody has been told less than what it follows, so nothing that was said is taken back.
void NodeMatch::lead(std::array<bool, 2> are_seated, double now_s) {
  flow_ = MatchFlow(times_, news_.state, are_seated);
  next_ = news_;
  told_s_ = now_s;
  follow_win();
}

void NodeMatch::fall_behind(double now_s, double simulated_s) {
  flow_.advance(now_s);  // a countdown may have ended while nobody could say so
  if (flow_.runs())
    flow_.fall_behind(now_s, std::min(simulated_s, simulated_at(flow_.state(), now_s)));
}

}  // namespace rink::game
