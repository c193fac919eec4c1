// The pending events of all bodies, kept by the queue that the world's spec chose.
#pragma once

#include <cstdint>

#include "game/physics/body.h"
#include "game/physics/events/event_heap.h"
#include "game/physics/events/event_queue.h"
#include "game/physics/events/window_queue.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Same questions, same answers, whichever queue is behind it; the branch is always taken the same
/// way and costs nothing measurable.
class EventSchedule {
 private:
  template <class Self, class Question>
  static decltype(auto) ask(Self& self, Question&& question) {
    if (self.policy_ == QueuePolicy::calendar) return question(self.calendar_);
    if (self.policy_ == QueuePolicy::windows) return question(self.windows_);
    return question(self.heap_);
  }

 public:
  static constexpr std::uint32_t none = EventQueue::none;

  explicit EventSchedule(QueuePolicy policy) : policy_(policy) {}

  void resize(std::uint32_t count) {
    ask(*this, [&](auto& queue) { queue.resize(count); });
  }
  /// So many bodies are about to get events.
  void expect(std::size_t event_count) {
    if (policy_ == QueuePolicy::calendar) calendar_.expect(event_count);
  }
  void set(std::uint32_t body, Real time, std::uint32_t lower, std::uint32_t higher) {
    ask(*this, [&](auto& queue) { queue.set(body, time, lower, higher); });
  }
  std::uint32_t first(Real until) {
    return ask(*this, [&](auto& queue) { return queue.first(until); });
  }
  Real time(std::uint32_t body) const {
    return ask(*this, [&](const auto& queue) { return queue.time(body); });
  }
  bool is_followed_within(Real window) const {
    return ask(*this, [&](const auto& queue) { return queue.is_followed_within(window); });
  }

  /// Of the calendar how many bodies have an event; of windows, which may list some that had one,
  /// at most so many more; a heap does not count.
  std::size_t pending() const {
    return policy_ == QueuePolicy::windows ? windows_.listed().size() : calendar_.pending();
  }
  /// The windows, if events are kept by them.
  WindowQueue* windows() { return policy_ == QueuePolicy::windows ? &windows_ : nullptr; }
  /// Whether the queue knows who comes after the next one: a heap does not.
  bool knows_upcoming() const { return policy_ != QueuePolicy::heap; }
  /// As of EventQueue, where upcoming events are known.
  std::int64_t current() const {
    return policy_ == QueuePolicy::windows ? windows_.current() : calendar_.current();
  }
  template <class Visit>
  void upcoming(std::int64_t distance, Visit&& visit) const {
    policy_ == QueuePolicy::windows ? windows_.upcoming(distance, visit)
                                    : calendar_.upcoming(distance, visit);
  }
  void prefetch(std::uint32_t body) const {
    policy_ == QueuePolicy::windows ? windows_.prefetch(body) : calendar_.prefetch(body);
  }

 private:
  QueuePolicy policy_;
  EventQueue calendar_;
  EventHeap heap_;
  WindowQueue windows_;
};

}  // namespace rink::physics::inline RINK_PRECISION
