// The nearest velocities that part contacts, by the dual method of quadratic programming.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/contact/contact_problem.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Finds who pushes: the dual method of Goldfarb and Idnani (Math. Programming 27, 1983). What
/// those that push can change is kept as a basis that is orthonormal in the metric of the masses,
/// which bears any ratio of masses. Keeps its memory from one problem to the next.
class ActiveSet {
 public:
  /// The nearest velocities to those of the problem, in the metric of the masses, that part all of
  /// the `closing` touches as fast as wanted: velocities() and pushing(). Writes the impulses of
  /// these touches, nothing else. False if it finds none; then blocked() tells where it ended.
  bool solve(ContactProblem& problem, std::span<const std::uint32_t> closing);

  const std::vector<RealVector>& velocities() const { return velocities_; }
  /// Touches with an impulse, in the order in which they began to push.
  std::span<const std::uint32_t> pushing() const { return pushing_; }
  /// The touch that cannot part as wanted beside those that push; `fixed_place` if it is none
  /// alone.
  std::uint32_t blocked() const { return blocked_; }
  /// The touches that hold back the blocked one from its other side: it needs less of them the less
  /// they want.
  template <class Visit>
  void for_each_opposed(Visit&& visit) const {
    for (std::size_t k = 0; k < share_.size() && k < pushing_.size(); ++k)
      if (share_[k] < 0.0) visit(pushing_[k]);
  }

  /// After solve(): the part of the problem's velocities along the basis turns into -`restitution`
  /// times itself, which keeps energy to rounding for 1 whatever the masses; then, if `as_wanted`,
  /// what is wanted beyond that is added.
  const std::vector<RealVector>& reflect(const ContactProblem& problem, Real restitution,
                                         bool as_wanted);

 private:
  bool push_until_blocked(ContactProblem& problem, std::uint32_t next);
  Real orthogonalise(const ContactProblem& problem, const Touch& touch);
  void find_shares();
  void append(std::uint32_t touch, Real length);
  void drop(ContactProblem& problem, std::size_t place);

  std::vector<RealVector> velocities_;
  std::vector<std::uint32_t> pushing_;
  std::uint32_t blocked_ = fixed_place;
  std::vector<std::vector<RealVector>> basis_;  // one field of velocities for each that pushes
  /// Where these are not 0, ascending: among those that contacts before had connected.
  std::vector<std::vector<std::uint32_t>> supports_;
  std::vector<std::vector<Real>> columns_;  // each one's effect in terms of the basis: a triangle
  // Of the touch that is looked at: the part of its effect beyond the basis, the part within, and
  // the impulses of those that push that make up the latter.
  std::vector<RealVector> direction_;
  std::vector<Real> column_, share_;
};

}  // namespace rink::physics::inline RINK_PRECISION
