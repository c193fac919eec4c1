// Rounds of impacts, and the law by which all that touch yield as one.
#include "game/physics/contact/impact_solver.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace rink::physics::inline RINK_PRECISION {

namespace {

constexpr std::size_t rounds_min =
    32;  // before all yield as one; an impulse through a chain needs one round per link,
constexpr std::size_t rounds_max = 128;  // so there are more where more touch
constexpr int cycles_max = 4;            // of rounds and yielding

}  // namespace

bool ImpactSolver::solve(ContactProblem& problem, bool all_yield_first) {
  problem.check();
  const Real energy = problem.energy();
  return find_velocities(problem, all_yield_first) &&
         problem.energy() <= energy * (1.0 + 1e-12 * fineness);
}

bool ImpactSolver::find_velocities(ContactProblem& problem, bool all_yield_first) {
  if (all_yield_first && !yield_as_one(problem, 1.0)) return false;
  if (!propagate(problem) && !come_to_rest(problem)) return false;
  part_what_rounding_closes(problem);
  return true;
}

/// Rounds of impacts without time between them. Where they do not end (a light ball between heavy
/// ones, collapse), all that touch yield as one now and then. Answers whether that comes to an end.
bool ImpactSolver::propagate(ContactProblem& problem) {
  const std::size_t rounds = std::min(rounds_min + 2 * problem.touches.size(), rounds_max);
  for (int cycle = 0; cycle < cycles_max; ++cycle) {
    for (std::size_t round = 0; round < rounds; ++round) {
      bool has_ended = false;
      if (!propagate_once(problem, has_ended)) return false;
      if (has_ended) return true;
    }
    if (!yield_as_one(problem, 1.0)) return false;
  }
  return false;
}

/// All contacts that close are one problem, and those that do not stay out (Smith et al. 2012).
bool ImpactSolver::propagate_once(ContactProblem& problem, bool& has_ended) {
  const Real speed = problem.speed();
  closing_.clear();
  for (std::uint32_t i = 0; i < problem.touches.size(); ++i) {
    Touch& touch = problem.touches[i];
    const Real approach = -parting(touch, problem.velocities);
    touch.wanted = std::max(touch.restitution * approach, separation_min * speed);
    if (approach > rest_of_closing * speed) closing_.push_back(i);
  }
  has_ended = closing_.empty();
  if (has_ended) return true;
  if (!set_.solve(problem, closing_)) return false;
  reflect(problem, 1.0, true);
  return true;
}

/// Moreau's law of impact: of the velocities v = T + N, where T is the nearest that close no
/// contact, becomes T - e N. T and N are at right angles in the metric of the masses, so that
/// energy is kept for e = 1 and never grows. e is the least restitution of those that push, at most
/// `restitution_max`.
bool ImpactSolver::yield_as_one(ContactProblem& problem, Real restitution_max) {
  assert(restitution_max >= 0.0 && restitution_max <= 1.0);
  closing_.resize(problem.touches.size());
  std::iota(closing_.begin(), closing_.end(), 0u);
  for (Touch& touch : problem.touches) touch.wanted = 0.0;
  if (!set_.solve(problem, closing_)) return false;
  reflect(problem, restitution_max, false);
  return true;
}

/// The end of what loses energy without end. Not for what loses none.
bool ImpactSolver::come_to_rest(ContactProblem& problem) {
  const bool is_lossless = std::all_of(problem.touches.begin(), problem.touches.end(),
                                       [](const Touch& touch) { return touch.restitution == 1.0; });
  return !is_lossless && yield_as_one(problem, 0.0);
}

/// What is left of closing would be the next event.
void ImpactSolver::part_what_rounding_closes(ContactProblem& problem) {
  for (std::size_t round = 0; round < rounds_min; ++round) {
    const Real speed = problem.speed();
    closing_.clear();
    for (std::uint32_t i = 0; i < problem.touches.size(); ++i)
      if (parting(problem.touches[i], problem.velocities) < 0.0)
        problem.touches[i].wanted = separation_min * speed, closing_.push_back(i);
    if (closing_.empty() || !set_.solve(problem, closing_)) return;
    problem.velocities = set_.velocities();
  }
}

/// Of those that push, the one that gives back least decides for all.
void ImpactSolver::reflect(ContactProblem& problem, Real restitution_max, bool as_wanted) {
  Real least = restitution_max;
  for (const std::uint32_t i : set_.pushing()) {
    least = std::min(least, problem.touches[i].restitution);
    assert(!(problem.touches[i].impulse < 0.0));  // nothing pulls
    problem.touches[i].has_pushed = true;
  }
  problem.velocities = set_.reflect(problem, least, as_wanted);
}

}  // namespace rink::physics::inline RINK_PRECISION
