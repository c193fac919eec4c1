// The next event of each body, and which of them comes first.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "game/physics/bodies/body_records.h"
#include "game/physics/bodies/partner.h"
#include "game/physics/bodies/tolerances.h"
#include "game/physics/body.h"
#include "game/physics/events/event_schedule.h"
#include "game/physics/grid/cell_grid.h"
#include "game/physics/large_pages.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Prediction writes a body's slot and then tells the schedule.
class NextEvents {
 public:
  static constexpr std::uint32_t none = EventSchedule::none;
  static constexpr NextEvent no_event{std::numeric_limits<Real>::infinity(),
                                      std::numeric_limits<Real>::infinity(),
                                      partner::none,
                                      0,
                                      CellGrid::left,
                                      false};

  explicit NextEvents(QueuePolicy policy) : policy_(policy), schedule_(policy) {}
  NextEvents(const NextEvents&) = delete;
  NextEvents& operator=(const NextEvents&) = delete;

  /// Of the next body, by number.
  void add() {
    slots_.push_back(no_event);
    schedule_.resize(static_cast<std::uint32_t>(slots_.size()));
  }
  /// Forgets everything; bodies 0 to `count` - 1 have no event.
  void restart(std::uint32_t count) {
    slots_.assign(count, no_event);
    schedule_ = EventSchedule(policy_);
    schedule_.resize(count);
  }

  const NextEvent& operator[](std::uint32_t body) const { return slots_[body]; }
  NextEvent& slot(std::uint32_t body) { return slots_[body]; }
  /// So many bodies are about to get events.
  void expect(std::size_t event_count) { schedule_.expect(event_count); }
  /// The body's event is what its slot says.
  void schedule(std::uint32_t body) {
    const EventOrder order = order_of(body);
    schedule_.set(body, order.time, order.lower, order.higher);
  }
  /// Where its slot says that its event comes.
  EventOrder order_of(std::uint32_t body) const {
    const NextEvent& slot = slots_[body];
    return slot.crossing_time < slot.impact_time
               ? EventOrder{slot.crossing_time, body, body}
               : EventOrder{slot.impact_time, std::min(body, slot.partner),
                            std::max(body, slot.partner)};
  }
  /// The body has no event before somebody else's.
  void drop(std::uint32_t body) {
    slots_[body] = no_event;
    schedule_.set(body, std::numeric_limits<Real>::infinity(), body, body);
  }

  /// The body whose event comes first, if it comes no later than `until` [s], else `none`.
  std::uint32_t first(Real until) { return schedule_.first(until); }
  Real time(std::uint32_t body) const { return schedule_.time(body); }
  /// Whether another impact may come within the instant of that of `body` and `partner`, which
  /// came first. Never misses one: an impact is either the first of its body, and thus scheduled,
  /// or hidden behind that one.
  bool is_followed_at_once(std::uint32_t body, Partner partner) const {
    return slots_[body].is_tied || (is_body(partner) && slots_[partner].is_tied) ||
           schedule_.is_followed_within(instant);
  }
  /// Hands all that is pending to the queue of that policy.
  void keep_by(QueuePolicy policy) {
    const auto has_event = [this](std::uint32_t body) {
      return schedule_.time(body) < std::numeric_limits<Real>::infinity();
    };
    const std::size_t count = slots_.size();
    EventSchedule next(policy);
    next.resize(static_cast<std::uint32_t>(count));
    next.expect(schedule_.pending());
    for (std::uint32_t body = 0; body < count; ++body) {
      if (!has_event(body)) continue;
      const EventOrder order = order_of(body);
      assert(order.time == schedule_.time(body));
      next.set(body, order.time, order.lower, order.higher);
    }
    policy_ = policy, schedule_ = std::move(next);
  }
  /// Windows look at all that have an event once per window: from so many bodies on that is cheap,
  /// and with a quarter of them a calendar costs half as much.
  void choose(std::size_t pending_min) {
    const bool has_windows = windows() != nullptr;
    const std::size_t pending = schedule_.pending();
    if (!has_windows && pending >= pending_min) keep_by(QueuePolicy::windows);
    if (has_windows && pending < pending_min / 4) keep_by(QueuePolicy::calendar);
  }
  /// The windows, if events are kept by them.
  WindowQueue* windows() { return schedule_.windows(); }
  /// Who comes after the next one.
  const EventSchedule& upcoming() const { return schedule_; }

 private:
  QueuePolicy policy_;
  LargeArray<NextEvent> slots_;
  EventSchedule schedule_;
};

}  // namespace rink::physics::inline RINK_PRECISION
