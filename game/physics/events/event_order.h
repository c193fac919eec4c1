// In which order events are processed.
#pragma once

#include <cstdint>
#include <limits>

#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// What tells events apart. The other body's event of the same impact has the same.
struct EventOrder {
  Real time = std::numeric_limits<Real>::infinity();      ///< simulated [s]
  std::uint32_t lower = 0xffffffff, higher = 0xffffffff;  ///< ids of the two that meet

  friend bool operator==(const EventOrder&, const EventOrder&) = default;
};

/// Ties break by (time, lower id, higher id).
inline bool precedes(const EventOrder& a, const EventOrder& b) {
  if (a.time != b.time) return a.time < b.time;
  if (a.lower != b.lower) return a.lower < b.lower;
  return a.higher < b.higher;
}

}  // namespace rink::physics::inline RINK_PRECISION
