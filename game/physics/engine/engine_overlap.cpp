// Bodies that are pushed to and fro at one instant, for they started in overlap or have no room:
// time must advance all the same.
#include <algorithm>
#include <limits>

#include "game/physics/engine/engine.h"

namespace rink::physics::inline RINK_PRECISION {

/// Stops all that hangs together with the contact, for as long as nothing else acts on it.
void Engine::stop_around(const Contact& c, Real time) {
  gather(c, std::numeric_limits<Real>::infinity(), time);
  record_.note(EventKind::freeze, time, c.body, c.partner);
  jams_.stop(joint_);
}

}  // namespace rink::physics::inline RINK_PRECISION
