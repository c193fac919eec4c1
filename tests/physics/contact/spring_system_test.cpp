// Systems of springs between bodies, against a dense matrix.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "game/physics/contact/spring_system.h"
#include "tests/physics/contact/contact_problems.h"

namespace rink::physics::test {
namespace {

Eigen::MatrixXd matrix_of(const ContactProblem& problem, const std::vector<double>& stiffnesses) {
  const auto size = static_cast<Eigen::Index>(2 * problem.body_count());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    matrix(i, i) = problem.masses[static_cast<std::size_t>(i / 2)];
  for (std::size_t i = 0; i < stiffnesses.size(); ++i) {
    const Touch& touch = problem.touches[i];
    Eigen::VectorXd pull = Eigen::VectorXd::Zero(size);
    pull.segment<2>(2 * touch.body) = touch.normal;
    if (touch.other != fixed_place) pull.segment<2>(2 * touch.other) = -touch.normal;
    matrix += stiffnesses[i] * pull * pull.transpose();
  }
  return matrix;
}

void expect_as_dense(SpringSystem& springs, const ContactProblem& problem,
                     std::mt19937_64& random) {
  std::vector<double> stiffnesses;
  springs.lay_out(problem);
  for (std::size_t i = 0; i < problem.touches.size(); ++i) {
    stiffnesses.push_back(std::pow(10.0, uniform(random, -3.0, 3.0)));
    springs.add_spring(problem, i, stiffnesses.back());
  }
  springs.factorise();
  std::vector<Vector2> forces(problem.body_count());
  Eigen::VectorXd dense(2 * static_cast<Eigen::Index>(forces.size()));
  for (std::size_t i = 0; i < forces.size(); ++i) {
    forces[i] = {uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)};
    dense.segment<2>(2 * static_cast<Eigen::Index>(i)) = forces[i];
  }
  dense = matrix_of(problem, stiffnesses).ldlt().solve(dense).eval();
  springs.solve(forces);
  for (std::size_t i = 0; i < forces.size(); ++i)
    EXPECT_LT((forces[i] - dense.segment<2>(2 * static_cast<Eigen::Index>(i))).norm(),
              1e-8 * (1.0 + dense.norm()))
        << i;
}

/// Twice each: the second time with the order of the first.
TEST(SpringSystem, GivesTheMotionOfADenseMatrix) {
  std::mt19937_64 random(2401);
  SpringSystem springs;
  for (int trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE(trial);
    const ContactProblem problem = random_problem(random, 1e2, 0.5);
    expect_as_dense(springs, problem, random);
    expect_as_dense(springs, problem, random);
  }
}

/// Bodies joined twice, and some joined to nobody.
TEST(SpringSystem, BearsSeveralSpringsBetweenTwoAndBodiesAlone) {
  std::mt19937_64 random(2402);
  ContactProblem problem = row_of(std::vector<double>(5, 0.5), 0.0);
  problem.touches.clear();
  for (const double angle : {0.0, 1.0, 2.0}) add_touch(problem, 3, 1, angle);
  add_touch(problem, 1, fixed_place, 0.5);
  SpringSystem springs;
  expect_as_dense(springs, problem, random);
}

}  // namespace
}  // namespace rink::physics::test
