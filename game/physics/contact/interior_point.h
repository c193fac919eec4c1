// The nearest velocities that part contacts, for hundreds of bodies at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "game/physics/contact/contact_problem.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Finds who pushes from inside, all at once: the predictor-corrector method of Mehrotra (SIAM J.
/// Optimization 2, 1992), some 15 steps whatever the size. Each is a system of springs between the
/// bodies, solved by Cholesky's method within the envelope of bodies in order of their distance
/// from an outermost one. Unlike the dual method (active_set.h), which is as exact as rounding but
/// takes a step for each contact, it stops at `accuracy`. Keeps its memory from one problem to the
/// next.
class InteriorPoint {
 public:
  /// The nearest velocities to those of the problem, in the metric of the masses, that part all
  /// touches as fast as wanted: velocities(), within `accuracy` of the highest speed there is.
  /// Writes the impulses of the touches, nothing else. False if it finds none.
  bool solve(ContactProblem& problem, Real accuracy);
  const std::vector<RealVector>& velocities() const { return velocities_; }

 private:
  using Square = std::array<Real, 4>;  // 2 x 2, by row

  void order(const ContactProblem& problem);
  std::uint32_t visit_from(std::uint32_t first, std::size_t body_count);
  void lay_out(const ContactProblem& problem);
  void start(ContactProblem& problem);
  void find_residuals(const ContactProblem& problem);
  bool is_solved(Real accuracy) const;
  void stiffen(const ContactProblem& problem);
  void factorise();
  void reduce(std::uint32_t row);
  void substitute();
  void find_direction(const ContactProblem& problem, Real target, bool corrects);
  Real longest_step() const;
  Real mean_after(Real step) const;
  void go(ContactProblem& problem, Real step);
  Square& at(std::uint32_t row, std::uint32_t column) {
    return squares_[begins_[row] + (column - firsts_[row])];
  }

  Real speed_ = 1.0, push_ = 1.0;  // scales [m/s], [kg m/s]
  Real mean_ = 0.0;                // of impulse times slack
  std::vector<RealVector> velocities_, changes_, residuals_;
  std::vector<Real> slacks_, lacking_, slack_changes_, impulses_, impulse_changes_;  // by touch
  // By place in the order, who is there; by body, its place; neighbours by body.
  std::vector<std::uint32_t> order_, places_, neighbour_begins_, neighbours_;
  std::vector<std::uint32_t> firsts_;  // by row of the envelope, its first column
  std::vector<std::size_t> begins_;    // and where that is
  std::vector<Square> squares_;
  std::vector<RealVector> right_;  // the right hand side, and the solution
};

}  // namespace rink::physics::inline RINK_PRECISION
