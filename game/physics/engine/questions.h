// What can be asked of all bodies at once.
#pragma once

#include <cstdint>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/energy_ledger.h"
#include "game/physics/body.h"
#include "game/physics/engine/places.h"
#include "game/physics/flight/impact_time.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// A world at an instant, for those who only look.
struct Present {
  const Field& field;
  const Bodies& bodies;
  const Places& places;
  Real now;  ///< s
};

/// Whether the shape would lie inside the field there and overlap no body; touching is free.
bool is_free(const Present& present, const RealVector& centre, const RoundedBox& shape);
/// The deepest overlap of any two bodies, or of a body and a wall [m]; 0 if none overlap.
Real max_overlap(const Present& present);

/// Of the bodies in play at `now`, spin included [J].
Real kinetic_energy(const Bodies& bodies, Real now);
/// The momentum of the bodies in play at `now` [kg m/s].
RealVector momentum(const Bodies& bodies, Real now);
/// What thrust has put in up to `now`, and what was lost [J]; 0 where no books are kept.
Real work_of_thrust(const EnergyLedger& ledger, const Bodies& bodies, Real now);
Real dissipated(const EnergyLedger& ledger, const Bodies& bodies, Real now);
/// Of the last-event states of all bodies in order of their ids.
std::uint64_t hash_of(const Bodies& bodies);

}  // namespace rink::physics::inline RINK_PRECISION
