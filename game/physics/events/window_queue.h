// The earliest pending event of every body, kept by windows: what comes later than the present one
// waits with its body.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "game/physics/events/event_bins.h"
#include "game/physics/events/event_order.h"
#include "game/physics/large_pages.h"
#include "game/physics/prefetch.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// As EventQueue (event_queue.h), whose contract it shares: the same entries in the same order.
/// Most events are never taken, for their partner meets somebody else before; here most of these
/// cost no more than to write the body's entry. The price is to look at all bodies that have an
/// event once per window.
class WindowQueue {
 public:
  static constexpr std::uint32_t none = EventBins::none;

  void resize(std::uint32_t count) {
    entries_.resize(count);
    is_listed_.resize(count, 0);
  }
  void set(std::uint32_t body, Real time, std::uint32_t lower, std::uint32_t higher);
  std::uint32_t first(Real until);
  Real time(std::uint32_t body) const { return entries_[body].time; }
  bool is_followed_within(Real window) const {
    return bins_.is_followed_within(entries_.data(), window);
  }

  /// For whoever plays a window in parts: the entries, which different threads may rewrite for
  /// different bodies; all bodies that have an event, among others; and who has one again that had
  /// none.
  EventOrder* entries() { return entries_.data(); }
  std::span<const std::uint32_t> listed() const { return listed_; }
  bool is_listed(std::uint32_t body) const { return is_listed_[body] != 0; }
  void list(std::uint32_t body) {
    if (is_listed_[body] == 0) is_listed_[body] = 1, listed_.push_back(body);
  }
  /// Where a window from `begin` on would end.
  Real next_end(Real begin) const;
  /// A window in which only `bodies` have events left; all others' come later.
  void reopen(Real begin, Real end, std::span<const std::uint32_t> bodies);

  /// As of EventBins.
  std::int64_t current() const { return bins_.current(); }
  template <class Visit>
  void upcoming(std::int64_t distance, Visit&& visit) const {
    bins_.upcoming(distance, visit);
  }
  void prefetch(std::uint32_t body) const { physics::prefetch(&entries_[body]); }

 private:
  bool open(Real until);

  LargeArray<EventOrder> entries_;
  std::vector<std::uint32_t> listed_;  // all that have an event, and some that had one
  std::vector<std::uint8_t> is_listed_;
  Real later_begin_ = std::numeric_limits<Real>::infinity();  // nothing beyond the window is before
  EventBins bins_;
};

}  // namespace rink::physics::inline RINK_PRECISION
