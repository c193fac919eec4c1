// The simulated time, and what has come at its instant.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>

#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// How far a world has been played.
struct Clock {
  /// At one instant, after which all that touch yield as one now and then.
  static constexpr std::uint64_t endless_events = 64;

  Real now = 0.0;             ///< s
  Real instant_begin = -1.0;  ///< of the events counted as coming at once [s]
  std::uint64_t events_at_once = 0;
  bool is_played = false;  ///< advance() has been to now: what happens to bodies from outside at
                           ///< this instant takes effect beyond it
  bool solver_failed = false;  ///< no joint impact could be solved at this instant

  /// Whether so many events have come at this instant that all that touch shall yield as one.
  bool is_endless() const {
    assert(events_at_once > 0);  // asked while an event is processed
    return events_at_once % endless_events == 0;
  }
  /// An event is about to be processed; one that was overlooked may lie some roundings back.
  void reach(Real time) { now = std::max(now, time); }
  /// Nothing is left to do up to `until`.
  void arrive(Real until) {
    assert(until >= now);
    now = until;
    is_played = true;
  }
  /// Time that advances by roundings alone does not count as advancing.
  void count_event(Real time) {
    if (time > instant_begin + 16.0 * std::numeric_limits<Real>::epsilon() * (1.0 + time)) {
      instant_begin = time;
      events_at_once = 0;
      solver_failed = false;
    }
    ++events_at_once;
  }
};

}  // namespace rink::physics::inline RINK_PRECISION
