// Up to which times, gaps and speeds the engine takes contacts for one, or for parted.
#pragma once

#include <limits>

#include "game/physics/body.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Impacts are looked at together if they come within this time of each other [s]; whether they are
/// one is decided by their gaps.
constexpr double instant = 1e-9;
/// Bodies nearer than this take part in a hop [m].
constexpr double cluster_gap = 2e-6;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The rounding error of an offset [m].
inline Real offset_tolerance(const WorldSpec& spec) {
  return 0x1p-52 * fineness * (spec.field.length + spec.field.width);
}
/// Pressed contacts that close more slowly come to rest [m/s].
inline Real rest_speed(const WorldSpec& spec) { return 20.0 * Real(spec.contact_time); }

/// A pressed cluster glides no longer than that [s].
inline Real glide_max(const WorldSpec& spec) { return 16.0 * Real(spec.contact_time); }

}  // namespace rink::physics::inline RINK_PRECISION
