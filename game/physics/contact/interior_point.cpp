// Newton's steps towards the centre of what is left, each with one factorisation.
#include "game/physics/contact/interior_point.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>

namespace rink::physics::inline RINK_PRECISION {

namespace {

constexpr int steps_max = 60;
constexpr Real short_of_edge = 0.99;
constexpr Real least_accuracy = 1e-9;  // of what rounding disturbs

/// Calls `visit(place, sign)` for the one or two bodies of a touch.
void for_each_side(const Touch& touch, auto&& visit) {
  visit(touch.body, Real(1.0));
  if (touch.other != fixed_place) visit(touch.other, Real(-1.0));
}

}  // namespace

bool InteriorPoint::solve(ContactProblem& problem, Real accuracy) {
  problem.check();
  assert(accuracy > 0.0 && problem.body_count() > 0);
  springs_.lay_out(problem);
  start(problem);
  for (int step = 0; step < steps_max; ++step) {
    find_residuals(problem);
    if (is_solved(accuracy)) {
      for (std::size_t i = 0; i < impulses_.size(); ++i) problem.touches[i].impulse = impulses_[i];
      return true;
    }
    stiffen(problem);
    find_direction(problem, 0.0, false);
    const Real share = mean_after(longest_step()) / mean_;
    find_direction(problem, share * share * share * mean_, true);
    go(problem, std::min<Real>(1.0, short_of_edge * longest_step()));
  }
  return false;
}

/// Far from all edges.
void InteriorPoint::start(ContactProblem& problem) {
  const std::size_t count = problem.touches.size();
  velocities_ = problem.velocities;
  speed_ = problem.speed(), push_ = 0.0;
  for (const Touch& touch : problem.touches) speed_ = std::max(speed_, std::abs(touch.wanted));
  speed_ = std::max(speed_, std::numeric_limits<Real>::min());
  for (std::size_t place = 0; place < problem.body_count(); ++place)
    push_ = std::max(push_, problem.masses[place] * problem.velocities[place].norm());
  push_ = std::max(push_, speed_ * *std::min_element(problem.masses.begin(), problem.masses.end()));
  impulses_.assign(count, push_), slacks_.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    slacks_[i] =
        std::max(speed_, parting(problem.touches[i], velocities_) - problem.touches[i].wanted);
  lacking_.resize(count), slack_changes_.resize(count), impulse_changes_.resize(count);
}

void InteriorPoint::find_residuals(const ContactProblem& problem) {
  const std::size_t count = problem.touches.size();
  residuals_.resize(problem.body_count());
  for (std::size_t place = 0; place < residuals_.size(); ++place)
    residuals_[place] = problem.masses[place] * (velocities_[place] - problem.velocities[place]);
  mean_ = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Touch& touch = problem.touches[i];
    lacking_[i] = slacks_[i] - (parting(touch, velocities_) - touch.wanted);
    mean_ += impulses_[i] * slacks_[i];
    for_each_side(touch, [&](std::uint32_t place, Real sign) {
      residuals_[place] -= sign * impulses_[i] * touch.normal;
    });
  }
  mean_ /= static_cast<Real>(std::max<std::size_t>(1, count));
}

bool InteriorPoint::is_solved(Real accuracy) const {
  if (mean_ > accuracy * speed_ * push_) return false;
  accuracy = std::max(accuracy, least_accuracy);
  return std::all_of(lacking_.begin(), lacking_.end(),
                     [&](Real lacking) { return std::abs(lacking) <= accuracy * speed_; }) &&
         std::all_of(residuals_.begin(), residuals_.end(),
                     [&](const RealVector& r) { return r.norm() <= accuracy * push_; });
}

/// Each contact is a spring: the harder it pushes and the less it is open, the stiffer.
void InteriorPoint::stiffen(const ContactProblem& problem) {
  springs_.clear(problem);
  for (std::size_t i = 0; i < impulses_.size(); ++i)
    springs_.add_spring(problem, i, impulses_[i] / slacks_[i]);
  springs_.factorise();
}

/// Towards impulse times slack = `target` everywhere; `corrects` what the changes at hand, each
/// times the other, would add to that.
void InteriorPoint::find_direction(const ContactProblem& problem, Real target, bool corrects) {
  changes_.resize(residuals_.size());
  std::transform(residuals_.begin(), residuals_.end(), changes_.begin(), std::negate<>());
  for (std::size_t i = 0; i < impulses_.size(); ++i) {
    const Touch& touch = problem.touches[i];
    Real& excess = impulse_changes_[i];
    excess = impulses_[i] * slacks_[i] - target +
             (corrects ? impulse_changes_[i] * slack_changes_[i] : Real(0.0));
    const RealVector push = ((impulses_[i] * lacking_[i] - excess) / slacks_[i]) * touch.normal;
    for_each_side(touch, [&](std::uint32_t body, Real sign) { changes_[body] += sign * push; });
  }
  springs_.solve(changes_);
  for (std::size_t i = 0; i < impulses_.size(); ++i) {
    slack_changes_[i] = parting(problem.touches[i], changes_) - lacking_[i];
    impulse_changes_[i] = -(impulse_changes_[i] + impulses_[i] * slack_changes_[i]) / slacks_[i];
  }
}

/// Up to where the first impulse or slack would vanish, at most 1.
Real InteriorPoint::longest_step() const {
  Real step = 1.0;
  for (std::size_t i = 0; i < impulses_.size(); ++i) {
    if (impulse_changes_[i] < 0.0) step = std::min(step, -impulses_[i] / impulse_changes_[i]);
    if (slack_changes_[i] < 0.0) step = std::min(step, -slacks_[i] / slack_changes_[i]);
  }
  return step;
}

Real InteriorPoint::mean_after(Real step) const {
  Real sum = 0.0;
  for (std::size_t i = 0; i < impulses_.size(); ++i)
    sum += (impulses_[i] + step * impulse_changes_[i]) * (slacks_[i] + step * slack_changes_[i]);
  return sum / static_cast<Real>(std::max<std::size_t>(1, impulses_.size()));
}

void InteriorPoint::go(ContactProblem& problem, Real step) {
  for (std::size_t place = 0; place < problem.body_count(); ++place)
    velocities_[place] += step * changes_[place];
  for (std::size_t i = 0; i < impulses_.size(); ++i)
    impulses_[i] += step * impulse_changes_[i], slacks_[i] += step * slack_changes_[i];
}

}  // namespace rink::physics::inline RINK_PRECISION
