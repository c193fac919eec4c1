// All that the future of a body depends on, as a value that one world hands to another.
#pragma once

#include "game/physics/bodies/partner.h"
#include "game/physics/body.h"
#include "game/physics/flight/motion.h"
#include "game/physics/flight/straight_flight.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Of a body at its last event. Another world that is given it goes on with the same bits.
struct BodyState {
  Flight flight{};
  Real mass = 1.0, inverse_mass = 1.0;
  RealVector half_extent{0.0, 0.0}, thrust{0.0, 0.0};
  RealVector acceleration{0.0, 0.0}, drag{0.0, 0.0};
  Real impacts_begin = -1.0, last_hop = -1.0;  ///< how densely impacts follow each other [s]
  std::uint32_t impacts = 0, hops = 0, repeats = 0;
  Real repeats_instant = -1.0;
  Real rest_time = std::numeric_limits<Real>::infinity();
  RealVector slowing{0.0, 0.0};  ///< friction's part in the acceleration
  Real spin = 0.0;
  std::uint32_t jam = 0;  ///< of a frozen body: the lowest number in its jam
  BodyKind kind = BodyKind::puck;
  MaterialId material = 0;
  Half half = Half::both;
  std::uint8_t flags = 0;  ///< in or out of play, held, frozen
  std::uint8_t mouth = 0;

  Motion motion() const {
    return {flight.time, {flight.x, flight.y}, {flight.vx, flight.vy}, acceleration, drag,
            rest_time};
  }
  /// Half of the bounding box [m].
  RealVector extent() const { return half_extent + RealVector::Constant(flight.radius); }
};

/// When a rest contact began, in a form that orders those of different worlds as one world would
/// have made them: events of one instant are processed in order of the bodies' numbers, but for
/// those that others bring about, which come at once; `lower` and `higher` are therefore the
/// highest pair that the instant has seen so far. What keys of the instant bring about comes after
/// all that would have happened without them.
struct RestContactAge {
  double time = 0.0;
  bool follows_keys = false;
  std::uint32_t lower = 0, higher = 0, rank = 0;
  friend auto operator<=>(const RestContactAge&, const RestContactAge&) = default;
};

/// A rest contact along `axis`; `low` is on the side of smaller coordinates. Fixed partners are
/// posts or parts of the field.
struct RestContact {
  Partner low = partner::none, high = partner::none;
  int axis = 0;
  Real pull_time = 0.0;  ///< when the contact force vanishes by drag
  Real force = 0.0;      ///< of the last solution
  Real turn_time = 0.0;  ///< when the friction of pucks in the group takes another direction, or
                         ///< all of it has come to a stop
  RestContactAge age;    ///< holds stand in order of it; only known where a journal is kept
};

}  // namespace rink::physics::inline RINK_PRECISION
