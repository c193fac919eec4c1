// The nearest velocities that part contacts from inside, against the dual method.
#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "game/physics/contact/active_set.h"
#include "game/physics/contact/interior_point.h"
#include "tests/physics/contact/contact_problems.h"

namespace rink::physics::test {
namespace {

constexpr double accuracy = 1e-12;

TEST(InteriorPoint, FindsTheVelocitiesOfTheDualMethod) {
  std::mt19937_64 random(241);
  ActiveSet set;
  InteriorPoint interior;
  int compared = 0;
  for (int trial = 0; trial < 300; ++trial) {
    SCOPED_TRACE(trial);
    ContactProblem problem = random_problem(random, 1e3, 0.5);
    for (Touch& touch : problem.touches) touch.wanted = uniform(random, -0.5, 0.5);
    std::vector<std::uint32_t> all(problem.touches.size());
    std::iota(all.begin(), all.end(), 0u);
    ContactProblem same = problem;
    if (!set.solve(same, all)) continue;
    ++compared;
    ASSERT_TRUE(interior.solve(problem, accuracy));
    for (std::size_t place = 0; place < problem.body_count(); ++place)
      EXPECT_LT((interior.velocities()[place] - set.velocities()[place]).norm(), 1e-3);
    for (const Touch& touch : problem.touches) {
      EXPECT_GE(touch.impulse, 0.0);
      EXPECT_GE(parting(touch, interior.velocities()), touch.wanted - 1e-7);
    }
  }
  EXPECT_GT(compared, 200);
}

/// A row of 300 between two walls, pressed at one end: all forces equal the thrust.
TEST(InteriorPoint, PassesAThrustOnThroughARow) {
  ContactProblem problem = row_of(std::vector<double>(300, 0.02), 20.0);
  add_touch(problem, 299, fixed_place, std::numbers::pi);
  InteriorPoint interior;
  ASSERT_TRUE(interior.solve(problem, accuracy));
  for (const Touch& touch : problem.touches) EXPECT_NEAR(touch.impulse, 0.4, 1e-3);
  for (const Vector2& velocity : interior.velocities()) EXPECT_LT(velocity.norm(), 1e-2);
}

}  // namespace
}  // namespace rink::physics::test
