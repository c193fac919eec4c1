// What is kept of a world to come back to, beside what its bodies were.
#pragma once

#include <cstdint>
#include <vector>

#include "game/physics/bodies/clock.h"
#include "game/physics/body_state.h"
#include "game/physics/counters.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

struct WorldMark {
  std::vector<RestContact> rest_contacts;
  std::vector<std::uint32_t> frozen;  ///< bodies in jams
  Clock clock;
  std::uint32_t jam_count = 0;
  Counters counters;
};

}  // namespace rink::physics::inline RINK_PRECISION
