// Buckets of equal width for the near future, one unsorted list for what lies beyond, and a sorted
// one for what is due.
#include "game/physics/events/event_queue.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

#include "game/physics/body.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {
/// Few buckets that are well filled stay in the processor's cache, and fewer of them are turned to;
/// the price is to sort so many. Measured from 1 to 8: with 10,000 bodies a third of the misses of
/// 2, a quarter fewer wrong guesses of branches than 2.
constexpr double events_per_bucket = 8.0;
/// On the average, of those that are pending: later ones are in buckets, too.
constexpr std::size_t events_per_bucket_max = 4;
}  // namespace

void EventQueue::set(std::uint32_t body, Real time, std::uint32_t lower, std::uint32_t higher) {
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  assert(body < entries_.size() && time == time && lower <= higher);
  Entry& entry = entries_[body];
  const bool is_noted = entry.time == time;
  if (is_noted && entry.lower == lower && entry.higher == higher) return;
  count_ += (time < infinity ? 1u : 0u) - (entry.time < infinity ? std::size_t{1} : std::size_t{0});
  entry = {time, lower, higher};
  if (!(time < infinity)) return;
  const std::int64_t number = bucket_number(time);
  if (number <= current_) add_due(body);
  else if (!is_noted) note(body, time, number);
  if (count_ > events_per_bucket_max * counts_.size())
    rebuild(1.0 / inverse_width_, 2 * counts_.size());
  else if (near_count_ + later_.size() + due_.size() > 4 * count_ + 1024)
    rebuild(1.0 / inverse_width_, counts_.size());
}

void EventQueue::note(std::uint32_t body, Real time, std::int64_t number) {
  assert(number > current_);  // who comes before is due
  if (number >= horizon_) {
    later_.push_back({time, body});
    later_begin_ = std::min(later_begin_, time);
    return;
  }
  const std::size_t place = place_of(number);
  Bucket& bucket = buckets_[place];
  if (counts_[place] == bucket_room) spill(bucket), counts_[place] = 0;
  const std::uint32_t k = counts_[place]++;
  bucket.times[k] = time;
  bucket.bodies[k] = body;
  ++near_count_;
}

/// Moves all that is in the bucket to its list of full ones.
void EventQueue::spill(Bucket& bucket) {
  std::uint32_t place = static_cast<std::uint32_t>(full_.size());
  if (free_.empty()) {
    full_.push_back(bucket);
  } else {
    place = free_.back();
    free_.pop_back();
    full_[place] = bucket;
  }
  assert(place < full_.size());
  bucket.full = place;
}

/// Puts the body's entry among those that are due, in its order.
void EventQueue::add_due(std::uint32_t body) {
  const Due due{entries_[body], body};
  due_.push_back(due);
  std::size_t k = due_.size() - 1;
  for (; k > 0 && precedes(due_[k - 1].entry, due.entry); --k) due_[k] = due_[k - 1], ++looked_at_;
  due_[k] = due;
}

void EventQueue::expect(std::size_t event_count) {
  std::size_t bucket_count = counts_.size();
  while (event_count > events_per_bucket_max * bucket_count) bucket_count *= 2;
  if (bucket_count > counts_.size()) rebuild(1.0 / inverse_width_, bucket_count);
}

/// Calls `visit(body, time)` for all notes in a bucket, which is empty then.
template <class Visit>
void EventQueue::empty(std::size_t place, Visit&& visit) {
  Bucket& bucket = buckets_[place];
  const std::uint32_t count = std::exchange(counts_[place], std::uint8_t{0});
  for (std::uint32_t k = 0; k < count; ++k) visit(bucket.bodies[k], bucket.times[k]);
  assert(near_count_ >= count);
  near_count_ -= count;
  while (bucket.full != none) {
    const std::uint32_t full = std::exchange(bucket.full, full_[bucket.full].full);
    for (std::uint32_t k = 0; k < bucket_room; ++k)
      visit(full_[full].bodies[k], full_[full].times[k]);
    near_count_ -= bucket_room;
    free_.push_back(full);
  }
}

/// Sorts what the current bucket holds into what is due.
void EventQueue::gather() {
  assert(current_ < horizon_);
  constexpr std::size_t few = 32;
  empty(place_of(current_), [&](std::uint32_t body, Real time) {
    ++looked_at_;
    if (entries_[body].time != time) return;
    if (due_.size() < few) add_due(body);
    else due_.push_back({entries_[body], body});
  });
  if (due_.size() > few)
    std::sort(due_.begin(), due_.end(),
              [](const Due& a, const Due& b) { return precedes(b.entry, a.entry); });
}

bool EventQueue::is_followed_within(Real window) const {
  assert(window >= 0.0 && found_ != none);  // by first(), just now
  const Real end = last_time_ + window;
  for (std::size_t k = due_.size(); k-- > 0 && due_[k].entry.time <= end;)
    if (is_valid(due_[k]) && due_[k].entry != entries_[found_]) return true;
  return end * inverse_width_ >= static_cast<Real>(current_ + 1);
}

