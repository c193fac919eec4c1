// The forces by which bodies in contact move on together for a while.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/contact/active_set.h"
#include "game/physics/contact/contact_problem.h"
#include "game/physics/contact/interior_point.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// What acts on a body besides its contacts.
struct Drive {
  RealVector thrust;  ///< m/s^2
  Real drag;          ///< 1/s
};

/// How long forces shall last, and how fast contacts shall part meanwhile.
struct Glide {
  Real duration, opening;  ///< s, m/s
};

/// Finds constant forces that push, and under which no gap is closed at the end of a glide
/// (docs/physics.md, "Degenerate contact"). Each is aimed along the normal that the contact has
/// half-way. Keeps its memory from one problem to the next.
class GlideSolver {
 public:
  /// Where the caller solves problems of the same touches with `interior`, it knows them already.
  explicit GlideSolver(InteriorPoint& interior) : interior_(interior) {}

  /// `drives` are in order of the problem's bodies, whose velocities part all contacts. False if no
  /// such forces were found.
  bool solve(const ContactProblem& problem, std::span<const Drive> drives, const Glide& glide);

  /// By body, thrust included [m/s^2].
  const std::vector<RealVector>& accelerations() const { return accelerations_; }
  /// In order of the problem's touches: `impulse` is the force [N], `wanted` the least acceleration
  /// of separation along the normal half-way [m/s^2].
  const std::vector<Touch>& forces() const { return forces_.touches; }
  /// What the forces together do at most on the way, for their normals turn and they do not [J].
  Real work_max() const { return work_max_; }

 private:
  struct Ways {
    RealVector half, whole;
  };

  void start(const ContactProblem& problem, std::span<const Drive> drives);
  void move(const ContactProblem& problem, const Glide& glide);
  void aim(const Touch& touch, Touch& force, const Glide& glide) const;
  bool is_small() const;
  bool solve_forces();
  Real work_of(const ContactProblem& problem, const Touch& force, Real duration) const;

  ActiveSet set_;
  InteriorPoint& interior_;
  ContactProblem forces_;  // accelerations instead of velocities
  std::vector<RealVector> accelerations_;
  std::vector<std::uint32_t> all_;  // touches
  std::vector<Real> drags_;         // of the bodies
  std::vector<Ways> ways_;          // theirs
  Real work_max_ = 0.0;
};

}  // namespace rink::physics::inline RINK_PRECISION
