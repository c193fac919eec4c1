// Lists of notes, sorted when their bucket comes.
#include "game/physics/events/event_bins.h"

#include <algorithm>
#include <cassert>

namespace rink::physics::inline RINK_PRECISION {

namespace {
constexpr std::size_t notes_per_bucket = 2;
}  // namespace

void EventBins::open(Real begin, Real end, std::size_t expected) {
  assert(end >= begin);
  begin_ = begin, end_ = end;
  buckets_.assign(expected / notes_per_bucket + 1, none);
  const Real width = (end - begin) / static_cast<Real>(buckets_.size());
  buckets_per_second_ = width > 0.0 ? 1.0 / width : 0.0;
  bucket_ = 0;
  notes_.clear(), due_.clear();
  free_ = none;
}

void EventBins::add(std::uint32_t body, const EventOrder& order) {
  assert(order.time <= end_);
  const Real ahead = std::max<Real>(0.0, order.time - begin_) * buckets_per_second_;
  // Signed, as other numbers take a branch and four instructions to come from a floating one.
  const auto last = static_cast<std::int64_t>(buckets_.size()) - 1;
  const auto bucket = static_cast<std::size_t>(
      ahead < static_cast<Real>(last) ? static_cast<std::int64_t>(ahead) : last);
  if (bucket < bucket_) return sort_in(new_note(body, order));
  notes_.push_back({order, body, buckets_[bucket]});
  buckets_[bucket] = static_cast<std::uint32_t>(notes_.size() - 1);
}

/// Where one was taken out, or events without end at one instant would take memory without end.
std::uint32_t EventBins::new_note(std::uint32_t body, const EventOrder& order) {
  const std::uint32_t note = free_;
  if (note == none) {
    notes_.push_back({order, body, none});
    return static_cast<std::uint32_t>(notes_.size() - 1);
  }
  free_ = notes_[note].next;
  notes_[note] = {order, body, none};
  return note;
}

void EventBins::sort_in(std::uint32_t note) {
  std::size_t k = due_.size();
  due_.push_back(note);
  for (; k > 0 && precedes(notes_[due_[k - 1]].order, notes_[note].order); --k)
    due_[k] = due_[k - 1];
  due_[k] = note;
}

/// Sorts what it holds into what is due.
void EventBins::empty_next_bucket(const EventOrder* entries) {
  constexpr std::size_t few = 32;
  for (std::uint32_t k = buckets_[bucket_++]; k != none; k = notes_[k].next) {
    if (!is_valid(notes_[k], entries)) continue;
    if (due_.size() < few) sort_in(k);
    else due_.push_back(k);
  }
  if (due_.size() > few)
    std::sort(due_.begin(), due_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return precedes(notes_[b].order, notes_[a].order);
    });
}

bool EventBins::is_followed_within(const EventOrder* entries, Real window) const {
  assert(!due_.empty());
  const EventOrder& found = notes_[due_.back()].order;
  const Real end = found.time + window;
  for (std::size_t k = due_.size(); k-- > 0 && notes_[due_[k]].order.time <= end;)
    if (const Note& note = notes_[due_[k]]; is_valid(note, entries) && note.order != found)
      return true;
  // In a window of one instant all are in the first bucket.
  return end >= end_ || (bucket_ < buckets_.size() &&
                         (end - begin_) * buckets_per_second_ >= static_cast<Real>(bucket_));
}

}  // namespace rink::physics::inline RINK_PRECISION
