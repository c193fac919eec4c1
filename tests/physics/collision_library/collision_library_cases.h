// Seeded encounters that are hard in one way each, for the tests and the benchmarks of the
// collision library.
#pragma once

#include <cmath>
#include <cstdint>

#include "game/physics/collision/shapes.h"
#include "im/basics/seeded_stream.h"

namespace rink::physics::collision::reference {

/// `random`: aimed somewhere at the obstacle from about its size away; `grazing`: past its rim at a
/// depth or clearance of 1e-17 to 1e-2 of its size; `distant`: from 10 to 1e4 sizes away; `near`:
/// gaps of 1e-12 to 1e-3 of its size; `tiny` and `huge`: random ones of 1e-9 and 1e9 times the
/// lengths at any speed; `far`: random ones at coordinates of about 1e6 m.
enum class Difficulty { random, grazing, distant, near, tiny, huge, far };
inline constexpr int difficulty_count = 7;
inline constexpr Difficulty difficulties[] = {
    Difficulty::random, Difficulty::grazing, Difficulty::distant, Difficulty::near,
    Difficulty::tiny,   Difficulty::huge,    Difficulty::far};
inline constexpr const char* difficulty_names[] = {"random", "grazing", "distant", "near",
                                                   "tiny",   "huge",    "far"};

struct Seeded : SeededStream {
  using SeededStream::SeededStream;
  /// Uniform in the exponent.
  double magnitude(double low, double high) {
    return low * std::pow(high / low, uniform(0.0, 1.0));
  }
  double sign() { return next() % 2 == 0 ? -1.0 : 1.0; }
  Vector<double> direction() {
    const double angle = uniform(0.0, 6.283185307179586);
    return {std::cos(angle), std::sin(angle)};
  }
};

/// The obstacle around the origin that a pair of shapes comes down to, as far as aiming needs it.
struct Target {
  Vector<double> half_extent{0.0, 0.0};
  double radius = 0.0;

  double size() const { return half_extent.norm() + radius; }
  /// The point furthest towards `direction`.
  Vector<double> rim(const Vector<double>& direction) const {
    return Vector<double>(std::copysign(half_extent.x(), direction.x()),
                          std::copysign(half_extent.y(), direction.y())) +
           radius * direction;
  }
};

/// Two moving places. How they see each other is what was aimed at up to the rounding of their
/// coordinates: the truth is computed from what is here.
struct Encounter {
  Vector<double> position_a, velocity_a, position_b, velocity_b;

  Vector<double> offset() const { return position_a - position_b; }
  Vector<double> velocity() const { return velocity_a - velocity_b; }
};

/// Lengths by which shapes of `difficulty` are scaled.
inline double scale_of(Difficulty difficulty) {
  return difficulty == Difficulty::tiny ? 1e-9 : difficulty == Difficulty::huge ? 1e9 : 1.0;
}

inline Encounter encounter(Seeded& seeded, Difficulty difficulty, const Target& target,
                           bool is_b_still = false) {
  const double size = target.size();
  const Vector<double> heading = seeded.direction(), left(-heading.y(), heading.x());
  Vector<double> aim(seeded.uniform(-1.0, 1.0) * (target.half_extent.x() + target.radius),
                     seeded.uniform(-1.0, 1.0) * (target.half_extent.y() + target.radius));
  double distance = seeded.uniform(2.5, 5.0) * size;
  if (difficulty == Difficulty::grazing) {
    const Vector<double> out = seeded.sign() * left;
    aim = target.rim(out) + seeded.sign() * seeded.magnitude(1e-17, 1e-2) * size * out;
  }
  if (difficulty == Difficulty::distant) distance = seeded.magnitude(10.0, 1e4) * size;
  if (difficulty == Difficulty::near) {
    aim = target.rim(-heading) - seeded.magnitude(1e-12, 1e-3) * size * heading;
    distance = 0.0;
  }
  const double speed = scale_of(difficulty) * seeded.magnitude(0.1, 10.0) *
                       (scale_of(difficulty) == 1.0 ? 1.0 : seeded.magnitude(1e-3, 1e3));
  const Vector<double> turned = difficulty == Difficulty::near
                                    ? Vector<double>(heading + seeded.uniform(-2.0, 2.0) * left)
                                    : heading;
  const double place = difficulty == Difficulty::far                                         ? 1e6
                       : difficulty == Difficulty::near || difficulty == Difficulty::grazing ? 0.0
                                                                                             : size;
  Encounter e;
  e.position_b = Vector<double>(seeded.uniform(1.0, 2.0), seeded.uniform(-2.0, -1.0)) * place;
  e.position_a = e.position_b + aim - distance * heading;
  e.velocity_b = seeded.direction() * (is_b_still ? 0.0 : speed * seeded.uniform(0.0, 1.0));
  e.velocity_a = e.velocity_b + speed * turned;
  return e;
}

}  // namespace rink::physics::collision::reference
