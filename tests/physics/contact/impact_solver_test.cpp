// Impacts of many bodies at once, from plain values: what Newton's cradle does, and that energy
// stays within Moreau's bound whatever the masses.
#include <gtest/gtest.h>

#include "game/physics/contact/impact_solver.h"
#include "tests/physics/contact/contact_problems.h"

namespace rink::physics::test {
namespace {

TEST(ImpactSolver, PassesAnImpulseThroughACradle) {
  ImpactSolver solver;
  for (std::size_t count = 2; count <= 20; ++count) {
    SCOPED_TRACE(testing::Message() << count << " bodies");
    ContactProblem problem = row_of(std::vector<double>(count, 2.0), 3.0);
    ASSERT_TRUE(solver.solve(problem, false));
    for (std::size_t place = 0; place + 1 < count; ++place)
      EXPECT_NEAR(problem.velocities[place].x(), 0.0, 1e-12);
    EXPECT_NEAR(problem.velocities[count - 1].x(), 3.0, 1e-12);
    for (const Touch& touch : problem.touches) EXPECT_TRUE(touch.has_pushed);
  }
}

/// Of two, by Newton's law: v' = (m - e m')/(m + m') v and (1 + e) m/(m + m') v.
TEST(ImpactSolver, FollowsNewtonsLawWhereTwoMeet) {
  ImpactSolver solver;
  for (const double mass : {1e-12, 0.25, 1.0, 3.0, 1e12})
    for (const double restitution : {0.0, 0.5, 1.0}) {
      SCOPED_TRACE(testing::Message() << "mass " << mass << ", restitution " << restitution);
      ContactProblem problem = row_of({mass, 1.0}, 2.0, restitution);
      ASSERT_TRUE(solver.solve(problem, false));
      EXPECT_NEAR(problem.velocities[0].x(), 2.0 * (mass - restitution) / (mass + 1.0), 1e-11);
      EXPECT_NEAR(problem.velocities[1].x(), 2.0 * (1.0 + restitution) * mass / (mass + 1.0),
                  1e-11);
    }
}

/// All that touch yield as one: the law is symmetric, and the two that are hit leave alike.
TEST(ImpactSolver, LetsAllYieldAsOneAtFirstIfAsked) {
  ContactProblem problem;
  add_body(problem, 1.0, {1.0, 0.0});
  for (const double side : {-1.0, 1.0}) {
    add_body(problem, 1.0, {0.0, 0.0});
    add_touch(problem, 0, static_cast<std::uint32_t>(problem.body_count() - 1),
              3.14159265358979 - side * 0.5235987755982988);
  }
  ImpactSolver solver;
  ASSERT_TRUE(solver.solve(problem, true));
  EXPECT_NEAR(problem.velocities[1].x(), problem.velocities[2].x(), 1e-14);
  EXPECT_NEAR(problem.velocities[1].y(), -problem.velocities[2].y(), 1e-14);
  EXPECT_NEAR(problem.energy(), 0.5, 1e-14);
}

/// Energy never grows and is kept by what is lossless, momentum is kept where nothing is fixed, and
/// nothing closes any more.
TEST(ImpactSolver, KeepsMoreausBoundWhateverTheMasses) {
  constexpr std::uint64_t seed = 3;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  ImpactSolver solver;
  int solved = 0;
  for (int trial = 0; trial < 600; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const double restitution = trial % 3 * 0.5, mass_ratio = trial % 2 == 0 ? 10.0 : 1e12;
    ContactProblem problem = random_problem(random, mass_ratio, restitution);
    const double energy = problem.energy();
    const bool is_free =
        std::none_of(problem.touches.begin(), problem.touches.end(),
                     [](const Touch& touch) { return touch.other == fixed_place; });
    const Vector2 momentum = momentum_of(problem);
    if (!solver.solve(problem, trial % 4 == 0)) continue;
    ++solved;
    EXPECT_LE(problem.energy(), energy * (1.0 + 1e-12));
    if (restitution == 1.0) {
      EXPECT_NEAR(problem.energy(), energy, 1e-9 * energy);
    }
    EXPECT_GE(slowest_parting(problem), -4e-13 * problem.speed());
    if (!is_free) continue;
    const double scale = *std::max_element(problem.masses.begin(), problem.masses.end());
    EXPECT_LT((momentum_of(problem) - momentum).norm(), 1e-9 * scale);
  }
  EXPECT_GT(solved, 300);
}

}  // namespace
}  // namespace rink::physics::test
