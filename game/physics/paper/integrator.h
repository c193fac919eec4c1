// How a frame moves a body whose acceleration follows from its velocity: four methods of different
// order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "game/physics/body.h"

namespace rink::physics::paper {

/// Global order in free flight: 1, 1, 2, 4.
enum class Integrator : std::uint8_t { euler, semi_implicit, verlet, rk4 };

/// In order of the enumeration: euler, semi_implicit, verlet, rk4.
const std::vector<std::string>& integrator_names();
std::optional<Integrator> integrator_named(const std::string& name);

/// What accelerates a body: dv/dt = thrust - drag v - friction v/|v|.
struct Force {
  Vector2 thrust{0.0, 0.0};  ///< m/s^2
  double drag = 0.0;         ///< 1/s
  double friction = 0.0;     ///< Coulomb's, with the table [m/s^2]; only where there is no thrust

  Vector2 acceleration(const Vector2& velocity) const {
    const Vector2 smooth = thrust - drag * velocity;
    if (friction == 0.0 || velocity == Vector2(0.0, 0.0)) return smooth;
    return smooth - friction * velocity.normalized();
  }
};

struct Phase {
  Vector2 position{0.0, 0.0}, velocity{0.0, 0.0};
};

/// Where a step leads. The displacement is kept apart from the position, so that the straight path
/// of a frame has no rounding error of the place in it.
struct Step {
  Vector2 displacement{0.0, 0.0};  ///< m
  Vector2 velocity{0.0, 0.0};      ///< at the end [m/s]
};

/// One step of `duration` [s], 0 or more, from `velocity`. Friction stops a body, it never turns it
/// round.
Step step(Integrator integrator, const Vector2& velocity, const Force& force, double duration);

}  // namespace rink::physics::paper
