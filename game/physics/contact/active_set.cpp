// The dual method, one touch at a time.
#include "game/physics/contact/active_set.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace rink::physics::inline RINK_PRECISION {

namespace {

/// A contact of whose effect no more than this is left by those of others, relative to it, is
/// implied by them.
constexpr Real superfluous = 1e-12 * fineness;

}  // namespace

bool ActiveSet::solve(ContactProblem& problem, std::span<const std::uint32_t> closing) {
  assert(problem.velocities.size() == problem.body_count() &&
         problem.inverse_masses.size() == problem.body_count());
  std::vector<Touch>& touches = problem.touches;
  velocities_ = problem.velocities;
  pushing_.clear();
  blocked_ = fixed_place;
  for (const std::uint32_t i : closing) {
    assert(i < touches.size());
    touches[i].impulse = 0.0;
  }
  for (std::size_t steps_left = 20 * closing.size() + 20; steps_left > 0;) {
    Real most = 0.25 * rest_of_closing * problem.speed();
    std::uint32_t next = fixed_place;
    for (const std::uint32_t i : closing) {
      const Real lacking = touches[i].wanted - parting(touches[i], velocities_);
      if (lacking > most && std::find(pushing_.begin(), pushing_.end(), i) == pushing_.end())
        most = lacking, next = i;
    }
    if (next == fixed_place) return true;
    while (!push_until_blocked(problem, next))
      if (--steps_left == 0) return false;
    if (touches[next].impulse == 0.0) return blocked_ = next, false;
  }
  return false;
}

/// Lets the contact push harder until it parts as wanted, or until another one of those that push
/// need not push any more and is dropped. Whether the former was reached, or nothing can be (then
/// its impulse is 0).
bool ActiveSet::push_until_blocked(ContactProblem& problem, std::uint32_t next) {
  std::vector<Touch>& touches = problem.touches;
  Touch& touch = touches[next];
  const std::size_t count = pushing_.size();
  const Real own = orthogonalise(problem, touch), length = problem.product(direction_, direction_);
  find_shares();
  const bool is_implied = length <= superfluous * superfluous * own;
  constexpr Real endless = std::numeric_limits<Real>::infinity();
  Real step = is_implied ? endless : (touch.wanted - parting(touch, velocities_)) / length;
  std::size_t blocking = count;
  for (std::size_t k = 0; k < count; ++k)
    if (share_[k] > 0.0 && touches[pushing_[k]].impulse < step * share_[k])
      step = touches[pushing_[k]].impulse / share_[k], blocking = k;
  if (step == endless) return touch.impulse = 0.0, true;
  for (std::size_t k = 0; k < count; ++k)
    touches[pushing_[k]].impulse =
        std::max<Real>(0.0, touches[pushing_[k]].impulse - step * share_[k]);
  touch.impulse += step;
  if (!is_implied)
    for (std::size_t place = 0; place < velocities_.size(); ++place)
      velocities_[place] += step * direction_[place];
  if (blocking < count) return drop(problem, blocking), false;
  append(next, std::sqrt(length));
  return true;
}

/// The triangle of `columns_`, solved for `column_`.
void ActiveSet::find_shares() {
  const std::size_t count = pushing_.size();
  assert(column_.size() == count && columns_.size() >= count);
  share_.resize(count);
  for (std::size_t row = count; row-- > 0;) {
    Real sum = column_[row];
    for (std::size_t k = row + 1; k < count; ++k) sum -= columns_[k][row] * share_[k];
    share_[row] = sum / columns_[row][row];
  }
}

/// The effect of an impulse of 1, less what those that push already can do: into `direction_`, and
/// their shares into `column_`. Twice is enough (Kahan, in Parlett 1980). Answers the square of the
/// effect's length.
Real ActiveSet::orthogonalise(const ContactProblem& problem, const Touch& touch) {
  direction_.assign(problem.body_count(), RealVector(0.0, 0.0));
  direction_[touch.body] = problem.inverse_masses[touch.body] * touch.normal;
  if (touch.other != fixed_place)
    direction_[touch.other] = -problem.inverse_masses[touch.other] * touch.normal;
  const Real own = parting(touch, direction_);
  column_.assign(pushing_.size(), 0.0);
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t k = 0; k < pushing_.size(); ++k) {
      const std::vector<RealVector>& field = basis_[k];
      Real share = 0.0;
      for (const std::uint32_t place : supports_[k])
        share += problem.masses[place] * field[place].dot(direction_[place]);
      column_[k] += share;
      for (const std::uint32_t place : supports_[k]) direction_[place] -= share * field[place];
    }
  return own;
}

void ActiveSet::append(std::uint32_t touch, Real length) {
  const std::size_t count = pushing_.size();
  if (basis_.size() <= count)
    basis_.emplace_back(), supports_.emplace_back(), columns_.emplace_back();
  supports_[count].clear();
  for (std::uint32_t place = 0; place < direction_.size(); ++place) {
    if (direction_[place] == RealVector(0.0, 0.0)) continue;
    direction_[place] /= length;
    supports_[count].push_back(place);
  }
  basis_[count] = direction_;
  column_.push_back(length);
  assert(column_.size() == count + 1);  // the next side of the triangle
  columns_[count] = column_;
  pushing_.push_back(touch);
}

void ActiveSet::drop(ContactProblem& problem, std::size_t place) {
  assert(place < pushing_.size());
  problem.touches[pushing_[place]].impulse = 0.0;
  const std::vector<std::uint32_t> others(pushing_.begin() + static_cast<std::ptrdiff_t>(place) + 1,
                                          pushing_.end());
  pushing_.resize(place);
  for (const std::uint32_t other : others) {
    orthogonalise(problem, problem.touches[other]);
    append(other, std::sqrt(problem.product(direction_, direction_)));
  }
}

const std::vector<RealVector>& ActiveSet::reflect(const ContactProblem& problem, Real restitution,
                                                  bool as_wanted) {
  assert(restitution >= 0.0 && restitution <= 1.0);
  assert(problem.velocities.size() == velocities_.size());  // that it has solved
  velocities_ = problem.velocities;
  share_.assign(pushing_.size(), 0.0);
  for (std::size_t k = 0; k < pushing_.size(); ++k) {
    const Touch& touch = problem.touches[pushing_[k]];
    Real beyond =
        as_wanted ? touch.wanted + restitution * parting(touch, problem.velocities) : Real(0.0);
    for (std::size_t j = 0; j < k; ++j) beyond -= columns_[k][j] * share_[j];
    share_[k] = beyond / columns_[k][k];
    const Real change =
        share_[k] - (1.0 + restitution) * problem.product(basis_[k], problem.velocities);
    for (std::size_t place = 0; place < velocities_.size(); ++place)
      velocities_[place] += change * basis_[k][place];
  }
  return velocities_;
}

}  // namespace rink::physics::inline RINK_PRECISION
