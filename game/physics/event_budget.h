// How many events a world may take per simulated second, and which it took last.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/bodies/partner.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// What a budget was charged with at once.
struct ChargedEvent {
  Real time = 0.0;                  ///< s
  std::uint32_t body = 0;           ///< whose event came first
  Partner partner = partner::none;  ///< the body or part of the field that it met
  std::uint64_t count = 1;          ///< a joint impact counts by its contacts
  bool is_hop = false;              ///< a pressed cluster was parted
};

/// Counts events by simulated seconds: the first begins with the first event, each other with the
/// first event after the one before. So what it says depends on events alone, and not on where
/// advance() stopped between them.
class EventBudget {
 public:
  static constexpr std::size_t recent_max = 4096;

  /// At least 1 (asserted).
  explicit EventBudget(std::uint64_t events_per_s) : events_per_s_(events_per_s) {
    assert(events_per_s > 0);
  }
  /// One that ends after each event, of which it tells by recent().
  static EventBudget of_one_event() {
    EventBudget budget(1);
    budget.events_per_s_ = 0;
    return budget;
  }
  std::uint64_t events_per_s() const { return events_per_s_; }

  /// Events come in order of time (asserted), and none while the budget is exceeded (asserted).
  void charge(const ChargedEvent& event) {
    assert(event.count > 0 && !is_exceeded());
    if (recent_.empty() || event.time >= begin_ + 1.0) begin_ = event.time, spent_ = 0;
    spent_ += event.count;
    remember(event);
  }
  /// Whether `events` that all come up to `until`, not before the last one charged, are events of
  /// the present second and not too many.
  bool has_room(Real until, std::uint64_t events) const {
    return !recent_.empty() && until < begin_ + 1.0 && !is_exceeded() &&
           events <= events_per_s_ - spent_;
  }
  /// Such events (asserted), the `last` of them in order of time (asserted).
  void charge_together([[maybe_unused]] Real until, std::uint64_t events,
                       std::span<const ChargedEvent> last) {
    assert(has_room(until, events));
    spent_ += events;
    for (const ChargedEvent& event : last) remember(event);
  }
  /// Since the present second began, or as grant() has set it.
  std::uint64_t spent() const { return spent_; }
  /// More has happened in one second than may.
  bool is_exceeded() const { return spent_ > events_per_s_; }
  /// Whoever goes on all the same allows at least `events` more, at most a second's.
  void grant(std::uint64_t events) { spent_ = events_per_s_ - std::min(events, events_per_s_); }

  /// The last ones, the first of them first.
  std::vector<ChargedEvent> recent() const {
    std::vector<ChargedEvent> events = recent_;
    if (charged_ > recent_max)
      std::rotate(events.begin(),
                  events.begin() + static_cast<std::ptrdiff_t>(charged_ % recent_max),
                  events.end());
    return events;
  }

 private:
  const ChargedEvent& latest() const { return recent_[(charged_ - 1) % recent_max]; }
  void remember(const ChargedEvent& event) {
    assert(recent_.empty() || latest().time <= event.time);
    if (recent_.size() < recent_max) recent_.push_back(event);
    else recent_[charged_ % recent_max] = event;
    ++charged_;
  }

  std::uint64_t events_per_s_;
  Real begin_ = 0.0;  // of the present second [s]
  std::uint64_t spent_ = 0;
  std::vector<ChargedEvent> recent_;  // a ring once it is full
  std::uint64_t charged_ = 0;         // ever
};

}  // namespace rink::physics::inline RINK_PRECISION
