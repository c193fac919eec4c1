// Shows the record at real time multiplied by the speed.
#include "game/match/replay_match.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "game/control/key_log_file.h"

namespace rink::game {

Replay ReplayMatch::read(const std::filesystem::path& file) {
  KeyLog log = read_key_log(file);
  require_complete(log, file.string());
  Scene scene = recorded_scene(log, file.string());
  return Replay(std::move(log), std::move(scene));
}

ReplayMatch::ReplayMatch(const std::filesystem::path& file)
    : replay_(read(file)), sight_(sight_of(replay_.scene())) {}

void ReplayMatch::seek(double instant) {
  wanted_ = std::clamp(instant, 0.0, end());
  is_sought_ = true;
}

void ReplayMatch::set_speed(double speed) {
  assert(std::isfinite(speed) && speed >= 0.0);
  speed_ = speed;
}

void ReplayMatch::rematch() {
  seek(0.0);
  is_paused_ = false;
}

void ReplayMatch::stop_after_win() {
  if (!replay_.game().is_over()) {
    won_at_.reset();
    has_stopped_ = false;
  } else if (!won_at_) {
    won_at_ = wanted_;
  } else if (!has_stopped_ && wanted_ >= *won_at_ + after_win_s && wanted_ < end()) {
    is_paused_ = has_stopped_ = true;
  }
}

/// Goes on from where it was, since records have hundreds of thousands of events.
void ReplayMatch::follow_inputs() {
  const std::vector<InputEvent>& events = replay_.log().events;
  if (inputs_.empty() || (events_taken_ > 0 && events[events_taken_ - 1].time > sight_.time)) {
    inputs_.assign(replay_.game().player_count(), {});
    events_taken_ = 0;
  }
  for (; events_taken_ < events.size() && events[events_taken_].time <= sight_.time;
       ++events_taken_) {
    const InputEvent& event = events[events_taken_];
    if (event.player >= inputs_.size()) continue;
    Input& input = inputs_[event.player];
    if (event.kind == InputKind::push) input.push = event.push;
    else if (event.kind == InputKind::key_down || event.kind == InputKind::key_up)
      input.keys.set(event.key, event.kind == InputKind::key_down);
    else input = {};
  }
}

void ReplayMatch::advance(double now_s) {
  assert((!has_begun_ || now_s >= now_s_) && "real time never falls");
  if (has_begun_ && !is_paused_ && !is_sought_)
    wanted_ = std::min(end(), wanted_ + speed_ * (now_s - now_s_));
  has_begun_ = true;
  now_s_ = now_s;
  assert(wanted_ >= 0.0 && wanted_ <= end());
  replay_.seek(wanted_);
  stop_after_win();
  game_sight_.show(replay_.game(), sight_);
  follow_inputs();
  // A replay that the watcher stops is still shown as playing.
  const bool is_over = wanted_ == end() || (has_stopped_ && is_paused_);
  sight_.phase = is_over ? MatchPhase::over : MatchPhase::playing;
  const Score& score = sight_.score;
  sight_.winner.reset();
  if (replay_.game().is_over()) sight_.winner = score.left > score.right ? Team::left : Team::right;
  sight_.notice = replay_.is_as_recorded() == false
                      ? "this is not the game that was recorded: its end differs"
                      : "";
  if (is_sought_) noises_ = {}, goals_ = {};  // events in between make no sound
  was_sought_ = std::exchange(is_sought_, false);
  goals_.look(sight_, now_s, replay_.scene().rules.face_off_delay);
  noises_.listen(sight_);
}

}  // namespace rink::game
