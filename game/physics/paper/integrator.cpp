// One step of each method; no position is needed, since no force depends on it.
#include "game/physics/paper/integrator.h"

#include <algorithm>
#include <cassert>

namespace rink::physics::paper {

const std::vector<std::string>& integrator_names() {
  static const std::vector<std::string> names{"euler", "semi_implicit", "verlet", "rk4"};
  return names;
}

std::optional<Integrator> integrator_named(const std::string& name) {
  const auto place = std::find(integrator_names().begin(), integrator_names().end(), name);
  if (place == integrator_names().end()) return std::nullopt;
  return static_cast<Integrator>(place - integrator_names().begin());
}

namespace {

/// As the paper does it: the old velocity moves the body, then the old force changes the velocity.
Step euler(const Vector2& v, const Force& force, double h) {
  return {h * v, v + h * force.acceleration(v)};
}

/// The new velocity moves the body (Cromer 1981).
Step semi_implicit(const Vector2& v, const Force& force, double h) {
  const Vector2 after = v + h * force.acceleration(v);
  return {h * after, after};
}

/// Velocity Verlet (Swope et al. 1982). Drag depends on the velocity that is sought, so the force
/// at the end is taken at a velocity predicted by Euler, which keeps the second order.
Step verlet(const Vector2& v, const Force& force, double h) {
  const Vector2 before = force.acceleration(v), after = force.acceleration(v + h * before);
  return {h * (v + 0.5 * h * before), v + 0.5 * h * (before + after)};
}

/// The classical method of Runge and Kutta for (x, v).
Step rk4(const Vector2& v, const Force& force, double h) {
  const Vector2 a1 = force.acceleration(v), v2 = v + 0.5 * h * a1;
  const Vector2 a2 = force.acceleration(v2), v3 = v + 0.5 * h * a2;
  const Vector2 a3 = force.acceleration(v3), v4 = v + h * a3;
  const Vector2 a4 = force.acceleration(v4);
  return {h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4), v + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)};
}

Step unlimited_step(Integrator integrator, const Vector2& velocity, const Force& force,
                    double duration) {
  switch (integrator) {
    case Integrator::euler:
      return euler(velocity, force, duration);
    case Integrator::semi_implicit:
      return semi_implicit(velocity, force, duration);
    case Integrator::verlet:
      return verlet(velocity, force, duration);
    case Integrator::rk4:
      break;
  }
  return rk4(velocity, force, duration);
}

}  // namespace

Step step(Integrator integrator, const Vector2& velocity, const Force& force, double duration) {
  assert(duration >= 0.0 && force.friction >= 0.0);
  Step taken = unlimited_step(integrator, velocity, force, duration);
  if (force.friction == 0.0) return taken;
  // A method whose stages lie on both sides of rest may leave the velocity as it was: friction
  // alone stops the body within the step, whatever the stages add up to.
  const bool comes_to_rest = velocity.norm() <= force.friction * duration;
  if (comes_to_rest || taken.velocity.dot(velocity) <= 0.0) taken.velocity = Vector2(0.0, 0.0);
  if (taken.displacement.dot(velocity) <= 0.0) taken.displacement = Vector2(0.0, 0.0);
  return taken;
}

}  // namespace rink::physics::paper
