// Keeps past and predicted samples, and interpolates between them.
#include "game/match/rink_track.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

#include "game/match/jump_blends.h"

namespace rink::game {

double RinkTrack::end() const {
  assert(!samples_.empty());
  return samples_.back().time;
}

void RinkTrack::add(RinkSample sample) {
  assert(samples_.empty() || samples_.back().time < sample.time);
  samples_.push_back(std::move(sample));
}

void RinkTrack::drop_from(double time) {
  while (!samples_.empty() && samples_.back().time >= time) samples_.pop_back();
}

void RinkTrack::forget_before(double time) {
  while (samples_.size() > 2 && samples_[1].time < time) samples_.pop_front();
}

ShownBody RinkTrack::at(std::size_t body, double time) const {
  assert(!samples_.empty() && body < samples_.front().positions.size());
  const auto after =
      std::lower_bound(samples_.begin(), samples_.end(), time,
                       [](const RinkSample& sample, double t) { return sample.time < t; });
  if (after == samples_.end())
    return {samples_.back().positions[body], samples_.back().velocities[body], time};
  if (after == samples_.begin() || after->time == time)
    return {after->positions[body], after->velocities[body], time};
  const auto before = std::prev(after);
  const Vector2 way = after->positions[body] - before->positions[body];
  if (way.norm() > blended_furthest)
    return {before->positions[body], before->velocities[body], time};
  const double part = (time - before->time) / (after->time - before->time);
  assert(part >= 0.0 && part <= 1.0);
  return {before->positions[body] + part * way, before->velocities[body], time};
}

void RinkTrack::check([[maybe_unused]] std::size_t body_count) const {
  for (std::size_t k = 0; k < samples_.size(); ++k) {
    assert(samples_[k].positions.size() == body_count);
    assert(samples_[k].velocities.size() == body_count);
    assert(k == 0 || samples_[k - 1].time < samples_[k].time);
  }
}

}  // namespace rink::game
