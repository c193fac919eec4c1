// Pressed clusters taken out of contact, from plain values: how fast they part, what that costs,
// and which of them can bear their thrust.
#include <gtest/gtest.h>

#include "game/physics/contact/separation_solver.h"
#include "tests/physics/contact/contact_problems.h"

namespace rink::physics::test {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

TEST(SeparationSolver, PartsEveryContactAsFastAsWantedAndNoMomentumIsMade) {
  SeparationSolver solver;
  for (const std::size_t count : {2u, 5u, 50u}) {
    SCOPED_TRACE(testing::Message() << count << " bodies");
    ContactProblem problem = row_of(std::vector<double>(count, 1.0), 0.0);
    const double gained = solver.part(problem, 1e-3, no_limit);
    EXPECT_GE(slowest_parting(problem), 1e-3 * (1.0 - 1e-9));
    EXPECT_LT(momentum_of(problem).norm(), 1e-12);
    EXPECT_NEAR(gained, problem.energy(), 1e-15);
  }
}

/// Beyond 96 contacts by sweeps, to a tenth of what is wanted.
TEST(SeparationSolver, PartsAlsoTooManyContactsForTheDirectWay) {
  ContactProblem problem;
  for (int pair = 0; pair < 100; ++pair) {
    add_body(problem, 1.0, {0.0, 0.0});
    add_body(problem, 2.0, {0.0, 0.0});
    add_touch(problem, static_cast<std::uint32_t>(2 * pair),
              static_cast<std::uint32_t>(2 * pair + 1), 0.1 * pair);
  }
  SeparationSolver solver;
  solver.part(problem, 1e-3, no_limit);
  EXPECT_GE(slowest_parting(problem), 0.9e-3);
}

/// What would take more energy than may be gained is paid from the motion against each other.
TEST(SeparationSolver, GainsNoMoreEnergyThanItMay) {
  constexpr std::uint64_t seed = 4;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  SeparationSolver solver;
  for (int trial = 0; trial < 300; ++trial) {
    ContactProblem problem = random_problem(random, trial % 2 == 0 ? 10.0 : 1e12, 1.0);
    const double energy = problem.energy();
    const double gained = solver.part(problem, 0.1, 1e-6 * energy);
    EXPECT_LE(problem.energy(), energy * (1.0 + 1e-6 + 1e-9));
    EXPECT_LE(gained, 1e-6 * energy * (1.0 + 1e-9));
  }
}

/// Who is held from opposite sides parts from neither, and has the same velocity to the bit.
TEST(SeparationSolver, HoldsWhatIsBetweenTwoWallsStill) {
  ContactProblem problem = row_of({1.0, 1.0}, 0.1);
  for (Vector2& velocity : problem.velocities) velocity.y() = 1.0;  // between them it is free
  problem.touches.push_back({0, fixed_place, {1.0, 0.0}, 1.0});
  problem.touches.push_back({1, fixed_place, {-1.0, 0.0}, 1.0});
  SeparationSolver solver;
  solver.part(problem, 1e-3, no_limit);
  EXPECT_EQ(problem.velocities[0].x(), 0.0);
  EXPECT_EQ(problem.velocities[1].x(), 0.0);
}

TEST(SeparationSolver, TellsWhichClusterBearsItsThrust) {
  SeparationSolver solver;
  const auto pressed = [&](double thrust, double friction) {
    ContactProblem problem;
    problem.add_body(1.0, 1.0, {thrust, 0.0}, false);
    problem.add_body(1.0, 1.0, {0.0, 0.0}, true);
    problem.touches.push_back({0, 1, {-1.0, 0.0}, 1.0});
    return solver.bears(problem, friction, 1e-6 * thrust);
  };
  EXPECT_FALSE(pressed(1.0, 0.0));
  EXPECT_FALSE(pressed(1.0, 0.5));
  EXPECT_TRUE(pressed(1.0, 1.5));  // against the friction of the second

  ContactProblem against_wall = row_of({1.0, 1.0}, 5.0);
  against_wall.touches.push_back({1, fixed_place, {-1.0, 0.0}, 1.0});
  EXPECT_TRUE(solver.bears(against_wall, 0.0, 1e-6));
}

}  // namespace
}  // namespace rink::physics::test
