// A trajectory as the residual to where the one before it leads.
#pragma once

#include "game/replication/attributes.h"
#include "game/replication/trajectory.h"
#include "rti/fom/attribute_codec.h"
#include "rti/wire/bit_stream.h"

namespace rink::game {

/// Where `former` leads by `instant` [s]: place [m] and velocity [m/s]. Not the closed form, but
/// within 3e-5 of the distance from it, and of additions, multiplications, divisions and square
/// roots alone, which give the same bits on any machine (docs/replication.md, "Residuals").
struct Lead {
  physics::Vector2 position, velocity;
};
Lead lead_of(const Trajectory& former, const Shape& shape, double instant);

/// How a body that hit another changed its motion.
struct Impact {
  Trajectory former, after;
  Shape shape;
};

/// What a residual refers to.
struct TrajectoryBasis {
  Trajectory former;
  Shape shape;
  double time = 0.0;               ///< of the stamp [s]
  const Impact* impact = nullptr;  ///< of the body that was hit, if the residual refers to it, too
};

/// Writes `t` as the residual to the trajectory before; false if it is not on the grid, has a law
/// that the form cannot say, or, beside an impact, shares neither its instant nor its momentum.
/// Nothing is written then.
bool write_residual(rti::BitWriter& bits, const TrajectoryBasis& basis, const Trajectory& t);
/// Reads what `write_residual` wrote; false if the bits are malformed.
bool read_residual(rti::BitReader& bits, const TrajectoryBasis& basis, Trajectory& t);
/// Steps over a residual and names its fields; `is_of_impact`: it refers to an impact, too.
bool list_residual(rti::BitReader& bits, bool is_of_impact, const rti::FieldVisitor& visit);

}  // namespace rink::game
