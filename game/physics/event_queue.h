// A calendar queue: the earliest pending event of every body, in order of time and then of the two bodies' ids.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "game/physics/large_pages.h"

namespace rink::physics {

/// One entry per body. Setting and taking cost constant time as long as events are spread over time; the bucket width follows the rate at which they are taken, the number of
/// buckets that of the bodies that have an event (R. Brown, "Calendar queues", CACM 31, 1988). Bodies without one cost nothing.
template <class Real>
class BasicEventQueue {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  /// Makes room for bodies 0 .. count-1; new ones have no event.
  void resize(std::uint32_t count) { entries_.resize(count); }
  /// Gives `body` its event at `time` [s], ordered among equal times by `lower`, then `higher`. Infinity takes it out.
  void set(std::uint32_t body, Real time, std::uint32_t lower, std::uint32_t higher);
  /// The body whose event comes first, if it comes no later than `until`, else `none`. The entry stays.
  std::uint32_t first(Real until);
  Real time(std::uint32_t body) const { return entries_[body].time; }
  /// Whether another event may come within `window` [s] of the one that first() has just found. Never misses one; sometimes says yes without need.
  bool is_followed_within(Real window) const;
  /// Entries looked at one by one since the queue was made: a few per event taken, or the buckets don't fit.
  std::uint64_t looked_at() const { return looked_at_; }

 private:
  struct alignas(sizeof(Real) == sizeof(double) ? 32 : 64) Entry {  // never across two cache lines
    Real time = std::numeric_limits<Real>::infinity();
    std::uint32_t lower = none, higher = none;
    std::uint32_t next = none, previous = none;
    std::uint32_t bucket = none;
  };
  static constexpr std::uint32_t later_bucket = 0xfffffffe;
  static constexpr std::size_t bucket_min = 64;

  std::int64_t bucket_number(Real time) const;
  void link(std::uint32_t body);
  void unlink(std::uint32_t body);
  std::uint32_t& head(std::uint32_t bucket) { return bucket == later_bucket ? later_ : heads_[bucket]; }
  bool precedes(const Entry& a, const Entry& b) const;
  std::uint32_t earliest_in(std::uint32_t list);
  bool refill(Real until);
  void rebuild(Real width, std::size_t bucket_count);
  void begin_span();
  /// The mean time between events of this span [s]; nothing if it is too short to tell.
  std::optional<Real> mean_gap() const;

  LargeArray<Entry> entries_;
  LargeArray<std::uint32_t> heads_ = LargeArray<std::uint32_t>(bucket_min, none);  // a power of two of them
  std::uint32_t later_ = none;          // beyond the horizon, unsorted
  std::uint32_t near_count_ = 0;        // entries in buckets
  std::uint32_t count_ = 0;             // entries in buckets or later
  Real inverse_width_ = 1e3;
  std::int64_t current_ = 0, horizon_ = bucket_min;
  Real runner_up_ = 0.0;                // time of the second event of the list that was searched last
  // The rate at which events are taken is learnt from a span of at least so many: from one or two it comes out a thousand times too great now and then.
  static constexpr std::uint64_t span_min = 16;
  std::uint64_t taken_ = 0;             // in this span
  std::uint64_t looked_at_ = 0, span_looked_at_ = 0;  // ever, and before this span
  Real span_begin_ = 0.0, last_time_ = 0.0;         // simulated [s]
};
using EventQueue = BasicEventQueue<double>;

}  // namespace rink::physics
