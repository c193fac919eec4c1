// The closed form on which every body moves between two of its events.
#pragma once

#include "game/physics/body.h"
#include "game/physics/exponential.h"

namespace rink::physics {

/// Elapsed time as linear drag sees it: dv/dt = a - g v from x0, v0 gives x = x0 + v0 s + a q and v = v0 e + a s (docs/physics.md, "Motion").
struct WarpedTime {
  double s;  ///< (1 - exp(-g t))/g [s]; t without drag
  double q;  ///< (t - s)/g [s^2]; t^2/2 without drag
  double e;  ///< exp(-g t)
};

/// `elapsed` [s] and `drag` [1/s] at least 0. s and q are within 4 ulp, also where g t is small and (t - s)/g would cancel; e is within 1e-16.
WarpedTime warp(double elapsed, double drag);

/// The same, bit for bit, but with q = 0: it costs three times as much as the rest, and a body without thrust has no use for it.
WarpedTime warp_unaccelerated(double elapsed, double drag);

/// The state of a body at its last event, and the law it has followed since; each axis has its own acceleration and drag, for a body in rest contact shares those of
/// its partners along the contact's axis only.
struct Motion {
  double time = 0.0;  ///< of the last event [s]
  Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};
  Vector2 acceleration{0.0, 0.0};  ///< m/s^2
  Vector2 drag{0.0, 0.0};          ///< 1/s

  /// The same law, re-based at `instant` (not before `time`).
  Motion at(double instant) const;
};

}  // namespace rink::physics
