// A few steps of Newton's method, each of which is a problem of complementarity.
#include "game/physics/contact/glide_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "game/physics/flight/motion.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {

/// The first step aims by the thrust alone, the second by nearly the right accelerations, and what
/// the third leaves of a gap is of the fourth order in the duration.
constexpr int aim_steps = 3, aim_steps_inside = 2;
constexpr std::size_t dual_max = 96;  // contacts
constexpr Real accuracy = 1e-6;       // of accelerations, from inside

RealVector between(const Touch& touch, const auto& of_body) {
  return touch.other == fixed_place ? RealVector(of_body(touch.body))
                                    : RealVector(of_body(touch.body) - of_body(touch.other));
}

}  // namespace

bool GlideSolver::solve(const ContactProblem& problem, std::span<const Drive> drives,
                        const Glide& glide) {
  assert(drives.size() == problem.body_count() && glide.duration > 0.0 && glide.opening >= 0.0);
  start(problem, drives);
  const int steps = is_small() ? aim_steps : aim_steps_inside;
  for (int step = 0; step < steps; ++step) {
    move(problem, glide);
    for (std::size_t i = 0; i < problem.touches.size(); ++i)
      aim(problem.touches[i], forces_.touches[i], glide);
    if (!solve_forces()) return false;
  }
  work_max_ = 0.0;
  for (const std::uint32_t i : is_small() ? set_.pushing() : std::span<const std::uint32_t>(all_))
    work_max_ += work_of(problem, forces_.touches[i], glide.duration);
  return true;
}

/// The dual method takes a step for each contact that pushes, and the longer the more do: many are
/// faster solved from inside.
bool GlideSolver::is_small() const { return all_.size() <= dual_max; }

bool GlideSolver::solve_forces() {
  if (is_small() ? !set_.solve(forces_, all_) : !interior_.solve(forces_, accuracy)) return false;
  accelerations_ = is_small() ? set_.velocities() : interior_.velocities();
  return true;
}

void GlideSolver::start(const ContactProblem& problem, std::span<const Drive> drives) {
  forces_ = problem;
  accelerations_.clear(), drags_.clear();
  for (const Drive& drive : drives)
    accelerations_.push_back(drive.thrust), drags_.push_back(drive.drag);
  forces_.velocities = accelerations_;
  all_.resize(problem.touches.size());
  std::iota(all_.begin(), all_.end(), 0u);
}

/// The ways of all bodies under the accelerations at hand.
void GlideSolver::move(const ContactProblem& problem, const Glide& glide) {
  ways_.resize(problem.body_count());
  for (std::size_t place = 0; place < ways_.size(); ++place) {
    const WarpedTime half = warp(0.5 * glide.duration, drags_[place]),
                     whole = warp(glide.duration, drags_[place]);
    const RealVector &velocity = problem.velocities[place], &acceleration = accelerations_[place];
    ways_[place] = {velocity * half.s + acceleration * half.q,
                    velocity * whole.s + acceleration * whole.q};
  }
}

/// Along the normal of half the way, and so strong that the gap at its end, which changes by half
/// of the duration's square times the acceleration, is as wanted.
void GlideSolver::aim(const Touch& touch, Touch& force, const Glide& glide) const {
  const auto way = [&](auto part) {
    return between(touch,
                   [&](std::uint32_t place) -> const RealVector& { return ways_[place].*part; });
  };
  const RealVector whole = way(&Ways::whole);
  Real gap = touch.gap + touch.normal.dot(whole);
  if (touch.reach > 0.0) {
    const RealVector line = touch.reach * touch.normal;
    force.normal = RealVector(line + way(&Ways::half)).normalized();
    gap = touch.gap + (RealVector(line + whole).norm() - touch.reach);
  }
  force.wanted = parting(force, accelerations_) +
                 2.0 * (glide.opening * glide.duration - gap) / (glide.duration * glide.duration);
}

Real GlideSolver::work_of(const ContactProblem& problem, const Touch& force, Real duration) const {
  const Real speed = parting(force, problem.velocities),
             growth = 0.5 * parting(force, accelerations_);
  const Real turn =
      growth < 0.0 ? std::clamp<Real>(-0.5 * speed / growth, 0.0, duration) : duration;
  return force.impulse * std::max<Real>(0.0, (speed + growth * turn) * turn);
}

}  // namespace rink::physics::inline RINK_PRECISION
