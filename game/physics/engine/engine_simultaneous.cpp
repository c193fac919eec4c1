// Contacts that close at the same instant: one problem, not a sequence, so that nobody's number
// decides who is hit first.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "game/physics/engine/engine.h"

namespace rink::physics::inline RINK_PRECISION {

namespace {

constexpr std::size_t rounds_min =
    32;  // before all yield as one; an impulse through a chain needs one round per link,
constexpr std::size_t rounds_max = 128;       // so there are more where more touch
constexpr int cycles_max = 4;                 // of rounds and yielding
constexpr std::uint64_t endless_events = 64;  // at one instant: then too
/// Relative to the speeds: what closes more slowly does not close, and lacks no more of what is
/// wanted than a quarter of it.
constexpr Real rest_of_closing = 4e-13 * fineness;
/// A contact of whose effect no more than this is left by those of others, relative to it, is
/// implied by them.
constexpr Real superfluous = 1e-12 * fineness;

}  // namespace

/// Whether another impact may come at the instant at hand. Never misses one: an impact is either
/// the first of its body, and thus in the queue, or hidden behind that one.
bool Engine::is_crowded(std::uint32_t body, Partner p) const {
  return slots_[body].is_tied || (is_body(p) && slots_[p].is_tied) || is_endless() ||
         queue_.is_followed_within(instant);
}

/// Whether so many events have come at this instant that all that touch shall yield as one.
bool Engine::is_endless() const { return events_at_once_ % endless_events == 0; }

/// The impact at hand together with all others that close at this instant among bodies that touch,
/// directly or through others. False if there are none, or if no solution was found that keeps the
/// energy; then nothing has changed, and no other is looked for until the instant is over.
bool Engine::collide_together(const Contact& c, Real time) {
  if (is_rough() || is_hopeless_) return false;
  const bool is_joint = gather_touching(c, time) || is_endless();
  note_looked_at();
  if (!is_joint) return false;
  velocities_before_ = joint_velocities_;
  const Real energy = joint_energy();
  is_hopeless_ = !solve_joint() || !(joint_energy() <= energy * (1.0 + 1e-12 * fineness));
  if (is_hopeless_ && journal_ != nullptr) journal_->was_hopeless = true;
  if (is_hopeless_) return false;
  ++counters_.joint_impacts;
  apply_joint(time);
  return true;
}

bool Engine::solve_joint() {
  if (is_endless() && !yield_as_one(1.0)) return false;
  if (!propagate() && !come_to_rest()) return false;
  part_what_rounding_closes();
  return true;
}

Real Engine::joint_product(const std::vector<RealVector>& a,
                           const std::vector<RealVector>& b) const {
  Real sum = 0.0;
  for (std::size_t place = 0; place < joint_.size(); ++place)
    sum += builds_[joint_[place]].mass * a[place].dot(b[place]);
  return sum;
}

Real Engine::joint_speed() const {
  Real speed = 0.0;
  for (const RealVector& velocity : joint_velocities_) speed = std::max(speed, velocity.norm());
  return speed;
}

/// Rounds of impacts without time between them: in each, all contacts that close are one problem,
/// and those that do not stay out (Smith et al. 2012). Where they do not end (a light ball between
/// heavy ones, collapse), all that touch yield as one now and then. Answers whether that comes to
/// an end.
bool Engine::propagate() {
  const std::size_t rounds = std::min(rounds_min + 2 * touches_.size(), rounds_max);
  for (int cycle = 0; cycle < cycles_max; ++cycle) {
    for (std::size_t round = 0; round < rounds; ++round) {
      const Real speed = joint_speed();
      closing_.clear();
      for (std::uint32_t i = 0; i < touches_.size(); ++i) {
        const Real approach = -parting(touches_[i], joint_velocities_);
        touches_[i].wanted = std::max(touches_[i].restitution * approach, separation_min * speed);
        if (approach > rest_of_closing * speed) closing_.push_back(i);
      }
      if (closing_.empty()) return true;
      if (!find_pushing()) return false;
      reflect(true);
    }
    if (!yield_as_one(1.0)) return false;
  }
  return false;
}

/// Moreau's law of impact: of the velocities v = T + N, where T is the nearest that close no
/// contact, becomes T - e N. T and N are at right angles in the metric of the masses, so that
/// energy is kept for e = 1 and never grows. e is the least restitution of those that push, at most
/// `restitution_max`.
bool Engine::yield_as_one(Real restitution_max) {
  closing_.resize(touches_.size());
  std::iota(closing_.begin(), closing_.end(), 0u);
  for (Touch& touch : touches_) touch.wanted = 0.0;
  if (!find_pushing()) return false;
  reflect(false, restitution_max);
  return true;
}

/// The end of what loses energy without end. Not for what loses none.
bool Engine::come_to_rest() {
  const bool is_lossless = std::all_of(touches_.begin(), touches_.end(),
                                       [](const Touch& touch) { return touch.restitution == 1.0; });
  return !is_lossless && yield_as_one(0.0);
}

/// What is left of closing would be the next event.
void Engine::part_what_rounding_closes() {
  for (std::size_t round = 0; round < rounds_min; ++round) {
    const Real speed = joint_speed();
    closing_.clear();
    for (std::uint32_t i = 0; i < touches_.size(); ++i)
      if (parting(touches_[i], joint_velocities_) < 0.0)
        touches_[i].wanted = separation_min * speed, closing_.push_back(i);
    if (closing_.empty() || !find_pushing()) return;
    for (std::size_t place = 0; place < joint_.size(); ++place)
      joint_velocities_[place] = trial_velocities_[place];
  }
}

/// The nearest velocities, in the metric of the masses, that part all of `closing_` as fast as
/// wanted, into `trial_velocities_`, and who pushes for it: the dual method of Goldfarb and Idnani
/// (Math. Programming 27, 1983). `basis_` is made orthonormal in that metric, which bears any ratio
/// of masses.
bool Engine::find_pushing() {
  trial_velocities_ = joint_velocities_;
  pushing_.clear();
  blocked_ = fixed_place;
  for (const std::uint32_t i : closing_) touches_[i].impulse = 0.0;
  for (std::size_t steps_left = 20 * closing_.size() + 20; steps_left > 0;) {
    Real most = 0.25 * rest_of_closing * joint_speed();
    std::uint32_t next = fixed_place;
    for (const std::uint32_t i : closing_) {
      const Real lacking = touches_[i].wanted - parting(touches_[i], trial_velocities_);
      if (lacking > most && std::find(pushing_.begin(), pushing_.end(), i) == pushing_.end())
        most = lacking, next = i;
    }
    if (next == fixed_place) return true;
    while (!push_until_blocked(next))
      if (--steps_left == 0) return false;
    if (touches_[next].impulse == 0.0) return blocked_ = next, false;
  }
  return false;
}

/// Lets the contact push harder until it parts as wanted, or until another one of those that push
/// need not push any more and is dropped. Whether the former was reached, or nothing can be (then
/// its impulse is 0).
bool Engine::push_until_blocked(std::uint32_t next) {
  Touch& touch = touches_[next];
  const std::size_t count = pushing_.size();
  const Real own = orthogonalise(touch), length = joint_product(direction_, direction_);
  share_.resize(count);
  for (std::size_t row = count; row-- > 0;) {
    Real sum = column_[row];
    for (std::size_t k = row + 1; k < count; ++k) sum -= columns_[k][row] * share_[k];
    share_[row] = sum / columns_[row][row];
  }
  const bool is_implied = length <= superfluous * superfluous * own;
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  Real step = is_implied ? infinity : (touch.wanted - parting(touch, trial_velocities_)) / length;
  std::size_t blocking = count;
  for (std::size_t k = 0; k < count; ++k)
    if (share_[k] > 0.0 && touches_[pushing_[k]].impulse < step * share_[k])
      step = touches_[pushing_[k]].impulse / share_[k], blocking = k;
  if (step == infinity) return touch.impulse = 0.0, true;
  for (std::size_t k = 0; k < count; ++k)
    touches_[pushing_[k]].impulse =
        std::max<Real>(0.0, touches_[pushing_[k]].impulse - step * share_[k]);
  touch.impulse += step;
  if (!is_implied)
    for (std::size_t place = 0; place < joint_.size(); ++place)
      trial_velocities_[place] += step * direction_[place];
  if (blocking < count) return drop_pushing(blocking), false;
  append_pushing(next, std::sqrt(length));
  return true;
}

/// The effect of an impulse of 1, less what those that push already can do: into `direction_`, and
/// their shares into `column_`. Twice is enough (Kahan, in Parlett 1980). Answers the square of the
/// effect's length.
Real Engine::orthogonalise(const Touch& touch) {
  direction_.assign(joint_.size(), RealVector(0.0, 0.0));
  direction_[touch.body] = inverse_mass(joint_[touch.body]) * touch.normal;
  if (touch.other != fixed_place)
    direction_[touch.other] = -inverse_mass(joint_[touch.other]) * touch.normal;
  const Real own = parting(touch, direction_);
  column_.assign(pushing_.size(), 0.0);
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t k = 0; k < pushing_.size(); ++k) {
      const Real share = joint_product(basis_[k], direction_);
      column_[k] += share;
      for (std::size_t place = 0; place < joint_.size(); ++place)
        direction_[place] -= share * basis_[k][place];
    }
  return own;
}

