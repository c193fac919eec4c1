// The events of one window of time, in their order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "game/physics/events/event_order.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Notes of events in buckets of equal width. Nobody takes a note out: one that no longer says what
/// its body's entry says is dropped when its bucket comes. Entries are the caller's, an array by
/// body, so that many windows can share it.
class EventBins {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  /// Empty, for some `expected` events from `begin` to `end` [s], both included.
  void open(Real begin, Real end, std::size_t expected);
  /// The last instant of the window.
  Real end() const { return end_; }
  /// Notes the event of `body`, which comes no later than end().
  void add(std::uint32_t body, const EventOrder& order);
  /// The body whose event comes first, or `none`; the note stays.
  std::uint32_t first(const EventOrder* entries) {
    for (;;) {
      for (; !due_.empty(); drop_first())
        if (const Note& note = notes_[due_.back()]; is_valid(note, entries)) return note.body;
      if (bucket_ >= buckets_.size()) return none;
      empty_next_bucket(entries);
    }
  }
  /// Takes out the note that first() has just found: nobody has to ask what it says once more.
  void drop_first() {
    notes_[due_.back()].next = free_;
    free_ = due_.back();
    due_.pop_back();
  }
  /// Whether another event may come within `window` [s] of the one at `time` that first() has just
  /// found, or beyond end(). Never misses one.
  bool is_followed_within(const EventOrder* entries, Real window) const;

  /// The number of the bucket that first() looked into last.
  std::int64_t current() const { return static_cast<std::int64_t>(bucket_) - 1; }
  /// Calls `visit(body)` for those noted in the bucket `distance` after the current one.
  template <class Visit>
  void upcoming(std::int64_t distance, Visit&& visit) const {
    const auto bucket = static_cast<std::size_t>(current() + distance);
    if (bucket >= buckets_.size()) return;
    for (std::uint32_t k = buckets_[bucket]; k != none; k = notes_[k].next) visit(notes_[k].body);
  }

 private:
  struct Note {
    EventOrder order;
    std::uint32_t body, next;  // in its bucket, or among those taken out
  };

  void empty_next_bucket(const EventOrder* entries);
  std::uint32_t new_note(std::uint32_t body, const EventOrder& order);
  void sort_in(std::uint32_t note);
  bool is_valid(const Note& note, const EventOrder* entries) const {
    return entries[note.body] == note.order;
  }

  Real begin_ = 0.0, end_ = -1.0, buckets_per_second_ = 0.0;
  std::vector<std::uint32_t> buckets_;  // the first note of each
  std::size_t bucket_ = 0;              // the next one
  std::vector<Note> notes_;
  std::uint32_t free_ = none;       // the note that was taken out last
  std::vector<std::uint32_t> due_;  // notes of the buckets before the next one, the first one last
};

}  // namespace rink::physics::inline RINK_PRECISION
