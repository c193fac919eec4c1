// A calendar queue: the earliest pending event of every body, in order of time and then of the two
// bodies' ids.
#pragma once

#include <cassert>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "game/physics/events/event_order.h"
#include "game/physics/large_pages.h"
#include "game/physics/prefetch.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// One entry per body. Setting and taking cost constant time as long as events are spread over
/// time; the bucket width follows the rate at which they are taken, the number of buckets that of
/// the bodies that have an event (R. Brown, "Calendar queues", CACM 31, 1988). Bodies without one
/// cost nothing.
///
/// Buckets hold notes of a time and a body side by side. A new event leaves the note of the old one
/// where it is: it no longer says what the body's entry says, and is dropped when its bucket comes.
/// So setting writes to one bucket and reads none, and who comes next is known ahead (upcoming());
/// linked entries would not tell without waiting for memory.
class EventQueue {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  /// Makes room for bodies 0 .. count-1; new ones have no event.
  void resize(std::uint32_t count) {
    entries_.resize(count);
    later_.reserve(entries_.capacity());  // at first most events are there
  }
  /// So many bodies are about to get events: buckets for all are made at once, where they would be
  /// made anew at each doubling.
  void expect(std::size_t event_count);
  /// Gives `body` its event at `time` [s], ordered among equal times by `lower`, then `higher`.
  /// Infinity takes it out.
  void set(std::uint32_t body, Real time, std::uint32_t lower, std::uint32_t higher);
  /// The body whose event comes first, if it comes no later than `until`, else `none`. The entry
  /// stays.
  std::uint32_t first(Real until);
  Real time(std::uint32_t body) const { return entries_[body].time; }
  /// How many bodies have an event.
  std::size_t pending() const { return count_; }
  /// Whether another event may come within `window` [s] of the one that first() has just found; the
  /// same one as that of the other body does not count. Never misses one; sometimes says yes
  /// without need.
  bool is_followed_within(Real window) const;
  /// Notes looked at one by one since the queue was made: a few per event taken, or the buckets
  /// don't fit.
  std::uint64_t looked_at() const { return looked_at_; }

  /// The number of the bucket that first() looked into last.
  std::int64_t current() const { return current_; }
  /// Calls `visit(body)` for those noted in the bucket `distance` after the current one, a few of
  /// whom may have another event by now.
  template <class Visit>
  void upcoming(std::int64_t distance, Visit&& visit) const {
    assert(distance > 0);  // what the current one held is due
    if (current_ + distance >= horizon_) return;
    const std::size_t bucket = place_of(current_ + distance);
    for (std::uint32_t k = 0; k < counts_[bucket]; ++k) visit(buckets_[bucket].bodies[k]);
  }
  /// Asks the processor to fetch the entry of `body`.
  void prefetch(std::uint32_t body) const { physics::prefetch(&entries_[body]); }

 private:
  using Entry = EventOrder;
  struct Note {
    Real time;
    std::uint32_t body;
  };
  struct Due {
    Entry entry;
    std::uint32_t body;
  };
  static constexpr std::uint32_t bucket_room = 5;
  /// One cache line of notes; `full` is the first of a list of full ones.
  struct alignas(64) Bucket {
    Real times[bucket_room];
    std::uint32_t bodies[bucket_room];
    std::uint32_t full = none;
  };
  static constexpr std::size_t bucket_min = 64;

  bool is_valid(const Due& due) const { return entries_[due.body] == due.entry; }
  std::size_t place_of(std::int64_t number) const {
    return static_cast<std::size_t>(number) & (counts_.size() - 1);
  }
  std::int64_t bucket_number(Real time) const {
    constexpr double number_max = 4.0e18;
    return static_cast<std::int64_t>(std::min<Real>(time * inverse_width_, number_max));
  }
  void note(std::uint32_t body, Real time, std::int64_t number);
  void spill(Bucket& bucket);
  void add_due(std::uint32_t body);
  template <class Visit>
  void empty(std::size_t bucket, Visit&& visit);
  void gather();
  bool turn(Real until);
  bool adapt();
  bool refill(Real until);
  void rebuild(Real width, std::size_t bucket_count);
  void begin_span();
  /// By the mean time between events of this span [s]; nothing if it is too short to tell.
  std::optional<Real> wanted_width() const;

  LargeArray<Entry> entries_;
  LargeArray<Bucket> buckets_ = LargeArray<Bucket>(
      bucket_min);  // a power of two of them: numbers current_ + 1 to horizon_ - 1
  LargeArray<std::uint8_t> counts_ =
      LargeArray<std::uint8_t>(bucket_min, 0);  // notes in each bucket, without the full ones
  std::vector<Bucket> full_;
  std::vector<std::uint32_t> free_;  // of full_
  std::vector<Due> due_;             // of the current bucket and before, the first one last
  std::vector<Note> later_;          // from the horizon on, unsorted
  Real later_begin_ = std::numeric_limits<Real>::infinity();  // none of them comes before
  std::uint32_t found_ = none;                                // by first()
  std::size_t near_count_ = 0;                                // notes in buckets
  std::size_t count_ = 0;                                     // bodies that have an event
  Real inverse_width_ = 1e3;
  std::int64_t current_ = -1, horizon_ = bucket_min;
  // The rate at which events are taken is learnt from a span of at least so many: from one or two
  // it comes out a thousand times too great now and then.
  static constexpr std::uint64_t span_min = 16;
  std::uint64_t taken_ = 0;                           // in this span
  std::uint64_t looked_at_ = 0, span_looked_at_ = 0;  // ever, and before this span
  Real span_begin_ = 0.0, last_time_ = 0.0;           // simulated [s]
};

}  // namespace rink::physics::inline RINK_PRECISION
