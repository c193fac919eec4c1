// The direct way for small clusters, sweeps for large ones and for static friction.
#include "game/physics/contact/separation_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace rink::physics::inline RINK_PRECISION {

namespace {

constexpr std::size_t direct_max = 96;  // contacts
constexpr int sweeps_max = 500;

/// Bodies joined to groups, each led by the member with the highest number.
class Groups {
 public:
  explicit Groups(std::uint32_t count) : leaders_(count) {
    std::iota(leaders_.begin(), leaders_.end(), 0u);
  }
  std::uint32_t leader(std::uint32_t member) const {
    while (leaders_[member] != member) member = leaders_[member];
    return member;
  }
  void join(std::uint32_t one, std::uint32_t two) {
    assert(one < leaders_.size() && two < leaders_.size());
    one = leader(one), two = leader(two);
    leaders_[std::min(one, two)] = std::max(one, two);
  }

 private:
  std::vector<std::uint32_t> leaders_;
};

/// Of the motion against `frame`.
Real energy_against(const ContactProblem& problem, const RealVector& frame) {
  Real sum = 0.0;
  for (std::size_t place = 0; place < problem.body_count(); ++place)
    sum += 0.5 * problem.masses[place] * (problem.velocities[place] - frame).squaredNorm();
  return sum;
}

bool closes_fixed(const ContactProblem& problem, const RealVector& velocity) {
  const Real least = -1e-12 * fineness * velocity.norm();
  return std::any_of(problem.touches.begin(), problem.touches.end(), [&](const Touch& c) {
    return c.other == fixed_place && c.normal.dot(velocity) < least;
  });
}

/// The velocity that all bodies together keep whatever they pay: the nearest to that of the common
/// centre of mass at which nothing fixed is run into. What is fixed can take only the rest of the
/// momentum, for it pushes along its normals and does not pull.
RealVector frame_of(const ContactProblem& problem) {
  Real mass = 0.0;
  RealVector momentum(0.0, 0.0);
  for (std::size_t place = 0; place < problem.body_count(); ++place) {
    mass += problem.masses[place];
    momentum += problem.masses[place] * problem.velocities[place];
  }
  const RealVector common = momentum / mass;
  if (!closes_fixed(problem, common)) return common;
  for (const Touch& c : problem.touches) {
    if (c.other != fixed_place || !(c.normal.dot(common) < 0.0)) continue;
    const RealVector along = common - c.normal.dot(common) * c.normal;
    if (!closes_fixed(problem, along)) return along;
  }
  return {0.0, 0.0};
}

/// What the impulses of all that is fixed do in that frame [J]: never below 0, and above where
/// something fixed pushes bodies that leave it.
Real work_of_fixed(const ContactProblem& problem, const RealVector& frame) {
  Real sum = 0.0;
  for (const Touch& c : problem.touches)
    if (c.other == fixed_place) sum += c.impulse * std::max<Real>(0.0, c.normal.dot(frame));
  return sum;
}

/// The root of share^2 `square` + share `linear` = `whole`, which is at most their sum.
Real share_of(Real whole, Real square, Real linear) {
  assert(square > 0.0 && linear >= 0.0 && whole >= 0.0);
  const Real half = 0.5 * linear / square, root = std::sqrt(whole / square + half * half);
  return half > 0.0 ? std::min<Real>(1.0, whole / square / (half + root)) : root;
}

}  // namespace

/// With the velocities v = frame + share (v' - frame), energy is that of the frame, share times the
/// work of what is fixed, and share^2 times the energy against the frame.
Real SeparationSolver::part(ContactProblem& problem, Real separation, Real gain_max) {
  assert(!(separation < 0.0) && !(gain_max < 0.0) && problem.body_count() > 0);
  problem.check();
  const RealVector frame = frame_of(problem);
  const Real energy_before = energy_against(problem, frame), energy_max = energy_before + gain_max;
  separate(problem, separation);
  const Real energy_after = energy_against(problem, frame), work = work_of_fixed(problem, frame);
  if (!(energy_after + work > energy_max)) return energy_after + work - energy_before;
  const Real share = share_of(energy_max, energy_after, work);
  for (RealVector& velocity : problem.velocities) velocity = frame + share * (velocity - frame);
  return energy_max - energy_before;
}

bool SeparationSolver::bears(ContactProblem& problem, Real friction, Real remaining_max) {
  assert(friction >= 0.0 && !(remaining_max < 0.0));
  problem.check();
  if (friction > 0.0) sweep(problem, 0.0, friction);
  else separate(problem, 0.0);
  return std::none_of(
      problem.velocities.begin(), problem.velocities.end(),
      [&](const RealVector& acceleration) { return acceleration.norm() > remaining_max; });
}

