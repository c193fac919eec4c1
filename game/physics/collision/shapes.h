// The shapes that the collision tests ask about, and what a test answers.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <type_traits>

namespace rink::physics::collision {

template <class Real>
using Vector = Eigen::Matrix<Real, 2, 1>;

/// A parameter that follows the shapes' scalar instead of helping to deduce it: any expression that
/// gives a vector will do.
template <class Type>
using Given = std::type_identity_t<Type>;

/// A puck, a post, or a bounding circle.
template <class Real>
struct Disc {
  Vector<Real> center{Real(0), Real(0)};  ///< m
  Real radius = Real(0);                  ///< m, 0 or more
};

/// An axis-aligned rectangle.
template <class Real>
struct Box {
  Vector<Real> center{Real(0), Real(0)};       ///< m
  Vector<Real> half_extent{Real(0), Real(0)};  ///< m, both 0 or more
};

/// A straight edge with an outside: on the right of whoever walks from `from` to `to`, so that the
/// edges of a counter-clockwise polygon face outwards.
template <class Real>
struct Edge {
  Vector<Real> from{Real(0), Real(0)}, to{Real(1), Real(0)};  ///< m, not the same point
};

/// The line (in three dimensions it would be a plane) through `point` whose outside lies towards
/// `normal`.
template <class Real>
struct Plane {
  Vector<Real> point{Real(0), Real(0)};   ///< m
  Vector<Real> normal{Real(1), Real(0)};  ///< unit
};

/// The first touch of two shapes: `time` [s] from now, and the unit `normal` from the second shape
/// to the first: the way in which the first is pushed.
template <class Real>
struct Contact {
  Real time = Real(0);
  Vector<Real> normal{Real(1), Real(0)};
};

template <class Real>
using MaybeContact = std::optional<Contact<Real>>;

template <class Real>
inline constexpr Real never = std::numeric_limits<Real>::infinity();

}  // namespace rink::physics::collision
