// The pending events of all bodies, kept by the queue that the world's spec chose.
#pragma once

#include <cstdint>

#include "game/physics/body.h"
#include "game/physics/events/event_heap.h"
#include "game/physics/events/event_queue.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Same questions, same answers, whichever queue is behind it; the branch is always taken the same
/// way and costs nothing measurable.
class EventSchedule {
 public:
  static constexpr std::uint32_t none = EventQueue::none;

  explicit EventSchedule(QueuePolicy policy) : is_heap_(policy == QueuePolicy::heap) {}

  void resize(std::uint32_t count) { is_heap_ ? heap_.resize(count) : calendar_.resize(count); }
  void set(std::uint32_t body, Real time, std::uint32_t lower, std::uint32_t higher) {
    is_heap_ ? heap_.set(body, time, lower, higher) : calendar_.set(body, time, lower, higher);
  }
  std::uint32_t first(Real until) { return is_heap_ ? heap_.first(until) : calendar_.first(until); }
  Real time(std::uint32_t body) const { return is_heap_ ? heap_.time(body) : calendar_.time(body); }
  /// The calendar, if it is that.
  const EventQueue* calendar() const { return is_heap_ ? nullptr : &calendar_; }
  bool is_followed_within(Real window) const {
    return is_heap_ ? heap_.is_followed_within(window) : calendar_.is_followed_within(window);
  }

 private:
  bool is_heap_;
  EventQueue calendar_;
  EventHeap heap_;
};

}  // namespace rink::physics::inline RINK_PRECISION
