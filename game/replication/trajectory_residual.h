// A trajectory as the residual to where the one before it leads.
#pragma once

#include "game/replication/attributes.h"
#include "game/replication/trajectory.h"
#include "rti/wire/bit_stream.h"

namespace rink::game {

/// Where `former` leads by `instant` [s]: place [m] and velocity [m/s]. Not the closed form, but
/// within 3e-5 of the distance from it, and of additions, multiplications, divisions and square
/// roots alone, which give the same bits on any machine (docs/replication.md, "Residuals").
struct Lead {
  physics::Vector2 position, velocity;
};
Lead lead_of(const Trajectory& former, const Shape& shape, double instant);

/// Writes `t` as the residual to `former`, under a stamp of `time` [s]; false, with nothing
/// written, if it is not on the grid or has a law that the form cannot say.
bool write_residual(rti::BitWriter& bits, const Trajectory& former, const Shape& shape, double time,
                    const Trajectory& t);
/// Reads what `write_residual` wrote; false if the bits are malformed.
bool read_residual(rti::BitReader& bits, const Trajectory& former, const Shape& shape, double time,
                   Trajectory& t);

}  // namespace rink::game
