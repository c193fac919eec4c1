// A binary heap with the calendar queue's interface: no assumption on how events are spread over
// time, at a logarithmic price.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <vector>

#include "game/physics/events/event_order.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// As EventQueue (event_queue.h), whose contract it shares: the same entries in the same
/// order.
class EventHeap {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  void resize(std::uint32_t count) {
    places_.resize(count, none);
    times_.resize(count, std::numeric_limits<Real>::infinity());
  }
  void set(std::uint32_t body, Real time, std::uint32_t lower, std::uint32_t higher);
  std::uint32_t first(Real until) const {
    return heap_.empty() || heap_.front().time > until ? none : heap_.front().body;
  }
  Real time(std::uint32_t body) const { return times_[body]; }
  /// The twin of the first is one of the next two, if it is there; whoever else may follow is above
  /// or right below it.
  bool is_followed_within(Real window) const {
    assert(!heap_.empty() && window >= 0.0);
    const EventOrder& first = heap_.front();
    const Real end = first.time + window;
    return std::any_of(
        heap_.begin() + 1,
        heap_.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(7, heap_.size())),
        [&](const EventOrder& e) { return e.time <= end && e != first; });
  }
  /// Asserts that nobody precedes who stands above him, and that bodies and places lead to each
  /// other.
  void check() const;

 private:
  struct Entry : EventOrder {
    std::uint32_t body;
  };

  void put(std::uint32_t place, const Entry& entry) {
    heap_[place] = entry;
    places_[entry.body] = place;
  }
  void raise(std::uint32_t place, const Entry& entry);
  void sink(std::uint32_t place, const Entry& entry);
  void take_out(std::uint32_t body);

  std::vector<Entry> heap_;
  std::vector<std::uint32_t> places_;  ///< in the heap, by body
  std::vector<Real> times_;            ///< by body
};

}  // namespace rink::physics::inline RINK_PRECISION
