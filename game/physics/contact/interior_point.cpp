// Newton's steps towards the centre of what is left, each with one factorisation.
#include "game/physics/contact/interior_point.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace rink::physics::inline RINK_PRECISION {

namespace {

constexpr int steps_max = 60;
constexpr Real short_of_edge = 0.99;
constexpr Real least_accuracy = 1e-9;  // of what rounding disturbs

/// Calls `visit(place, sign)` for the one or two bodies of a touch.
void for_each_side(const Touch& touch, auto&& visit) {
  visit(touch.body, Real(1.0));
  if (touch.other != fixed_place) visit(touch.other, Real(-1.0));
}

}  // namespace

bool InteriorPoint::solve(ContactProblem& problem, Real accuracy) {
  problem.check();
  assert(accuracy > 0.0 && problem.body_count() > 0);
  order(problem);
  lay_out(problem);
  start(problem);
  for (int step = 0; step < steps_max; ++step) {
    find_residuals(problem);
    if (is_solved(accuracy)) {
      for (std::size_t i = 0; i < impulses_.size(); ++i) problem.touches[i].impulse = impulses_[i];
      return true;
    }
    stiffen(problem);
    factorise();
    find_direction(problem, 0.0, false);
    const Real share = mean_after(longest_step()) / mean_;
    find_direction(problem, share * share * share * mean_, true);
    go(problem, std::min<Real>(1.0, short_of_edge * longest_step()));
  }
  return false;
}

/// Bodies by their distance from one that is as far from others as any: who touch each other then
/// have places near each other (Cuthill and McKee 1969).
void InteriorPoint::order(const ContactProblem& problem) {
  const std::size_t count = problem.body_count();
  neighbour_begins_.assign(count + 2, 0);
  for (const Touch& touch : problem.touches)
    if (touch.other != fixed_place)
      for_each_side(touch, [&](std::uint32_t place, Real) { ++neighbour_begins_[place + 2]; });
  for (std::size_t i = 2; i < count + 2; ++i) neighbour_begins_[i] += neighbour_begins_[i - 1];
  neighbours_.resize(neighbour_begins_[count + 1]);
  for (const Touch& touch : problem.touches) {
    if (touch.other == fixed_place) continue;
    neighbours_[neighbour_begins_[touch.body + 1]++] = touch.other;
    neighbours_[neighbour_begins_[touch.other + 1]++] = touch.body;
  }
  visit_from(visit_from(0, count), count);
  std::reverse(order_.begin(), order_.end());
  for (std::uint32_t row = 0; row < count; ++row) places_[order_[row]] = row;
}

/// Fills the order, and answers who comes last.
std::uint32_t InteriorPoint::visit_from(std::uint32_t first, std::size_t body_count) {
  order_.clear();
  places_.assign(body_count, fixed_place);
  const auto list = [&](std::uint32_t body) {
    if (places_[body] != fixed_place) return;
    places_[body] = static_cast<std::uint32_t>(order_.size());
    order_.push_back(body);
  };
  list(first);
  for (std::uint32_t rest = 0, next = 0; order_.size() < body_count; ++next) {
    if (next == order_.size()) {
      while (places_[rest] != fixed_place) ++rest;
      list(rest);
    }
    const std::uint32_t body = order_[next];
    for (std::uint32_t i = neighbour_begins_[body]; i < neighbour_begins_[body + 1]; ++i)
      list(neighbours_[i]);
  }
  return order_.back();
}

void InteriorPoint::lay_out(const ContactProblem& problem) {
  const auto count = static_cast<std::uint32_t>(problem.body_count());
  firsts_.resize(count), begins_.resize(count);
  for (std::uint32_t row = 0; row < count; ++row) firsts_[row] = row;
  for (const Touch& touch : problem.touches) {
    if (touch.other == fixed_place) continue;
    const auto [low, high] = std::minmax(places_[touch.body], places_[touch.other]);
    firsts_[high] = std::min(firsts_[high], low);
  }
  std::size_t size = 0;
  for (std::uint32_t row = 0; row < count; ++row)
    begins_[row] = size, size += row - firsts_[row] + 1;
  squares_.resize(size);
}

