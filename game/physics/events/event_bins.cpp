// Lists of notes, sorted when their bucket comes.
#include "game/physics/events/event_bins.h"

#include <algorithm>
#include <cassert>

namespace rink::physics::inline RINK_PRECISION {

namespace {
constexpr std::size_t notes_per_bucket = 4;
}  // namespace

void EventBins::open(Real begin, Real end, std::size_t expected) {
  assert(end >= begin);
  begin_ = begin, end_ = end;
  buckets_.assign(expected / notes_per_bucket + 1, none);
  const Real width = (end - begin) / static_cast<Real>(buckets_.size());
  buckets_per_second_ = width > 0.0 ? 1.0 / width : 0.0;
  bucket_ = 0;
  notes_.clear(), due_.clear();
}

void EventBins::add(std::uint32_t body, const EventOrder& order) {
  assert(order.time <= end_);
  const Real ahead = std::max<Real>(0.0, order.time - begin_) * buckets_per_second_;
  const std::size_t last = buckets_.size() - 1;
  const std::size_t bucket =
      ahead < static_cast<Real>(last) ? static_cast<std::size_t>(ahead) : last;
  if (bucket < bucket_) return sort_in(body, order);
  notes_.push_back({order, body, buckets_[bucket]});
  buckets_[bucket] = static_cast<std::uint32_t>(notes_.size() - 1);
}

void EventBins::sort_in(std::uint32_t body, const EventOrder& order) {
  due_.push_back({order, body, none});
  std::size_t k = due_.size() - 1;
  for (; k > 0 && precedes(due_[k - 1].order, order); --k) due_[k] = due_[k - 1];
  due_[k] = {order, body, none};
}

std::uint32_t EventBins::first(const EventOrder* entries) {
  constexpr std::size_t few = 32;
  for (;;) {
    for (; !due_.empty(); due_.pop_back())
      if (is_valid(due_.back(), entries)) return due_.back().body;
    if (bucket_ >= buckets_.size()) return none;
    for (std::uint32_t k = buckets_[bucket_++]; k != none; k = notes_[k].next) {
      if (!is_valid(notes_[k], entries)) continue;
      if (due_.size() < few) sort_in(notes_[k].body, notes_[k].order);
      else due_.push_back(notes_[k]);
    }
    if (due_.size() > few)
      std::sort(due_.begin(), due_.end(),
                [](const Note& a, const Note& b) { return precedes(b.order, a.order); });
  }
}

bool EventBins::is_followed_within(const EventOrder* entries, Real window) const {
  assert(!due_.empty());
  const EventOrder& found = due_.back().order;
  const Real end = found.time + window;
  for (std::size_t k = due_.size(); k-- > 0 && due_[k].order.time <= end;)
    if (is_valid(due_[k], entries) && due_[k].order != found) return true;
  return bucket_ >= buckets_.size()
             ? end >= end_
             : (end - begin_) * buckets_per_second_ >= static_cast<Real>(bucket_);
}

}  // namespace rink::physics::inline RINK_PRECISION
