// When a body's centre crosses the halfway line on one course, from its closed form.
#pragma once

#include <array>
#include <cstddef>

#include "game/physics/body.h"
#include "game/physics/flight/motion.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// The half [x < line or x > line] in which a body of this motion is right after its last event;
/// one that begins on the line is where it goes to. Half::both: it stays on the line.
Half half_after(const Motion& motion, Real line);

/// The centre is in `into` from after `time` [s] on.
struct HalfCrossing {
  Real time = 0.0;
  Half into = Half::both;
};

/// Crossings of the line x = `line` after the motion's last event, in order. Thrust or friction
/// along x keeps its sign, so a body turns at most once, and crosses at most twice. A course that
/// touches the line and turns does not cross it.
struct HalfCrossings {
  std::array<HalfCrossing, 2> all{};
  std::size_t count = 0;
};

/// A pure function of the motion. Without acceleration along x the time is that of the formula, to
/// some roundings of it; otherwise the first one at which a double shows the body beyond the line.
HalfCrossings half_crossings(const Motion& motion, Real line);

}  // namespace rink::physics::inline RINK_PRECISION
