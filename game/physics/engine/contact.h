// Two that touch or are about to: where, and what a joint impact needs to know of them.
#pragma once

#include <cstdint>

#include "game/physics/body.h"
#include "game/physics/engine/partner.h"
#include "game/physics/flight/impact_time.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// A body, whom or what it meets, and the gap between them.
struct Contact {
  std::uint32_t body;
  Partner partner;
  Gap gap;  // normal from partner to body
};

constexpr std::uint32_t fixed_place = 0xffffffff;

/// Two bodies that touch, or a body and a fixed part; `body` and `other` are places in the engine's
/// joint_, `fixed_place` for what cannot move.
struct Touch {
  std::uint32_t body, other;
  Partner partner;
  RealVector normal;
  Real restitution;
  Real wanted;      // least speed of separation afterwards [m/s]
  Real impulse;     // of the problem at hand [kg m/s]
  bool is_at_hand;  // the impact that called for the others
  bool has_pushed;
};

}  // namespace rink::physics::inline RINK_PRECISION
