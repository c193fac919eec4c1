// Tries again until the match goes on or nobody would wait any longer.
#include "game/net/client/returning_match.h"

#include <cassert>
#include <exception>
#include <utility>

#include "game/replication/names.h"

namespace rink::game {

ReturningMatch::ReturningMatch(const std::string& place, const NetworkMatchSettings& settings,
                               const std::string& key_file)
    : place_(place),
      key_file_(key_file),
      settings_(settings),
      match_(std::make_unique<JoinedMatch>(place, settings, key_file)) {}

void ReturningMatch::advance(double now_s) {
  if (lost_s_) try_again(now_s);
  else follow(now_s);
}

void ReturningMatch::follow(double now_s) {
  const MatchPhase phase = match_->sight().phase;
  match_->advance(now_s);
  if (match_->is_in_match()) {
    was_in_match_ = true;
    silent_s_ = match_->sight().interrupted_s.value_or(0.0);
    return;
  }
  if (match_->sight().phase != MatchPhase::lost || !was_in_match_) return;
  lost_ = match_->sight();
  why_ = std::exchange(lost_.notice, "");
  lost_.phase = phase;
  lost_.noises.clear();
  lost_s_ = now_s - silent_s_;
  tried_s_ = now_s - try_every_s;
  // Whoever comes back first, the seat is that of its bat's name.
  if (const auto player = match_->player()) settings_.name = bat_name(*player);
  match_.reset();
  try_again(now_s);
}

void ReturningMatch::try_again(double now_s) {
  assert(lost_s_);
  lost_.noises.clear();
  if (lost_.phase == MatchPhase::lost) return;
  lost_.interrupted_s = now_s - *lost_s_;
  if (match_) match_->advance(now_s);
  if (match_ && match_->is_in_match()) return return_to_match();
  if (match_ && match_->sight().phase == MatchPhase::lost) match_.reset();
  if (*lost_.interrupted_s > interruption_max_s) {
    match_.reset();
    lost_.phase = MatchPhase::lost;
    lost_.interrupted_s.reset();
    lost_.notice = why_;
  } else if (!match_ && now_s >= tried_s_ + try_every_s) {
    tried_s_ = now_s;
    try {
      match_ = std::make_unique<JoinedMatch>(place_, settings_, key_file_);
    } catch (const std::exception&) {  // the network is gone too: it is tried again
    }
  }
}

void ReturningMatch::return_to_match() {
  lost_s_.reset();
  for (const Key key : all_keys)
    if (held_[static_cast<std::size_t>(key)]) match_->press(0, key, true);
}

void ReturningMatch::press(std::uint32_t hand, Key key, bool is_down) {
  held_[static_cast<std::size_t>(key)] = is_down;
  if (match_ && !lost_s_) match_->press(hand, key, is_down);
}

}  // namespace rink::game