void EventQueue::rebuild(Real width, std::size_t bucket_count) {
  assert(width > 0.0 && std::has_single_bit(bucket_count));
  std::vector<Note> pending;
  pending.reserve(count_);
  const auto add = [&](std::uint32_t body, Real time) {
    if (entries_[body].time == time) pending.push_back({time, body});
  };
  for (std::size_t place = 0; place < counts_.size(); ++place) empty(place, add);
  for (const Note& note : later_) add(note.body, note.time);
  for (const Due& due : due_) add(due.body, due.entry.time);
  // Who had the same event before has two notes.
  const auto is_lower = [](const Note& a, const Note& b) { return a.body < b.body; };
  std::sort(pending.begin(), pending.end(), is_lower);
  pending.erase(std::unique(pending.begin(), pending.end(),
                            [](const Note& a, const Note& b) { return a.body == b.body; }),
                pending.end());
  full_.clear(), free_.clear(), later_.clear(), due_.clear();
  later_begin_ = std::numeric_limits<Real>::infinity();
  inverse_width_ = 1.0 / width;
  // An event that was overlooked may lie some roundings before the last one that was taken.
  Real earliest = last_time_;
  for (const Note& pended : pending) earliest = std::min(earliest, pended.time);
  current_ = bucket_number(earliest) - 1;
  buckets_.assign(bucket_count, Bucket{});
  counts_.assign(bucket_count, 0);
  horizon_ = current_ + 1 + static_cast<std::int64_t>(bucket_count);
  for (const Note& pended : pending) note(pended.body, pended.time, bucket_number(pended.time));
  begin_span();
}

void EventQueue::begin_span() {
  taken_ = 0;
  span_looked_at_ = looked_at_;
  span_begin_ = last_time_;
}

std::optional<Real> EventQueue::wanted_width() const {
  if (taken_ < span_min || last_time_ <= span_begin_) return std::nullopt;
  return std::max(events_per_bucket * (last_time_ - span_begin_) / static_cast<Real>(taken_),
                  1e-15 * fineness * (1.0 + last_time_));
}

/// Whether the buckets did not fit and have been made anew.
bool EventQueue::adapt() {
  const auto wanted = wanted_width();
  if (!wanted) return false;
  const Real width = 1.0 / inverse_width_;
  const bool is_ring_too_long = counts_.size() > bucket_min && counts_.size() > 4 * count_;
  const bool is_unfit = *wanted > 2.0 * width || *wanted < 0.5 * width || is_ring_too_long;
  if (is_unfit) rebuild(*wanted, is_ring_too_long ? counts_.size() / 8 : counts_.size());
  else begin_span();
  return is_unfit;
}

/// Moves the horizon on; false if nothing is due by `until`.
bool EventQueue::refill(Real until) {
  const auto has_none = [&] { return later_.empty() || later_begin_ > until; };
  if (near_count_ == 0) {
    if (has_none()) return false;
    std::erase_if(later_, [&](const Note& note) { return entries_[note.body].time != note.time; });
    looked_at_ += later_.size();
    later_begin_ = std::numeric_limits<Real>::infinity();
    for (const Note& note : later_) later_begin_ = std::min(later_begin_, note.time);
    if (has_none()) return false;
    current_ = std::max(current_, bucket_number(later_begin_) - 1);
    last_time_ = std::max(last_time_, later_begin_);
  }
  if (adapt()) return true;
  horizon_ = current_ + 1 + static_cast<std::int64_t>(counts_.size());
  std::vector<Note> beyond;
  later_begin_ = std::numeric_limits<Real>::infinity();
  later_.swap(beyond);
  looked_at_ += beyond.size();
  for (const Note& pended : beyond)
    if (entries_[pended.body].time == pended.time)
      note(pended.body, pended.time, bucket_number(pended.time));
  return true;
}

/// Goes on to the next bucket; false if nothing in it can come by `until`.
bool EventQueue::turn(Real until) {
  if (taken_ > 4096 + count_ / 8) adapt();
  if ((near_count_ == 0 || current_ + 1 >= horizon_) && !refill(until)) return false;
  if (static_cast<Real>(current_ + 1) > until * inverse_width_) return false;
  ++current_;
  gather();
  return true;
}

std::uint32_t EventQueue::first(Real until) {
  assert(until == until);
  for (;;) {
    while (!due_.empty() && !is_valid(due_.back())) due_.pop_back();
    if (due_.empty()) {
      if (!turn(until)) return none;
      continue;
    }
    if (due_.back().entry.time > until) return none;
    last_time_ = std::max(last_time_, due_.back().entry.time);
    ++taken_;
    if (looked_at_ - span_looked_at_ > 16 * taken_ + 4096)
      if (const auto wanted = wanted_width()) {
        rebuild(*wanted, counts_.size());
        continue;
      }
    return found_ = due_.back().body;
  }
}

}  // namespace rink::physics::inline RINK_PRECISION
