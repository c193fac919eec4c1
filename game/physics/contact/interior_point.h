// The nearest velocities that part contacts, for hundreds of bodies at once.
#pragma once

#include <vector>

#include "game/physics/contact/contact_problem.h"
#include "game/physics/contact/spring_system.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Finds who pushes from inside, all at once: the predictor-corrector method of Mehrotra (SIAM J.
/// Optimization 2, 1992), some 15 steps whatever the size. Each is a system of springs between the
/// bodies (spring_system.h). Unlike the dual method (active_set.h), which is as exact as rounding
/// but takes a step for each contact, it stops at `accuracy`. Keeps its memory from one problem to
/// the next.
class InteriorPoint {
 public:
  /// The nearest velocities to those of the problem, in the metric of the masses, that part all
  /// touches as fast as wanted: velocities(), within `accuracy` of the highest speed there is.
  /// Writes the impulses of the touches, nothing else. False if it finds none.
  bool solve(ContactProblem& problem, Real accuracy);
  const std::vector<RealVector>& velocities() const { return velocities_; }

 private:
  void start(ContactProblem& problem);
  void find_residuals(const ContactProblem& problem);
  bool is_solved(Real accuracy) const;
  void stiffen(const ContactProblem& problem);
  void find_direction(const ContactProblem& problem, Real target, bool corrects);
  Real longest_step() const;
  Real mean_after(Real step) const;
  void go(ContactProblem& problem, Real step);

  Real speed_ = 1.0, push_ = 1.0;  // scales [m/s], [kg m/s]
  Real mean_ = 0.0;                // of impulse times slack
  std::vector<RealVector> velocities_, changes_, residuals_;
  std::vector<Real> slacks_, lacking_, slack_changes_, impulses_, impulse_changes_;  // by touch
  SpringSystem springs_;
};

}  // namespace rink::physics::inline RINK_PRECISION
