// Random points, directions and speeds, with the same bits on every machine.
#pragma once

#include <cassert>
#include <cmath>
#include <cstdint>

#include "game/physics/body.h"
#include "game/physics/flight/exponential.h"
#include "im/basics/seeded_stream.h"

namespace rink::game {

/// Streams of one seed are independent.
class RandomStream : public SeededStream {
 public:
  explicit RandomStream(std::uint64_t seed, std::uint64_t stream = 0)
      : SeededStream(mixed(seed) ^ mixed(~stream)) {}

  /// A point within the unit disc, centre excluded. By rejection, which needs no sine.
  physics::Vector2 in_disc() {
    while (true) {
      const double y = uniform(-1.0, 1.0),
                   x = uniform(
                       -1.0,
                       1.0);  // apart: in which order arguments are evaluated is the compiler's
      const physics::Vector2 point(x, y);
      const double square = point.squaredNorm();
      if (square > 0.0 && square <= 1.0) return point;
    }
  }
  physics::Vector2 direction() {
    const physics::Vector2 point = in_disc();
    return point / std::sqrt(point.squaredNorm());
  }
  /// A speed of a two-dimensional gas in equilibrium (Rayleigh's distribution).
  double maxwell(double mean) {
    assert(mean >= 0.0);
    constexpr double mode_of_mean = 0.79788456080286535588;  // sqrt(2/pi)
    return mean * mode_of_mean * std::sqrt(-2.0 * physics::log1p_of(-uniform()));
  }
};

}  // namespace rink::game
