// The integrals that a body's law of motion costs.
#include "game/physics/bodies/energy_ledger.h"

#include <algorithm>
#include <cassert>

namespace rink::physics::inline RINK_PRECISION {

/// Along each axis the integrals of a v and g v^2, with v = v0 e + a s (docs/physics.md, "Energy").
/// Of the acceleration, friction takes its part; all else is thrust: the body's own, or its share
/// in that of those who press on it.
EnergyTransfer energy_transfer_of(const Motion& m, Real time, Real mass,
                                  const RealVector* slowing) {
  assert(mass > 0.0 && !(m.drag.minCoeff() < 0.0));
  const Real elapsed = std::min(time, m.rest_time) - m.time;
  if (elapsed <= 0.0) return {0.0, 0.0};
  Real pushed = 0.0, dragged = 0.0, rubbed = 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    const Real v = m.velocity[axis], a = m.acceleration[axis], g = m.drag[axis];
    const WarpedTime w = a == 0.0 ? warp_unaccelerated(elapsed, g) : warp(elapsed, g);
    pushed += a * (v * w.s + a * w.q);
    if (slowing != nullptr) rubbed += (*slowing)[axis] * (v * w.s + a * w.q);
    dragged +=
        g * v * (0.5 * v * w.s * (1.0 + w.e) + a * w.s * w.s) + a * a * (w.q - 0.5 * w.s * w.s);
  }
  if (slowing != nullptr) return {mass * (pushed - rubbed), mass * (dragged - rubbed)};
  return {mass * pushed, mass * dragged};
}

}  // namespace rink::physics::inline RINK_PRECISION
