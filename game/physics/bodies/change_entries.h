// What the event at hand has changed, entered into the journal of a subdomain of a world.
#pragma once

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/journal.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Enters whom the event touched, and whom it only looked at, as they go on from it; then the next
/// event is at hand.
void enter_changes(Journal& journal, const Bodies& bodies);

}  // namespace rink::physics::inline RINK_PRECISION
