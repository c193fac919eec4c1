// Random numbers whose bits are the same on every machine: generators and distributions of the
// standard library differ between libraries.
#pragma once

#include <cmath>
#include <cstdint>

#include "game/physics/body.h"
#include "game/physics/flight/exponential.h"

namespace rink::game {

/// SplitMix64 (Steele, Lea and Flood 2014): passes BigCrush, and any 64-bit number is a good seed.
/// Streams of one seed are independent.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed, std::uint64_t stream = 0)
      : state_(mixed(seed) ^ mixed(~stream)) {}

  std::uint64_t next() { return mixed(state_ += 0x9e3779b97f4a7c15u); }
  /// Within [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Within [0, count), for count far below 2^32, where the bias of the multiplication is below
  /// 1e-9.
  std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>((next() >> 32) * count >> 32);
  }

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
    constexpr double mode_of_mean = 0.79788456080286535588;  // sqrt(2/pi)
    return mean * mode_of_mean * std::sqrt(-2.0 * physics::log1p_of(-uniform()));
  }

 private:
  static std::uint64_t mixed(std::uint64_t bits) {
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return bits ^ (bits >> 31);
  }
  std::uint64_t state_;
};

}  // namespace rink::game
