// Bodies in contact as plain values: what the solvers of impacts and separations are handed.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// The place of what cannot move.
constexpr std::uint32_t fixed_place = 0xffffffff;

/// A contact of two bodies, or of a body and something fixed. Bodies are named by their places in
/// the problem.
struct Touch {
  std::uint32_t body, other;  ///< `other` is `fixed_place` for what cannot move
  RealVector normal;          ///< from `other` to `body`, of length 1
  Real restitution;
  Real wanted = 0.0;        ///< least speed of separation afterwards [m/s]
  Real impulse = 0.0;       ///< of the solution at hand [kg m/s]
  bool has_pushed = false;  ///< in any step of an impact
  Real gap = 0.0;           ///< m
  Real reach =
      0.0;  ///< from the point about which the normal turns [m]; 0 if it keeps its direction
};

/// Bodies that can move, by place, and the contacts among them.
struct ContactProblem {
  std::vector<Real> masses, inverse_masses;  ///< kg, 1/kg
  std::vector<RealVector> velocities;        ///< m/s
  std::vector<bool> is_slowed;  ///< by friction with the table; asked only where there is some
  std::vector<Touch> touches;

  void clear() {
    masses.clear(), inverse_masses.clear(), velocities.clear(), is_slowed.clear(), touches.clear();
  }
  void add_body(Real mass, Real inverse_mass, const RealVector& velocity, bool is_slowed_body) {
    assert(mass > 0.0 && inverse_mass >= 0.0);
    masses.push_back(mass), inverse_masses.push_back(inverse_mass);
    velocities.push_back(velocity), is_slowed.push_back(is_slowed_body);
  }
  std::size_t body_count() const { return masses.size(); }

  /// Of two fields of velocities, weighed by the masses.
  Real product(const std::vector<RealVector>& a, const std::vector<RealVector>& b) const {
    assert(a.size() == masses.size() && b.size() == masses.size());
    Real sum = 0.0;
    for (std::size_t place = 0; place < masses.size(); ++place)
      sum += masses[place] * a[place].dot(b[place]);
    return sum;
  }
  Real energy() const { return 0.5 * product(velocities, velocities); }
  /// The highest speed of any body [m/s].
  Real speed() const {
    Real most = 0.0;
    for (const RealVector& velocity : velocities) most = std::max(most, velocity.norm());
    return most;
  }
  /// Asserts that arrays agree, and that touches name bodies and have normals of length 1.
  void check() const {
    assert(inverse_masses.size() == body_count() && velocities.size() == body_count() &&
           is_slowed.size() == body_count());
    for ([[maybe_unused]] const Touch& touch : touches) {
      assert(touch.body < body_count() && touch.other != touch.body);
      assert(touch.other < body_count() || touch.other == fixed_place);
      assert(std::abs(touch.normal.squaredNorm() - 1.0) < 1e-9);
      assert(touch.restitution >= 0.0 && touch.restitution <= 1.0);
    }
  }
};

/// The speed at which the two sides part in a field of velocities: also the field's product,
/// weighed by the masses, with the one that an impulse of 1 causes.
inline Real parting(const Touch& touch, const std::vector<RealVector>& velocities) {
  const RealVector there =
      touch.other == fixed_place ? RealVector(0.0, 0.0) : velocities[touch.other];
  return touch.normal.dot(velocities[touch.body] - there);
}

/// The least separation an impulse leaves, relative to the speeds: far above rounding, far below
/// anything seen.
constexpr Real separation_min = 1e-14 * fineness;

/// At which bodies of these velocities part at least, times `distance` [m^2/s].
inline Real least_parting(const RealVector& one, const RealVector& other, Real distance) {
  return separation_min * (one.norm() + other.norm()) * distance;
}

/// Relative to the speeds: what closes more slowly does not close, and lacks no more of what is
/// wanted than a quarter of it.
constexpr Real rest_of_closing = 4e-13 * fineness;

}  // namespace rink::physics::inline RINK_PRECISION
