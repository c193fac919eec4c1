// What the engine keeps of each body: how it moves, what it is, what befell it, what comes next.
#pragma once

#include <cstdint>

#include "game/physics/bodies/partner.h"
#include "game/physics/body.h"
#include "game/physics/flight/straight_flight.h"
#include "game/physics/grid/cell_grid.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// What an impact of two pucks reads and writes: one cache line.
struct alignas(64) Body : Flight {
  enum Flag : std::uint8_t {
    removed = 1,
    out_of_play = 2,
    curved = 4,
    held_x = 8,
    held_y = 16,
    frozen = 32,
    touched = 64,  // by the event at hand
    pending = 128  // to be predicted when time goes on
  };
  static constexpr std::uint8_t gone = removed | out_of_play, held = held_x | held_y,
                                lasting = gone | held | frozen;
  static constexpr std::uint8_t held_along(int axis) { return axis == 0 ? held_x : held_y; }
  enum Mouth : std::uint8_t { no_mouth, left_mouth, right_mouth };

  Real inverse_mass;
  std::uint32_t version;
  BodyKind kind;
  MaterialId material;
  std::uint8_t flags;  // of Flag
  std::uint8_t mouth;  // of Mouth

  /// Any of `some`.
  bool is(std::uint8_t some) const { return (flags & some) != 0; }
};

/// What the body is, and the thrust on it.
struct BodyShape {
  Real mass, inverse_mass;
  RealVector half_extent;  // of the rectangle itself: 0 for discs
  RealVector thrust;
  Half half;
};

/// What its velocity changes by until its next event.
struct ForceLaw {
  RealVector acceleration, drag;
};

/// How often something came at the last instant at which it did.
struct RepeatCount {
  Real instant = -1.0;
  std::uint32_t count = 0;
  /// Once more at `time`; answers how often now.
  std::uint32_t add(Real time) {
    count = instant == time ? count + 1 : 1;
    instant = time;
    return count;
  }
};

/// How densely impacts follow each other; part of the physical history.
struct ImpactCounts {
  Real window_start = -1.0;
  Real last_hop = -1.0;  // the end of the glide that began with it
  std::uint32_t impacts = 0, hops = 0;
  RepeatCount repeats;  // impacts where bodies may start in overlap, attempts at rest of pucks
                        // that friction slows
  RepeatCount first_contacts;  // impacts that are not simple ones, at instants within roundings of
                               // the clock
};

/// Its next impact, and its next crossing into another cell of the grid.
struct NextEvent {
  Real impact_time, crossing_time;
  Partner partner;
  std::uint32_t partner_version;
  CellGrid::Direction direction;  // of the crossing
  bool is_tied;                   // another impact of the body comes within the instant
};

}  // namespace rink::physics::inline RINK_PRECISION
