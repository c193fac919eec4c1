// What happened, counted, and written down for whoever asked for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "game/physics/bodies/partner.h"
#include "game/physics/counters.h"
#include "game/physics/event.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Counts every event; writes them down only while that is wanted. Never changes the motion.
class EventRecord {
 public:
  /// Also of what is no event of its own.
  Counters& counters() { return counters_; }
  const Counters& counters() const { return counters_; }

  void keep(bool is_wanted) { is_kept_ = is_wanted; }
  void note(EventKind kind, Real time, std::uint32_t body, Partner other = partner::none) {
    ++counters_.of(kind);
    if (is_kept_) write(kind, time, body, other);
  }
  /// Written down since the last forget(), in order of time.
  std::span<const Event> events() const { return events_; }
  void forget() { events_.clear(); }
  bool is_kept() const { return is_kept_; }
  /// Written down by somebody else, in the place of all from `first` on.
  void replace_from(std::size_t first, std::span<const Event> events) {
    events_.resize(first);
    events_.insert(events_.end(), events.begin(), events.end());
  }

 private:
  /// Kept apart: events are counted always, and written down for few.
  [[gnu::noinline]] void write(EventKind kind, Real time, std::uint32_t body, Partner other) {
    events_.push_back(
        {time, kind, BodyId{body}, is_body(other) ? std::optional(BodyId{other}) : std::nullopt});
  }

  Counters counters_;
  bool is_kept_ = false;
  std::vector<Event> events_;
};

}  // namespace rink::physics::inline RINK_PRECISION