void Engine::append_pushing(std::uint32_t touch, Real length) {
  const std::size_t count = pushing_.size();
  if (basis_.size() <= count) basis_.emplace_back(), columns_.emplace_back();
  for (RealVector& part : direction_) part /= length;
  basis_[count] = direction_;
  column_.push_back(length);
  columns_[count] = column_;
  pushing_.push_back(touch);
}

void Engine::drop_pushing(std::size_t place) {
  touches_[pushing_[place]].impulse = 0.0;
  const std::vector<std::uint32_t> others(pushing_.begin() + static_cast<std::ptrdiff_t>(place) + 1,
                                          pushing_.end());
  pushing_.resize(place);
  for (const std::uint32_t other : others) {
    orthogonalise(touches_[other]);
    append_pushing(other, std::sqrt(joint_product(direction_, direction_)));
  }
}

/// The new velocities, given who pushes: the part along `basis_` turns into -e times itself, which
/// keeps energy to rounding for e = 1 whatever the masses; then, if `as_wanted`, what is wanted
/// beyond that is added.
void Engine::reflect(bool as_wanted, Real restitution_max) {
  Real least = restitution_max;
  for (const std::uint32_t i : pushing_)
    least = std::min(least, touches_[i].restitution), touches_[i].has_pushed = true;
  trial_velocities_ = joint_velocities_;
  share_.assign(pushing_.size(), 0.0);
  for (std::size_t k = 0; k < pushing_.size(); ++k) {
    const Touch& touch = touches_[pushing_[k]];
    Real beyond = as_wanted ? touch.wanted + least * parting(touch, joint_velocities_) : 0.0;
    for (std::size_t j = 0; j < k; ++j) beyond -= columns_[k][j] * share_[j];
    share_[k] = beyond / columns_[k][k];
    const Real change = share_[k] - (1.0 + least) * joint_product(basis_[k], joint_velocities_);
    for (std::size_t place = 0; place < joint_.size(); ++place)
      trial_velocities_[place] += change * basis_[k][place];
  }
  joint_velocities_ = trial_velocities_;
}

