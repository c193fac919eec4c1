// Buckets of equal width for the near future, one unsorted list for what lies beyond.
#include "game/physics/event_queue.h"

#include <algorithm>
#include <cmath>

#include "game/physics/body.h"

namespace rink::physics {

namespace {
constexpr double number_max = 4.0e18;
}

template <class Real>
std::int64_t BasicEventQueue<Real>::bucket_number(Real time) const {
  return std::max(current_, static_cast<std::int64_t>(std::min<Real>(time * inverse_width_, number_max)));
}

template <class Real>
bool BasicEventQueue<Real>::precedes(const Entry& a, const Entry& b) const {
  if (a.time != b.time) return a.time < b.time;
  if (a.lower != b.lower) return a.lower < b.lower;
  return a.higher < b.higher;
}

template <class Real>
void BasicEventQueue<Real>::link(std::uint32_t body) {
  Entry& entry = entries_[body];
  const std::int64_t number = bucket_number(entry.time);
  entry.bucket = number < horizon_ ? static_cast<std::uint32_t>(number & static_cast<std::int64_t>(heads_.size() - 1)) : later_bucket;
  near_count_ += entry.bucket != later_bucket;
  ++count_;
  std::uint32_t& first = head(entry.bucket);
  entry.next = first;
  entry.previous = none;
  if (first != none) entries_[first].previous = body;
  first = body;
}

template <class Real>
void BasicEventQueue<Real>::unlink(std::uint32_t body) {
  Entry& entry = entries_[body];
  if (entry.bucket == none) return;
  near_count_ -= entry.bucket != later_bucket;
  --count_;
  if (entry.previous == none) head(entry.bucket) = entry.next;
  else entries_[entry.previous].next = entry.next;
  if (entry.next != none) entries_[entry.next].previous = entry.previous;
  entry.bucket = none;
}

template <class Real>
void BasicEventQueue<Real>::set(std::uint32_t body, Real time, std::uint32_t lower, std::uint32_t higher) {
  unlink(body);
  Entry& entry = entries_[body];
  entry.time = time;
  entry.lower = lower;
  entry.higher = higher;
  if (time < std::numeric_limits<Real>::infinity()) link(body);
  if (count_ > heads_.size()) rebuild(1.0 / inverse_width_, 2 * heads_.size());
}

template <class Real>
std::uint32_t BasicEventQueue<Real>::earliest_in(std::uint32_t list) {
  std::uint32_t best = list;
  runner_up_ = std::numeric_limits<Real>::infinity();
  if (list == none) return none;
  ++looked_at_;
  for (std::uint32_t body = entries_[list].next; body != none; body = entries_[body].next) {
    ++looked_at_;
    const bool is_better = precedes(entries_[body], entries_[best]);
    runner_up_ = std::min(runner_up_, entries_[is_better ? best : body].time);
    if (is_better) best = body;
  }
  return best;
}

template <class Real>
bool BasicEventQueue<Real>::is_followed_within(Real window) const {
  const Real end = last_time_ + window;
  return runner_up_ <= end || end * inverse_width_ >= static_cast<Real>(current_ + 1);
}

template <class Real>
void BasicEventQueue<Real>::rebuild(Real width, std::size_t bucket_count) {
  std::vector<std::uint32_t> pending;
  pending.reserve(count_);
  const auto add = [&](std::uint32_t list) {
    for (std::uint32_t body = list; body != none; body = entries_[body].next) pending.push_back(body);
  };
  std::for_each(heads_.begin(), heads_.end(), add);
  add(later_);
  inverse_width_ = 1.0 / width;
  current_ = static_cast<std::int64_t>(std::min<Real>(last_time_ * inverse_width_, number_max));
  heads_.assign(bucket_count, none);
  horizon_ = current_ + static_cast<std::int64_t>(bucket_count);
  later_ = none;
  near_count_ = count_ = 0;
  for (const std::uint32_t body : pending) link(body);
  begin_span();
}

template <class Real>
void BasicEventQueue<Real>::begin_span() {
  taken_ = 0;
  span_looked_at_ = looked_at_;
  span_begin_ = last_time_;
}

template <class Real>
std::optional<Real> BasicEventQueue<Real>::mean_gap() const {
  if (taken_ < span_min || last_time_ <= span_begin_) return std::nullopt;
  return std::max((last_time_ - span_begin_) / static_cast<Real>(taken_), 1e-15 * fineness<Real> * (1.0 + last_time_));
}

/// Moves the horizon on; false if nothing is due by `until`.
template <class Real>
bool BasicEventQueue<Real>::refill(Real until) {
  if (near_count_ == 0) {
    const std::uint32_t earliest = earliest_in(later_);
    if (earliest == none || entries_[earliest].time > until) return false;
    current_ = bucket_number(entries_[earliest].time);
    last_time_ = std::max(last_time_, entries_[earliest].time);
  }
  if (const auto wanted = mean_gap()) {
    const Real width = 1.0 / inverse_width_;
    const bool is_ring_too_long = heads_.size() > bucket_min && heads_.size() > 32 * std::size_t{count_};
    if (*wanted > 2.0 * width || *wanted < 0.5 * width || is_ring_too_long) {
      rebuild(*wanted, is_ring_too_long ? heads_.size() / 8 : heads_.size());
      return true;
    }
    begin_span();
  }
  horizon_ = current_ + static_cast<std::int64_t>(heads_.size());
  std::uint32_t body = later_;
  while (body != none) {
    const std::uint32_t next = entries_[body].next;
    if (bucket_number(entries_[body].time) < horizon_) {
      unlink(body);
      link(body);
    }
    body = next;
  }
  return true;
}

template <class Real>
std::uint32_t BasicEventQueue<Real>::first(Real until) {
  for (;;) {
    if (near_count_ == 0 || current_ >= horizon_) {
      if (!refill(until)) return none;
      continue;
    }
    const std::uint32_t list = heads_[static_cast<std::size_t>(current_ & static_cast<std::int64_t>(heads_.size() - 1))];
    if (list != none) {
      const std::uint32_t best = earliest_in(list);
      if (entries_[best].time > until) return none;
      last_time_ = std::max(last_time_, entries_[best].time);
      ++taken_;
      if (looked_at_ - span_looked_at_ > 16 * taken_ + 4096)
        if (const auto wanted = mean_gap()) {
          rebuild(*wanted, heads_.size());
          runner_up_ = last_time_;  // it may have been in another bucket
        }
      return best;
    }
    if (static_cast<Real>(current_) >= until * inverse_width_) return none;
    ++current_;
  }
}

template class BasicEventQueue<double>;
template class BasicEventQueue<long double>;

}  // namespace rink::physics
