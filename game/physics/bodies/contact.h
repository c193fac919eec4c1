// Two that touch or are about to, and where.
#pragma once

#include <cstdint>

#include "game/physics/bodies/partner.h"
#include "game/physics/flight/impact_time.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// A body, the body or obstacle that it touches, and the gap between the two.
struct Contact {
  std::uint32_t body;
  Partner partner;
  Gap gap;  // normal from partner to body
};

}  // namespace rink::physics::inline RINK_PRECISION
