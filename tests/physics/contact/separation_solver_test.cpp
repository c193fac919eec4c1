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

/// Two pucks that lean on a side wall, and one behind them that runs into both, on their way along
/// it: what parting takes is paid from the motion against each other, for nothing holds them back
/// along the wall.
TEST(SeparationSolver, KeepsTheMomentumAlongAWallThatAClusterLeansOn) {
  for (const double along : {0.0, 1.0, -30.0}) {
    SCOPED_TRACE(along);
    ContactProblem problem;
    for (const double x : {-0.01, 0.01}) add_body(problem, 1.0, {along + x, 0.0});
    add_body(problem, 3.0, {along, -0.02});
    add_touch(problem, 0, 2, 4.0), add_touch(problem, 1, 2, 5.5);
    for (const std::uint32_t body : {0u, 1u})
      problem.touches.push_back({body, fixed_place, {0.0, 1.0}, 0.5});
    const Vector2 before = momentum_of(problem);
    const double energy = problem.energy();
    SeparationSolver solver;
    EXPECT_EQ(solver.part(problem, 1e-2, 0.0), 0.0);  // paid for
    EXPECT_NEAR(momentum_of(problem).x(), before.x(), 1e-15 * std::abs(before.x()) + 1e-16);
    EXPECT_LE(problem.energy(), energy * (1.0 + 1e-15));
    EXPECT_GT(slowest_parting(problem), 1e-4);
  }
}

/// Momentum before, and what walls push, is momentum after: none is made along a wall, and no wall
/// pulls, whatever the energy that parting may cost.
TEST(SeparationSolver, ChangesMomentumOnlyAsFarAsWallsPush) {
  constexpr std::uint64_t seed = 5;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  SeparationSolver solver;
  int sliding = 0, paying = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    ContactProblem problem = random_problem(random, 10.0, 1.0);
    const Vector2 drift(uniform(random, -3.0, 3.0), uniform(random, -3.0, 3.0));
    for (Vector2& velocity : problem.velocities) velocity += drift;
    bool leans[] = {false, false};  // on the wall on the left, and below
    for (Touch& touch : problem.touches) {
      if (touch.other != fixed_place) continue;
      const auto axis = static_cast<int>(trial % 3 < 2 ? trial % 2 : random() % 2);
      touch.normal = Vector2::Unit(axis), leans[axis] = true;
    }
    const Vector2 before = momentum_of(problem);
    const double energy = problem.energy(), gain_max = trial % 2 == 0 ? 0.0 : 1e-3 * energy,
                 rounding = 1e-9 * std::sqrt(energy);
    paying += solver.part(problem, 0.1, gain_max) >= gain_max - 1e-12 * energy ? 1 : 0;
    sliding += leans[0] != leans[1] ? 1 : 0;
    const Vector2 pushed = momentum_of(problem) - before;
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_GE(pushed[axis], -rounding);
      if (!leans[axis]) {
        EXPECT_LE(pushed[axis], rounding);
      }
    }
    EXPECT_LE(problem.energy(), (energy + gain_max) * (1.0 + 1e-12));
  }
  EXPECT_GT(sliding, 100);
  EXPECT_GT(paying, 50);
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
