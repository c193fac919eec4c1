// The velocities after an impact of many bodies at one instant.
#pragma once

#include <cstdint>
#include <vector>

#include "game/physics/contact/active_set.h"
#include "game/physics/contact/contact_problem.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Solves joint impacts (docs/physics.md, "Simultaneous impacts"). Nobody's number decides who is
/// hit first. Keeps its memory from one problem to the next.
class ImpactSolver {
 public:
  /// The velocities after the impact; marks the touches that pushed. Where impacts among the bodies
  /// seem to have no end, `all_yield_first` lets all that touch yield as one before anything else.
  /// False if no solution was found, or one that gains energy; velocities then mean nothing.
  bool solve(ContactProblem& problem, bool all_yield_first);

 private:
  bool find_velocities(ContactProblem& problem, bool all_yield_first);
  bool propagate(ContactProblem& problem);
  bool propagate_once(ContactProblem& problem, bool& has_ended);
  bool yield_as_one(ContactProblem& problem, Real restitution_max);
  bool come_to_rest(ContactProblem& problem);
  void part_what_rounding_closes(ContactProblem& problem);
  void reflect(ContactProblem& problem, Real restitution_max, bool as_wanted);

  ActiveSet set_;
  std::vector<std::uint32_t> closing_;  // touches of the step at hand
};

}  // namespace rink::physics::inline RINK_PRECISION
