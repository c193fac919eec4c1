// Who looks at a world while it is played.
#pragma once

#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

class BeforeImages;
struct Journal;

/// Nobody, or a portion of a world (portion.h), which may want to undo a window and tells other
/// worlds what happened in it. Nothing that they are told changes the motion.
struct Observers {
  BeforeImages* before = nullptr;
  Journal* journal = nullptr;
};

}  // namespace rink::physics::inline RINK_PRECISION