/// Far from all edges.
void InteriorPoint::start(ContactProblem& problem) {
  const std::size_t count = problem.touches.size();
  velocities_ = problem.velocities;
  speed_ = problem.speed(), push_ = 0.0;
  for (const Touch& touch : problem.touches) speed_ = std::max(speed_, std::abs(touch.wanted));
  speed_ = std::max(speed_, std::numeric_limits<Real>::min());
  for (std::size_t place = 0; place < problem.body_count(); ++place)
    push_ = std::max(push_, problem.masses[place] * problem.velocities[place].norm());
  push_ = std::max(push_, speed_ * *std::min_element(problem.masses.begin(), problem.masses.end()));
  impulses_.assign(count, push_), slacks_.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    slacks_[i] =
        std::max(speed_, parting(problem.touches[i], velocities_) - problem.touches[i].wanted);
  lacking_.resize(count), slack_changes_.resize(count), impulse_changes_.resize(count);
}

void InteriorPoint::find_residuals(const ContactProblem& problem) {
  const std::size_t count = problem.touches.size();
  residuals_.resize(problem.body_count());
  for (std::size_t place = 0; place < residuals_.size(); ++place)
    residuals_[place] = problem.masses[place] * (velocities_[place] - problem.velocities[place]);
  mean_ = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Touch& touch = problem.touches[i];
    lacking_[i] = slacks_[i] - (parting(touch, velocities_) - touch.wanted);
    mean_ += impulses_[i] * slacks_[i];
    for_each_side(touch, [&](std::uint32_t place, Real sign) {
      residuals_[place] -= sign * impulses_[i] * touch.normal;
    });
  }
  mean_ /= static_cast<Real>(std::max<std::size_t>(1, count));
}

bool InteriorPoint::is_solved(Real accuracy) const {
  if (mean_ > accuracy * speed_ * push_) return false;
  accuracy = std::max(accuracy, least_accuracy);
  return std::all_of(lacking_.begin(), lacking_.end(),
                     [&](Real lacking) { return std::abs(lacking) <= accuracy * speed_; }) &&
         std::all_of(residuals_.begin(), residuals_.end(),
                     [&](const RealVector& r) { return r.norm() <= accuracy * push_; });
}

/// The masses, and each contact as a spring: the harder it pushes and the less it is open, the
/// stiffer.
void InteriorPoint::stiffen(const ContactProblem& problem) {
  std::fill(squares_.begin(), squares_.end(), Square{});
  for (std::uint32_t row = 0; row < order_.size(); ++row) {
    const Real mass = problem.masses[order_[row]];
    at(row, row) = {mass, 0.0, 0.0, mass};
  }
  for (std::size_t i = 0; i < impulses_.size(); ++i) {
    const Touch& touch = problem.touches[i];
    const Real stiffness = impulses_[i] / slacks_[i], x = touch.normal.x(), y = touch.normal.y();
    const Square spring{stiffness * x * x, stiffness * x * y, stiffness * x * y, stiffness * y * y};
    const auto add = [&](Square& square, Real sign) {
      for (std::size_t k = 0; k < 4; ++k) square[k] += sign * spring[k];
    };
    for_each_side(touch,
                  [&](std::uint32_t body, Real) { add(at(places_[body], places_[body]), 1.0); });
    if (touch.other == fixed_place) continue;
    const auto [low, high] = std::minmax(places_[touch.body], places_[touch.other]);
    add(at(high, low), -1.0);
  }
}

void InteriorPoint::factorise() {
  for (std::uint32_t row = 0; row < order_.size(); ++row) reduce(row);
}

/// One row of pairs of the triangle, from those before.
void InteriorPoint::reduce(std::uint32_t row) {
  Square* const own = &squares_[begins_[row]];
  const std::uint32_t first = firsts_[row];
  for (std::uint32_t column = first; column <= row; ++column) {
    const std::uint32_t low = std::max(first, firsts_[column]);
    const Square *a = own + (low - first), *b = &at(column, low);
    Real s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
    for (std::uint32_t k = low; k < column; ++k, ++a, ++b) {
      s0 += (*a)[0] * (*b)[0] + (*a)[1] * (*b)[1];
      s1 += (*a)[0] * (*b)[2] + (*a)[1] * (*b)[3];
      s2 += (*a)[2] * (*b)[0] + (*a)[3] * (*b)[1];
      s3 += (*a)[2] * (*b)[2] + (*a)[3] * (*b)[3];
    }
    Square& square = own[column - first];
    square[0] -= s0, square[1] -= s1, square[2] -= s2, square[3] -= s3;
    const Real least = std::numeric_limits<Real>::min();
    if (column == row) {
      square[0] = std::sqrt(std::max(least, square[0]));
      square[2] /= square[0], square[1] = 0.0;
      square[3] = std::sqrt(std::max(least, square[3] - square[2] * square[2]));
    } else {
      const Square& corner = at(column, column);
      square[0] /= corner[0], square[2] /= corner[0];
      square[1] = (square[1] - square[0] * corner[2]) / corner[3];
      square[3] = (square[3] - square[2] * corner[2]) / corner[3];
    }
  }
}

