// The boxes that bodies on curves sweep: a cheap way to see that two cannot meet in time.
#pragma once

#include <algorithm>

#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// How far a body may have gone along an axis, back and forth [m].
struct Stretch {
  Real low, high;
};

/// Within `elapsed` [s] after its last event. Under drag x = v s + a q with s and q no longer than
/// without (docs/physics.md, "Motion"), and friction with the table shortens the way as well.
inline Stretch stretch_of(Real velocity, Real acceleration, Real elapsed) {
  const Real way = velocity * elapsed, more = Real(0.5) * acceleration * elapsed * elapsed;
  return {std::min<Real>(0.0, way) + std::min<Real>(0.0, more),
          std::max<Real>(0.0, way) + std::max<Real>(0.0, more)};
}

/// Whether B, `offset` [m] from A at first, may come within `reach` of it along that axis. Where a
/// time is infinite and this is no number, it may.
inline bool may_come_within(Real reach, Real offset, const Stretch& a, const Stretch& b) {
  return !(offset + (b.low - a.high) > reach || offset + (b.high - a.low) < -reach);
}

}  // namespace rink::physics::inline RINK_PRECISION
