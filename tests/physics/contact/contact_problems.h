// Problems of bodies in contact as plain values, for the tests of their solvers.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "game/physics/contact/contact_problem.h"
#include "tests/physics/scenes.h"

namespace rink::physics::test {

inline void add_body(ContactProblem& problem, double mass, const Vector2& velocity) {
  problem.add_body(mass, 1.0 / mass, velocity, false);
}

/// The contact pushes `body` along `angle` [rad], and `other` the other way.
inline void add_touch(ContactProblem& problem, std::uint32_t body, std::uint32_t other,
                      double angle, double restitution = 1.0) {
  problem.touches.push_back({body, other, {std::cos(angle), std::sin(angle)}, restitution});
}

/// A row along x in which each body touches the next; the normals point back to the first.
inline ContactProblem row_of(const std::vector<double>& masses, double first_speed,
                             double restitution = 1.0) {
  ContactProblem problem;
  for (const double mass : masses)
    add_body(problem, mass, {problem.body_count() == 0 ? first_speed : 0.0, 0.0});
  for (std::uint32_t body = 0; body + 1 < masses.size(); ++body)
    problem.touches.push_back({body, body + 1, {-1.0, 0.0}, restitution});
  return problem;
}

/// Bodies of masses that are `mass_ratio` apart at most, with random velocities, and contacts in
/// random directions between them and with what is fixed. Not all could be laid on a table.
inline ContactProblem random_problem(std::mt19937_64& random, double mass_ratio,
                                     double restitution) {
  ContactProblem problem;
  const auto bodies = static_cast<std::uint32_t>(2 + random() % 4), touches = bodies + 1;
  for (std::uint32_t body = 0; body < bodies; ++body)
    add_body(problem, std::pow(mass_ratio, uniform(random, -0.5, 0.5)),
             {uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)});
  for (std::uint32_t touch = 0; touch < touches; ++touch) {
    const auto body = static_cast<std::uint32_t>(random() % bodies);
    const auto other = static_cast<std::uint32_t>((body + 1 + random() % bodies) % (bodies + 1));
    add_touch(problem, body, other == bodies ? fixed_place : other,
              uniform(random, 0.0, 6.283185307179586), restitution);
  }
  return problem;
}

inline Vector2 momentum_of(const ContactProblem& problem) {
  Vector2 sum(0.0, 0.0);
  for (std::size_t place = 0; place < problem.body_count(); ++place)
    sum += problem.masses[place] * problem.velocities[place];
  return sum;
}

/// The slowest parting of all contacts; below 0 if one closes.
inline double slowest_parting(const ContactProblem& problem) {
  double slowest = std::numeric_limits<double>::infinity();
  for (const Touch& touch : problem.touches)
    slowest = std::min(slowest, parting(touch, problem.velocities));
  return slowest;
}

}  // namespace rink::physics::test
