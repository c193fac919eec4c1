// The walls, the halfway line and the goals as shapes that a body meets.
#pragma once

#include "game/physics/bodies/partner.h"
#include "game/physics/body.h"
#include "game/physics/flight/impact_time.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// The half-plane of a wall or the halfway line, grown by the `extent` of a body that keeps to
/// `half`: its centre must stay on the side of the normal.
HalfPlane plane_of(const Field& field, Partner wall, const RealVector& extent, Half half);

/// The point of the end wall where a goal begins.
RealVector goal_edge(const Field& field, Partner edge);

}  // namespace rink::physics::inline RINK_PRECISION
