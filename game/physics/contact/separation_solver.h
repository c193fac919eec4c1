// The velocities that part a pressed cluster of bodies, or show that it can bear its thrust.
#pragma once

#include <cstdint>
#include <vector>

#include "game/physics/contact/active_set.h"
#include "game/physics/contact/contact_problem.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Parts all contacts of a problem at once, at the least change of velocities (docs/physics.md,
/// "Degenerate contact"). Keeps its memory from one problem to the next.
class SeparationSolver {
 public:
  /// Parts the cluster at `separation` [m/s]. Energy may grow by `gain_max` [J]; what it takes
  /// beyond that, the bodies pay from their motion against each other and towards what is fixed,
  /// which slows the parting in the same measure. The momentum changes by what the fixed contacts
  /// push, and nothing pulls. Answers by how much energy has grown; below 0 where it shrank.
  Real part(ContactProblem& problem, Real separation, Real gain_max);

  /// Reads the velocities as the thrusts of the bodies [m/s^2]: what contacts, and friction of up
  /// to `friction` [m/s^2] if that is above 0, leave of them. Answers whether that is nowhere more
  /// than `remaining_max`.
  bool bears(ContactProblem& problem, Real friction, Real remaining_max);

 private:
  void separate(ContactProblem& problem, Real separation);
  bool give_way(ContactProblem& problem) const;
  void hold_jammed(ContactProblem& problem);
  void sweep(ContactProblem& problem, Real separation, Real friction);
  Real push_apart(ContactProblem& problem, Real separation);
  Real resist(ContactProblem& problem, Real friction);

  ActiveSet set_;
  std::vector<std::uint32_t> all_;    // touches
  std::vector<RealVector> friction_;  // impulses per mass
};

}  // namespace rink::physics::inline RINK_PRECISION
