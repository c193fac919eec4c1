// Things between two kept frames are where the straight line between them leads.
#include "game/view/feel/goal_replay.h"

#include <algorithm>
#include <cassert>

namespace rink::view {

void GoalReplay::skip() {
  begin_s_.reset();
  shown_.reset();
  clip_.clear();
}

void GoalReplay::look(const MatchSight& sight, double now_s) {
  constexpr std::size_t things_max = 40;  // a crowd is none's to follow
  if (!sight.goals_to_win || sight.things.size() > things_max) return;
  const auto is_goal = [](const Noise& noise) { return noise.kind == Noise::Kind::goal; };
  if (std::ranges::any_of(sight.noises, is_goal) && past_.size() >= 2) {
    clip_ = past_;
    begin_s_ = now_s + begins_after_s;
  }
  if (sight.phase == Phase::playing) past_.push_back({now_s, sight.things});
  else past_.clear();
  std::erase_if(past_, [now_s](const Frame& frame) { return frame.time < now_s - kept_s; });
  shown_.reset();
  if (!begin_s_ || now_s < *begin_s_) return;
  const double instant = clip_.back().time + (now_s - *begin_s_ - shown_s) / slowness;
  if (instant > clip_.back().time) return skip();
  if (instant >= clip_.front().time) show(instant, sight);
}

void GoalReplay::show(double instant, const MatchSight& sight) {
  assert(clip_.size() >= 2 && instant >= clip_.front().time && instant <= clip_.back().time);
  const auto after = std::ranges::upper_bound(clip_, instant, {}, &Frame::time) - clip_.begin();
  const Frame& next =
      clip_[std::min<std::size_t>(static_cast<std::size_t>(after), clip_.size() - 1)];
  const Frame& before = clip_[static_cast<std::size_t>(after) - 1];
  const double step = next.time - before.time,
               part = step > 0.0 ? (instant - before.time) / step : 0.0;
  MatchSight seen;
  seen.field = sight.field;
  seen.phase = Phase::playing;
  seen.things = before.things;
  for (Thing& thing : seen.things) {
    const auto then = std::ranges::find(next.things, thing.id, &Thing::id);
    if (then != next.things.end() && (then->position - thing.position).norm() < 0.3)
      thing.position += part * (then->position - thing.position);
  }
  shown_ = std::move(seen);
}

}  // namespace rink::view
