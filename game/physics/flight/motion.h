// The closed form on which every body moves between two of its events.
#pragma once

#include <limits>

#include "game/physics/body.h"
#include "game/physics/flight/exponential.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Elapsed time as linear drag sees it: dv/dt = a - g v from x0, v0 gives x = x0 + v0 s + a q and v
/// = v0 e + a s (docs/physics.md, "Motion").
struct WarpedTime {
  Real s;  ///< (1 - exp(-g t))/g [s]; t without drag
  Real q;  ///< (t - s)/g [s^2]; t^2/2 without drag
  Real e;  ///< exp(-g t)
};

/// `elapsed` [s] and `drag` [1/s] at least 0. s and q are within 4 ulp, also where g t is small and
/// (t - s)/g would cancel; e is within 1e-16.
WarpedTime warp(Real elapsed, Real drag);

/// The same, bit for bit, but with q = 0: it costs three times as much as the rest, and a body
/// without thrust has no use for it.
inline WarpedTime warp_unaccelerated(Real elapsed, Real drag) {
  if (drag == 0.0) return {elapsed, 0.0, 1.0};
  const Real lost = expm1_of(-drag * elapsed);
  return {-lost / drag, 0.0, 1.0 + lost};
}

/// The state of a body at its last event, and the law it has followed since; each axis has its own
/// acceleration and drag, for a body in rest contact shares those of its partners along the
/// contact's axis only.
struct Motion {
  Real time = 0.0;  ///< of the last event [s]
  RealVector position{0.0, 0.0}, velocity{0.0, 0.0};
  RealVector acceleration{0.0, 0.0};  ///< m/s^2
  RealVector drag{0.0, 0.0};          ///< 1/s
  Real rest_time =
      std::numeric_limits<Real>::infinity();  ///< from this instant on the body lies still, which
                                              ///< friction brought to rest [s]

  /// The same law, re-based at `instant` (not before `time`).
  Motion at(Real instant) const;

  /// Puts the body, which no thrust drives and whose drag is the same along both axes of its
  /// motion, under Coulomb friction: it decelerates by `friction` [m/s^2] along its velocity until
  /// it rests, on a straight line (docs/physics.md, "Friction with the table").
  void slide(Real friction);
};

}  // namespace rink::physics::inline RINK_PRECISION