/// The nearest velocities, in the metric of the masses, that part every contact at `separation` or
/// faster.
void SeparationSolver::separate(ContactProblem& problem, Real separation) {
  for (Touch& touch : problem.touches) touch.wanted = separation;
  all_.resize(problem.touches.size());
  std::iota(all_.begin(), all_.end(), 0u);
  for (bool is_jammed = false; all_.size() <= direct_max; is_jammed = true) {
    if (set_.solve(problem, all_)) {
      problem.velocities = set_.velocities();
      if (is_jammed) hold_jammed(problem);
      return;
    }
    if (!give_way(problem)) break;
  }
  sweep(problem, separation, 0.0);
}

/// After no solution was found, for contacts that hold what is between them from opposite sides
/// cannot all part: these shall only not close. Answers whether that asks for less.
bool SeparationSolver::give_way(ContactProblem& problem) const {
  if (set_.blocked() == fixed_place) return false;
  bool is_less = false;
  const auto yield = [&](std::uint32_t i) {
    is_less = is_less || problem.touches[i].wanted > 0.0;
    problem.touches[i].wanted = 0.0;
  };
  yield(set_.blocked());
  set_.for_each_opposed(yield);
  return is_less;
}

/// Bodies that are held from opposite sides along an axis get the same velocity along it, to the
/// bit (none, where something fixed holds them): what rounding leaves would let them meet again at
/// once, and for ever.
void SeparationSolver::hold_jammed(ContactProblem& problem) {
  const auto fixed = static_cast<std::uint32_t>(problem.body_count());
  const Real slowest = 1e-9 * problem.speed();
  for (int axis = 0; axis < 2; ++axis) {
    Groups groups(fixed + 1);  // what is fixed leads whomever it holds
    for (const Touch& c : problem.touches)
      if (!(c.wanted > 0.0) && c.normal[1 - axis] == 0.0 &&
          !(std::abs(parting(c, problem.velocities)) > slowest))
        groups.join(c.body, c.other == fixed_place ? fixed : c.other);
    for (std::uint32_t place = 0; place < fixed; ++place)
      if (const std::uint32_t first = groups.leader(place); first != place)
        problem.velocities[place][axis] =
            first == fixed ? Real(0.0) : problem.velocities[first][axis];
  }
}

/// Gauss-Seidel on impulses: for clusters so large that the direct way would take milliseconds, at
/// the price of poor convergence where light bodies lie between heavy ones. Where `friction` is
/// above 0, pucks resist their motion by up to that impulse per mass.
void SeparationSolver::sweep(ContactProblem& problem, Real separation, Real friction) {
  const Real accuracy = separation > 0.0 ? 0.1 * separation : 1e-9 * problem.speed();
  for (Touch& c : problem.touches) c.impulse = 0.0;
  friction_.assign(problem.body_count(), RealVector(0.0, 0.0));
  for (int sweep = 0; sweep < sweeps_max; ++sweep) {
    const Real resisted = friction > 0.0 ? resist(problem, friction) : Real(0.0);
    if (std::max(resisted, push_apart(problem, separation)) <= accuracy) return;
  }
}

/// One sweep over the contacts; answers its largest change.
Real SeparationSolver::push_apart(ContactProblem& problem, Real separation) {
  const auto yielding = [&](std::uint32_t place) {
    return place == fixed_place ? Real(0.0) : problem.inverse_masses[place];
  };
  Real change = 0.0;
  for (Touch& c : problem.touches) {
    const Real own = yielding(c.body), other = yielding(c.other),
               lacking = separation - parting(c, problem.velocities);
    const Real impulse = std::max<Real>(0.0, c.impulse + lacking / (own + other)),
               step = impulse - c.impulse;
    c.impulse = impulse;
    problem.velocities[c.body] += step * own * c.normal;
    if (c.other != fixed_place) problem.velocities[c.other] -= step * other * c.normal;
    change = std::max(change, std::abs(step) * (own + other));
  }
  return change;
}

/// One sweep of static friction; answers its largest change.
Real SeparationSolver::resist(ContactProblem& problem, Real friction) {
  Real change = 0.0;
  for (std::size_t place = 0; place < problem.body_count(); ++place) {
    if (!problem.is_slowed[place]) continue;
    RealVector resistance = friction_[place] - problem.velocities[place];
    const Real length = resistance.norm();
    if (length > friction) resistance *= friction / length;
    const RealVector step = resistance - friction_[place];
    problem.velocities[place] += step;
    friction_[place] = resistance;
    change = std::max(change, step.norm());
  }
  return change;
}

}  // namespace rink::physics::inline RINK_PRECISION
