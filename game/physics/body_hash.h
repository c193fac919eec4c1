// The hash of a world's bodies, told one after the other.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>

#include "game/physics/body_state.h"
#include "game/physics/real.h"
#include "im/basics/fnv_hash.h"

namespace rink::physics::inline RINK_PRECISION {

/// FNV-1a over the states of all bodies in order of their numbers; what World::hash() gives.
class BodyHash {
 public:
  /// `lasting`: in or out of play, held, frozen. The law of motion only of those that do not fly
  /// straight, the spin only in worlds with surface friction.
  void add(const Flight& flight, const RealVector* acceleration, const RealVector* drag,
           std::uint8_t lasting, std::optional<Real> spin) {
    for (const Real value : {flight.x, flight.y, flight.vx, flight.vy, flight.time}) mix(value);
    if (acceleration != nullptr)
      for (int axis = 0; axis < 2; ++axis) mix((*acceleration)[axis]), mix((*drag)[axis]);
    mix(lasting);
    if (spin) mix(*spin);
  }
  std::uint64_t value() const { return hash_.value(); }

 private:
  void mix(Real value) {
    hash_.add_number(static_cast<double>(value));
    if constexpr (sizeof(Real) > sizeof(double))
      hash_.add_number(static_cast<double>(value - static_cast<Real>(static_cast<double>(value))));
  }

  Fnv64 hash_;
};

}  // namespace rink::physics::inline RINK_PRECISION
