// The forces of clusters that move on in contact: that they only push, and only where a contact
// would close, that they make no momentum, and that gaps are as wanted when they end.
#include "game/physics/contact/glide_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "game/physics/contact/separation_solver.h"
#include "game/physics/flight/motion.h"
#include "tests/physics/contact/contact_problems.h"

namespace rink::physics::test {
namespace {

std::vector<Drive> random_drives(std::mt19937_64& random, std::size_t count) {
  std::vector<Drive> drives;
  for (std::size_t i = 0; i < count; ++i)
    drives.push_back(
        {{uniform(random, -6.0, 6.0), uniform(random, -6.0, 6.0)}, uniform(random, 0.0, 2.0)});
  return drives;
}

/// f >= 0, a >= b and f (a - b) = 0, to 1e-12 of the largest.
void expect_complementary(const GlideSolver& solver) {
  double largest_force = 0.0, largest = 0.0;
  for (const Touch& force : solver.forces()) {
    largest_force = std::max(largest_force, force.impulse);
    largest = std::max(
        {largest, std::abs(force.wanted), std::abs(parting(force, solver.accelerations()))});
  }
  for (const Touch& force : solver.forces()) {
    const double beyond = parting(force, solver.accelerations()) - force.wanted;
    EXPECT_GE(force.impulse, 0.0);
    EXPECT_GE(beyond, -1e-12 * largest);
    EXPECT_LE(std::min(force.impulse / (largest_force + 1e-300), beyond / largest), 1e-12);
  }
}

/// m (A - thrust) is the sum of the forces on the body.
void expect_balanced(const ContactProblem& problem, const std::vector<Drive>& drives,
                     const GlideSolver& solver) {
  std::vector<Vector2> lacking(problem.body_count());
  double largest = 1.0;
  for (std::size_t place = 0; place < lacking.size(); ++place)
    lacking[place] = problem.masses[place] * (solver.accelerations()[place] - drives[place].thrust);
  for (const Touch& force : solver.forces()) {
    lacking[force.body] -= force.impulse * force.normal;
    if (force.other != fixed_place) lacking[force.other] += force.impulse * force.normal;
    largest = std::max(largest, force.impulse);
  }
  for (const Vector2& rest : lacking) EXPECT_NEAR(rest.norm(), 0.0, 1e-12 * largest);
}

TEST(GlideSolver, PushesOnlyWhereContactsWouldCloseAndMakesNoMomentum) {
  constexpr std::uint64_t seed = 7;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  SeparationSolver separation;
  InteriorPoint interior;
  GlideSolver solver(interior);
  int solved = 0;
  for (int trial = 0; trial < 300; ++trial) {
    ContactProblem problem = random_problem(random, trial % 2 == 0 ? 10.0 : 1e4, 1.0);
    for (Touch& touch : problem.touches) touch.reach = trial % 3 == 0 ? 0.0 : 0.08;
    for (Vector2& velocity : problem.velocities) velocity *= 0.1;
    separation.part(problem, 1e-4, 1e-3);
    const std::vector<Drive> drives = random_drives(random, problem.body_count());
    if (!solver.solve(problem, drives, {1e-3, 1e-5})) continue;
    ++solved;
    expect_complementary(solver);
    expect_balanced(problem, drives, solver);
  }
  EXPECT_GT(solved, 200);
}

/// A bat of 3 kg at 6 m/s^2 presses a puck straight onto a post: 18 N on both sides, and nobody
/// moves.
TEST(GlideSolver, BearsWhatIsInEquilibrium) {
  ContactProblem problem;
  add_body(problem, 0.5, {0.0, 0.0});
  add_body(problem, 3.0, {0.0, 0.0});
  problem.touches.push_back({0, fixed_place, {1.0, 0.0}, 0.5});
  problem.touches.push_back({0, 1, {-1.0, 0.0}, 0.5});
  problem.touches[0].reach = 0.14;
  InteriorPoint interior;
  GlideSolver solver(interior);
  const std::vector<Drive> drives{{{0.0, 0.0}, 0.0}, {{-6.0, 0.0}, 0.0}};
  ASSERT_TRUE(solver.solve(problem, drives, {8e-3, 0.0}));
  for (const Touch& force : solver.forces()) EXPECT_NEAR(force.impulse, 18.0, 1e-11);
  for (const Vector2& acceleration : solver.accelerations()) EXPECT_LT(acceleration.norm(), 1e-11);
  EXPECT_LT(solver.work_max(), 1e-12);
}

/// Round a post at speed v, pressed towards it: at the end of the glide the gap is what the opening
/// has made of it, to the fourth order of the duration, and the chord half-way is inside by no more
/// than the opening allows.
TEST(GlideSolver, KeepsABodyAtItsReachFromWhatItGoesRound) {
  const double reach = 0.14;
  for (const double speed : {0.05, 0.5})
    for (const double drag : {0.0, 1.0})
      for (const double duration : {1e-3, 4e-3}) {
        SCOPED_TRACE(testing::Message() << speed << " m/s, " << drag << " 1/s, " << duration);
        ContactProblem problem;
        const double opening = (3.0 * speed / reach + drag) * 8.5 * duration * duration / 6.0;
        add_body(problem, 0.5, {opening, speed});
        problem.touches.push_back({0, fixed_place, {1.0, 0.0}, 0.5});
        problem.touches[0].reach = reach;
        InteriorPoint interior;
        GlideSolver solver(interior);
        ASSERT_TRUE(
            solver.solve(problem, std::vector<Drive>{{{-6.0, 6.0}, drag}}, {duration, opening}));
        Motion motion;
        motion.position = {reach, 0.0}, motion.velocity = problem.velocities[0],
        motion.acceleration = solver.accelerations()[0], motion.drag = Vector2::Constant(drag);
        EXPECT_NEAR(motion.at(duration).position.norm() - reach, opening * duration,
                    0.01 * opening * duration + 1e-15);
        for (int k = 1; k < 100; ++k)
          EXPECT_GE(motion.at(0.01 * k * duration).position.norm(), reach - 1e-16) << k;
      }
}

}  // namespace
}  // namespace rink::physics::test
