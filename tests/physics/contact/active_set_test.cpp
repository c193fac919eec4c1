// The nearest velocities that part contacts, against all sets of contacts that could push.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numeric>
#include <optional>

#include "game/physics/contact/active_set.h"
#include "tests/physics/contact/contact_problems.h"

namespace rink::physics::test {
namespace {

std::vector<std::uint32_t> all_touches(const ContactProblem& problem) {
  std::vector<std::uint32_t> all(problem.touches.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

/// What an impulse of 1 at each of `touches` does to the velocities, a column each.
Eigen::MatrixXd effects_of(const ContactProblem& problem,
                           const std::vector<std::uint32_t>& touches) {
  Eigen::MatrixXd effects = Eigen::MatrixXd::Zero(2 * static_cast<int>(problem.body_count()),
                                                  static_cast<int>(touches.size()));
  for (std::size_t k = 0; k < touches.size(); ++k) {
    const Touch& touch = problem.touches[touches[k]];
    const auto column = static_cast<int>(k);
    effects.block<2, 1>(2 * static_cast<int>(touch.body), column) +=
        problem.inverse_masses[touch.body] * touch.normal;
    if (touch.other != fixed_place)
      effects.block<2, 1>(2 * static_cast<int>(touch.other), column) -=
          problem.inverse_masses[touch.other] * touch.normal;
  }
  return effects;
}

std::vector<Vector2> moved(const ContactProblem& problem, const Eigen::VectorXd& change) {
  std::vector<Vector2> velocities = problem.velocities;
  for (std::size_t place = 0; place < velocities.size(); ++place)
    velocities[place] += change.segment<2>(2 * static_cast<int>(place));
  return velocities;
}

/// The velocities if exactly `touches` push, each until it parts as wanted; nothing if one of them
/// would have to pull, or another contact lacks something (Karush, Kuhn and Tucker's conditions).
std::optional<std::vector<Vector2>> pushed_by(const ContactProblem& problem,
                                              const std::vector<std::uint32_t>& touches) {
  const Eigen::MatrixXd effects = effects_of(problem, touches);
  const auto count = static_cast<int>(touches.size());
  Eigen::MatrixXd yielding(count, count);
  Eigen::VectorXd lacking(count);
  for (int row = 0; row < count; ++row) {
    const Touch& touch = problem.touches[touches[static_cast<std::size_t>(row)]];
    lacking[row] = touch.wanted - parting(touch, problem.velocities);
    for (int column = 0; column < count; ++column) {
      ContactProblem still = problem;
      for (Vector2& velocity : still.velocities) velocity.setZero();
      yielding(row, column) = parting(touch, moved(still, effects.col(column)));
    }
  }
  Eigen::VectorXd impulses;
  if (count > 0) {
    impulses = yielding.fullPivLu().solve(lacking);
    if (!((yielding * impulses - lacking).cwiseAbs().maxCoeff() < 1e-9)) return std::nullopt;
    if (impulses.minCoeff() < -1e-9) return std::nullopt;
  }
  std::vector<Vector2> velocities = moved(problem, effects * impulses);
  for (const Touch& touch : problem.touches)
    if (parting(touch, velocities) < touch.wanted - 1e-9) return std::nullopt;
  return velocities;
}

/// Of all sets of contacts, by trying each.
std::optional<std::vector<Vector2>> nearest_by_trial(const ContactProblem& problem) {
  for (std::uint32_t set = 0; set < 1u << problem.touches.size(); ++set) {
    std::vector<std::uint32_t> touches;
    for (std::uint32_t i = 0; i < problem.touches.size(); ++i)
      if ((set >> i & 1u) != 0) touches.push_back(i);
    if (auto velocities = pushed_by(problem, touches)) return velocities;
  }
  return std::nullopt;
}

TEST(ActiveSet, FindsWhatTryingAllSetsFinds) {
  constexpr std::uint64_t seed = 1;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  ActiveSet set;
  int solved = 0, unsolvable = 0;
  for (int trial = 0; trial < 400; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    ContactProblem problem = random_problem(random, 100.0, 1.0);
    const double separation = trial % 2 == 0 ? 0.0 : 0.5;
    for (Touch& touch : problem.touches) touch.wanted = separation;
    const auto expected = nearest_by_trial(problem);
    const bool is_solved = set.solve(problem, all_touches(problem));
    ASSERT_EQ(is_solved, expected.has_value());
    is_solved ? ++solved : ++unsolvable;
    if (!is_solved) continue;
    for (std::size_t place = 0; place < problem.body_count(); ++place)
      EXPECT_LT((set.velocities()[place] - (*expected)[place]).norm(), 1e-7);
  }
  EXPECT_GT(solved, 100);
  EXPECT_GT(unsolvable, 3);
}

/// Only those that close are asked for; what the others do is nobody's concern.
TEST(ActiveSet, LeavesOutWhatItIsNotAskedFor) {
  ContactProblem problem = row_of({1.0, 1.0, 1.0}, 1.0);
  ActiveSet set;
  ASSERT_TRUE(set.solve(problem, std::vector<std::uint32_t>{0}));
  EXPECT_NEAR(set.velocities()[0].x(), 0.5, 1e-15);
  EXPECT_NEAR(set.velocities()[1].x(), 0.5, 1e-15);
  EXPECT_EQ(set.velocities()[2].x(), 0.0);
  EXPECT_EQ(set.pushing().size(), 1u);
}

/// A body between two walls cannot part from both. The second is blocked, and the first opposes it.
TEST(ActiveSet, NamesWhoIsBlockedAndByWhom) {
  ContactProblem problem;
  add_body(problem, 1.0, {0.0, 0.0});
  problem.touches.push_back({0, fixed_place, {1.0, 0.0}, 1.0, 1.0});
  problem.touches.push_back({0, fixed_place, {-1.0, 0.0}, 1.0, 1.0});
  ActiveSet set;
  ASSERT_FALSE(set.solve(problem, all_touches(problem)));
  EXPECT_EQ(set.blocked(), 1u);
  std::vector<std::uint32_t> opposed;
  set.for_each_opposed([&](std::uint32_t touch) { opposed.push_back(touch); });
  EXPECT_EQ(opposed, std::vector<std::uint32_t>{0});
}

/// The part along what pushes changes its sign, whatever the masses: energy is kept to rounding.
TEST(ActiveSet, ReflectsWithoutLossBetweenMassesATrillionApart) {
  constexpr std::uint64_t seed = 2;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  ActiveSet set;
  int reflected = 0;
  for (int trial = 0; trial < 400; ++trial) {
    ContactProblem problem = random_problem(random, 1e12, 1.0);
    if (!set.solve(problem, all_touches(problem))) continue;
    const double energy = problem.energy();
    problem.velocities = set.reflect(problem, 1.0, false);
    EXPECT_NEAR(problem.energy(), energy, 1e-13 * energy);
    ++reflected;
  }
  EXPECT_GT(reflected, 100);
}

}  // namespace
}  // namespace rink::physics::test
