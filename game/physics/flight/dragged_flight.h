// Discs that linear drag slows alike: they move on straight lines, on a clock that runs ever
// slower.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "game/physics/flight/exponential.h"
#include "game/physics/flight/motion.h"
#include "game/physics/flight/straight_flight.h"
#include "game/physics/flight/time_to_touch.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// The instant at which the warped clock has advanced by `warped` since `start`; infinite if it
/// never does.
inline Real time_on_warped_clock(Real start, Real warped, Real drag) {
  if (drag == 0.0) return start + warped;
  const Real lost = drag * warped;
  return lost < 1.0 ? start - log1p_of(-lost) / drag : std::numeric_limits<Real>::infinity();
}

/// B seen from A at `time`, the later of their two last events, so that it depends on nothing but
/// the two states.
struct Sighting {
  Real time;                    ///< s
  RealVector offset, velocity;  ///< m, m/s
};

inline Sighting sighting_of(const Flight& a, const Flight& b, Real drag) {
  const Real time = std::max(a.time, b.time);
  RealVector offset(b.x - a.x, b.y - a.y);
  if (drag == 0.0) {
    const Real ahead_a = time - a.time, ahead_b = time - b.time;
    offset += RealVector(b.vx * ahead_b - a.vx * ahead_a, b.vy * ahead_b - a.vy * ahead_a);
    return {time, offset, RealVector(b.vx - a.vx, b.vy - a.vy)};
  }
  const auto warped_since = [&](const Flight& c) {
    return c.time == time ? WarpedTime{0.0, 0.0, 1.0} : warp_unaccelerated(time - c.time, drag);
  };
  const WarpedTime wa = warped_since(a), wb = warped_since(b);
  offset += RealVector(b.vx * wb.s - a.vx * wa.s, b.vy * wb.s - a.vy * wa.s);
  return {time, offset, RealVector(b.vx * wb.e - a.vx * wa.e, b.vy * wb.e - a.vy * wa.e)};
}

/// When two discs that are seen so first touch; nothing if they never do, or only after `latest`:
/// the warped clock never runs ahead of real time. Discs in contact and closing touch at once.
inline std::optional<Real> dragged_contact_time(const Sighting& sighting, Real reach, Real latest,
                                                Real drag) {
  const auto wait =
      time_to_touch(sighting.offset, sighting.velocity, reach, latest - sighting.time);
  return wait ? std::optional(time_on_warped_clock(sighting.time, *wait, drag)) : std::nullopt;
}

}  // namespace rink::physics::inline RINK_PRECISION
