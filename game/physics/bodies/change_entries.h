// What the event at hand has changed, entered into the journal of a subdomain of a world.
#pragma once

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/journal.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// A digest of all but the flight, the same whichever way an impact took. The rhythm of impacts
/// follows from their list, where Journal::mixed_digest stands for it.
std::uint64_t conditions_of(const Bodies& bodies, std::uint32_t body);

/// Enters whom the event touched, and whom it only looked at, as they go on from it; then the next
/// event is at hand. An impact of two free pucks is one as Journal::enter_impact() takes it, which
/// way it may have gone, if such impacts `may_be_quiet`.
void enter_changes(Journal& journal, const Bodies& bodies, bool may_be_quiet);

}  // namespace rink::physics::inline RINK_PRECISION