/// Writes the velocities back. Rest contacts of whoever was pushed end as in any impact, and every
/// contact that pushed counts as one.
void Engine::apply_joint(Real time) {
  for (const Touch& touch : touches_) {
    if (!touch.has_pushed) continue;
    const std::uint32_t body = joint_[touch.body];
    if (!touch.is_at_hand) {
      if (is_fixed(touch.partner)) count_impact(body, touch.partner, time);
      else count_impact(std::min(body, touch.partner), std::max(body, touch.partner), time);
      note_impact(body, time);
      if (!is_fixed(touch.partner)) note_impact(touch.partner, time);
    }
    for (const Partner p : {body, touch.partner}) {
      if (is_fixed(p)) continue;
      wake(p, time);
      rebase_companions(p, time);
      for (int axis = 0; axis < 2; ++axis)
        if (touch.normal[axis] != 0.0) dissolve(p, axis, time);
    }
  }
  for (std::size_t place = 0; place < joint_.size(); ++place) {
    if (joint_velocities_[place] == velocities_before_[place]) continue;
    const std::uint32_t body = joint_[place];
    keep(body);
    bodies_[body].vx = joint_velocities_[place].x();
    bodies_[body].vy = joint_velocities_[place].y();
    touch(body);  // also of one that moves by a rounding without a push: what is predicted of it
                  // must follow from its state
  }
}

}  // namespace rink::physics::inline RINK_PRECISION
