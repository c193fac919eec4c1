// A point that flies straight, against a disc, a box and a rounded box at rest around the origin:
// what every pair of shapes in straight flight comes down to.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "game/physics/collision/shapes.h"
#include "game/physics/flight/time_to_touch.h"

namespace rink::physics::collision {

/// The point at `offset` against the disc of radius `reach`, above 0.
template <class Real>
MaybeContact<Real> meet_disc(const Vector<Real>& offset, const Vector<Real>& velocity, Real reach,
                             Real limit) {
  assert(reach > Real(0));
  const std::optional<Real> time = time_to_touch<Real>(offset, velocity, reach, limit);
  if (!time || *time > limit) return std::nullopt;
  return Contact<Real>{*time, (offset + velocity * *time).normalized()};
}

/// When a point enters a box, and through which face: the one across `axis`.
template <class Real>
struct Entry {
  Real time;
  int axis;
};

/// By slabs (Kay and Kajiya 1986): the point is in the box while it is between both pairs of faces,
/// so it enters with the later of the two axes.
template <class Real>
std::optional<Entry<Real>> enter_box(const Vector<Real>& offset, const Vector<Real>& velocity,
                                     const Vector<Real>& half_extent) {
  assert(!(half_extent.minCoeff() < Real(0)));
  Real enter[2], leave = never<Real>, outside[2], growth[2];
  for (int axis = 0; axis < 2; ++axis) {
    const Real distance = std::abs(offset[axis]);
    outside[axis] = distance - half_extent[axis];
    growth[axis] = offset[axis] < Real(0) ? -velocity[axis] : velocity[axis];
    if (growth[axis] < Real(0)) {
      enter[axis] = outside[axis] / -growth[axis];
      leave = std::min(leave, (distance + half_extent[axis]) / -growth[axis]);
    } else {
      if (outside[axis] > Real(0)) return std::nullopt;
      enter[axis] = -never<Real>;
      if (growth[axis] > Real(0)) leave = std::min(leave, -outside[axis] / growth[axis]);
    }
  }
  if (outside[0] <= Real(0) && outside[1] <= Real(0)) {  // now, through the nearest face
    const int axis = outside[0] >= outside[1] ? 0 : 1;
    return growth[axis] < Real(0) ? std::optional(Entry<Real>{Real(0), axis}) : std::nullopt;
  }
  const int axis = enter[0] >= enter[1] ? 0 : 1;
  return enter[axis] <= leave ? std::optional(Entry<Real>{enter[axis], axis}) : std::nullopt;
}

template <class Real>
Contact<Real> contact_on_face(const Entry<Real>& entry, const Vector<Real>& offset) {
  Contact<Real> contact{entry.time, {Real(0), Real(0)}};
  contact.normal[entry.axis] = offset[entry.axis] < Real(0) ? Real(-1) : Real(1);
  return contact;
}

/// The point at `offset` against the box of `half_extent`.
template <class Real>
MaybeContact<Real> meet_box(const Vector<Real>& offset, const Vector<Real>& velocity,
                            const Vector<Real>& half_extent, Real limit) {
  const auto entry = enter_box<Real>(offset, velocity, half_extent);
  if (!entry || entry->time > limit) return std::nullopt;
  return contact_on_face(*entry, offset);
}

/// One of a box's four corners, and a place in its quadrant.
template <class Real>
struct Corner {
  Vector<Real> at, place;
};

template <class Real>
Corner<Real> corner_near(const Vector<Real>& place, const Vector<Real>& half_extent) {
  return {{std::copysign(half_extent.x(), place.x()), std::copysign(half_extent.y(), place.y())},
          place};
}

/// A corner of the rounded box: a quarter of a disc.
template <class Real>
MaybeContact<Real> meet_corner(const Vector<Real>& offset, const Vector<Real>& velocity,
                               const Corner<Real>& corner, Real radius, Real limit) {
  const auto& [at, place] = corner;
  const Vector<Real> from_corner = offset - at;
  const auto contact = meet_disc<Real>(from_corner, velocity, radius, limit);
  const bool moves_inwards =
      velocity.x() * place.x() < Real(0) && velocity.y() * place.y() < Real(0);
  if (contact || !moves_inwards) return contact;
  // From the square between the arc and the sharp corner there is no way inwards but through the
  // arc: a miss can only be a graze that was lost to rounding.
  const Real time = -from_corner.dot(velocity) / velocity.squaredNorm();
  if (!(time >= Real(0)) || time > limit) return std::nullopt;
  return Contact<Real>{time, (from_corner + velocity * time).normalized()};
}

/// The point at `offset` against the box of `half_extent`, grown by `radius` with rounded corners.
/// Where it would enter the box with sharp corners tells all: either it is on a face, or in the
/// square of one corner, which it can leave for another part of the rounded box only through that
/// corner's arc.
template <class Real>
MaybeContact<Real> meet_rounded_box(const Vector<Real>& offset, const Vector<Real>& velocity,
                                    const Vector<Real>& half_extent, Real radius, Real limit) {
  assert(!(radius < Real(0)));
  if (radius == Real(0)) return meet_box<Real>(offset, velocity, half_extent, limit);
  const Vector<Real> outside = offset.cwiseAbs() - half_extent;
  if (outside.minCoeff() > Real(0) && outside.maxCoeff() < radius)
    return meet_corner<Real>(offset, velocity, corner_near<Real>(offset, half_extent), radius,
                             limit);
  const auto entry =
      enter_box<Real>(offset, velocity, half_extent + Vector<Real>::Constant(radius));
  if (!entry || entry->time > limit) return std::nullopt;
  const int other = 1 - entry->axis;
  Vector<Real> place = offset;
  place[other] = offset[other] + velocity[other] * entry->time;
  if (std::abs(place[other]) <= half_extent[other]) return contact_on_face(*entry, offset);
  return meet_corner<Real>(offset, velocity, corner_near<Real>(place, half_extent), radius, limit);
}

}  // namespace rink::physics::collision
