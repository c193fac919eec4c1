// When a goal may come: time stops there, so no window that tiles play may go on beyond it.
#pragma once

#include "game/physics/engine/engine.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// The first instant after the present at which a puck near a goal would be in it, if it went on in
/// straight flight; infinite if none would. A guess: others may come, or deflect this one.
Real next_goal(const Engine::Parts& parts);

}  // namespace rink::physics::inline RINK_PRECISION
