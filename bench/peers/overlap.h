// How deep bodies lie in each other: one measure for every engine, taken from places alone.
#pragma once

#include <limits>
#include <span>

#include "game/physics/body.h"

namespace rink::peers {

using physics::BodyId;
using physics::BodyKind;
using physics::Vector2;

/// The outline of a body and how hard it is to move: a rectangle of `half_extent` [m] grown by
/// `radius` [m] (a disc has no half extent, a bat no radius).
struct Outline {
  BodyKind kind = BodyKind::puck;
  double radius = 0.0;
  Vector2 half_extent{0.0, 0.0};
  double mass = std::numeric_limits<double>::infinity();  ///< kg; infinity for what never moves

  Vector2 reach() const { return half_extent + Vector2::Constant(radius); }
};

/// How deep [m] two bodies whose centres are `offset` apart lie in each other; 0 or less if they do
/// not.
double depth(const Outline& a, const Outline& b, const Vector2& offset);

/// The deepest overlap [m] of two bodies with their centres at `places` (as many as `outlines`), or
/// of one that moves and a wall of `field`; 0 if none overlap. Bodies whose centre is outside the
/// field or not a number are left out: they have escaped, which is counted apart.
double deepest_overlap(const physics::Field& field, std::span<const Outline> outlines,
                       std::span<const Vector2> places);

}  // namespace rink::peers