/// Forwards through the triangle and back.
void InteriorPoint::substitute() {
  const auto count = static_cast<std::uint32_t>(order_.size());
  for (std::uint32_t row = 0; row < count; ++row) {
    RealVector sum = right_[row];
    for (std::uint32_t column = firsts_[row]; column < row; ++column) {
      const Square& s = at(row, column);
      const RealVector& x = right_[column];
      sum.x() -= s[0] * x.x() + s[1] * x.y(), sum.y() -= s[2] * x.x() + s[3] * x.y();
    }
    const Square& corner = at(row, row);
    const Real first = sum.x() / corner[0];
    right_[row] = {first, (sum.y() - corner[2] * first) / corner[3]};
  }
  for (std::uint32_t row = count; row-- > 0;) {
    const Square& corner = at(row, row);
    const Real second = right_[row].y() / corner[3];
    const RealVector x((right_[row].x() - corner[2] * second) / corner[0], second);
    right_[row] = x;
    for (std::uint32_t column = firsts_[row]; column < row; ++column) {
      const Square& s = at(row, column);
      right_[column].x() -= s[0] * x.x() + s[2] * x.y();
      right_[column].y() -= s[1] * x.x() + s[3] * x.y();
    }
  }
}

/// Towards impulse times slack = `target` everywhere; `corrects` what the changes at hand, each
/// times the other, would add to that.
void InteriorPoint::find_direction(const ContactProblem& problem, Real target, bool corrects) {
  right_.resize(order_.size());
  for (std::size_t row = 0; row < order_.size(); ++row) right_[row] = -residuals_[order_[row]];
  for (std::size_t i = 0; i < impulses_.size(); ++i) {
    const Touch& touch = problem.touches[i];
    Real& excess = impulse_changes_[i];
    excess = impulses_[i] * slacks_[i] - target +
             (corrects ? impulse_changes_[i] * slack_changes_[i] : Real(0.0));
    const RealVector push = ((impulses_[i] * lacking_[i] - excess) / slacks_[i]) * touch.normal;
    for_each_side(touch,
                  [&](std::uint32_t body, Real sign) { right_[places_[body]] += sign * push; });
  }
  substitute();
  changes_.resize(order_.size());
  for (std::size_t row = 0; row < order_.size(); ++row) changes_[order_[row]] = right_[row];
  for (std::size_t i = 0; i < impulses_.size(); ++i) {
    slack_changes_[i] = parting(problem.touches[i], changes_) - lacking_[i];
    impulse_changes_[i] = -(impulse_changes_[i] + impulses_[i] * slack_changes_[i]) / slacks_[i];
  }
}

/// Up to where the first impulse or slack would vanish, at most 1.
Real InteriorPoint::longest_step() const {
  Real step = 1.0;
  for (std::size_t i = 0; i < impulses_.size(); ++i) {
    if (impulse_changes_[i] < 0.0) step = std::min(step, -impulses_[i] / impulse_changes_[i]);
    if (slack_changes_[i] < 0.0) step = std::min(step, -slacks_[i] / slack_changes_[i]);
  }
  return step;
}

Real InteriorPoint::mean_after(Real step) const {
  Real sum = 0.0;
  for (std::size_t i = 0; i < impulses_.size(); ++i)
    sum += (impulses_[i] + step * impulse_changes_[i]) * (slacks_[i] + step * slack_changes_[i]);
  return sum / static_cast<Real>(std::max<std::size_t>(1, impulses_.size()));
}

void InteriorPoint::go(ContactProblem& problem, Real step) {
  for (std::size_t place = 0; place < problem.body_count(); ++place)
    velocities_[place] += step * changes_[place];
  for (std::size_t i = 0; i < impulses_.size(); ++i)
    impulses_[i] += step * impulse_changes_[i], slacks_[i] += step * slack_changes_[i];
}

}  // namespace rink::physics::inline RINK_PRECISION
