// A world's state as a value, and as bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/body_records.h"
#include "game/physics/bodies/clock.h"
#include "game/physics/bodies/energy_ledger.h"
#include "game/physics/bodies/jams.h"
#include "game/physics/body_state.h"
#include "game/physics/counters.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// All that the future depends on. What follows from it (predictions, grid, queue) is made anew,
/// what observers asked for (recorded events) is not part of it.
struct WorldState {
  WorldSpec spec;
  Clock clock;
  Counters counters;
  BodyTable bodies;
  std::vector<ImpactCounts> impact_counts;
  JamTable jams;
  EnergyLedger ledger{false};
  std::vector<RestContact> rest_contacts;
};

/// The same bytes on every machine for the same bits.
std::vector<std::uint8_t> to_snapshot(WorldState state);
/// Nothing if the bytes are no intact snapshot of this version and scalar, or of an impossible
/// state.
std::optional<WorldState> from_snapshot(std::span<const std::uint8_t> bytes);

}  // namespace rink::physics::inline RINK_PRECISION
