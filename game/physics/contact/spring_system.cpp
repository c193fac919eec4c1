// The order of elimination, the triangle, and the way through it and back.
#include "game/physics/contact/spring_system.h"
#include "im/basics/sorted_set.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>

namespace rink::physics::inline RINK_PRECISION {

void SpringSystem::lay_out(const ContactProblem& problem) {
  problem.check();
  assert(problem.body_count() > 0);
  if (!has_same_pairs(problem)) {
    connect(problem.body_count());
    order();
    list_rows();
    place_springs();
  }
  clear(problem);
}

/// And notes those that the problem has.
bool SpringSystem::has_same_pairs(const ContactProblem& problem) {
  const auto is_same = [](const Pair& pair, const Touch& touch) {
    return pair == Pair(touch.body, touch.other);
  };
  if (order_.size() == problem.body_count() &&
      std::equal(pairs_.begin(), pairs_.end(), problem.touches.begin(), problem.touches.end(),
                 is_same))
    return true;
  pairs_.clear();
  for (const Touch& touch : problem.touches) pairs_.emplace_back(touch.body, touch.other);
  return false;
}

void SpringSystem::connect(std::size_t body_count) {
  if (neighbours_.size() < body_count) neighbours_.resize(body_count);
  for (std::size_t body = 0; body < body_count; ++body) neighbours_[body].clear();
  for (const auto& [body, other] : pairs_) {
    if (other == fixed_place) continue;
    neighbours_[body].push_back(other);
    neighbours_[other].push_back(body);
  }
  queue_.clear();
  for (std::uint32_t body = 0; body < body_count; ++body) {
    std::vector<std::uint32_t>& own = neighbours_[body];
    make_sorted_set(own);
    queue_.emplace_back(static_cast<std::uint32_t>(own.size()), body);
  }
  std::make_heap(queue_.begin(), queue_.end(), std::greater<>());
  order_.clear(), begins_.assign(1, 0), rows_.clear();
  places_.assign(body_count, fixed_place);
}

/// Entries of the heap whose number is not the present one are of earlier: their bodies have
/// others.
void SpringSystem::order() {
  while (!queue_.empty()) {
    const auto [count, body] = queue_.front();
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    queue_.pop_back();
    if (places_[body] == fixed_place && neighbours_[body].size() == count) eliminate(body);
  }
  assert(order_.size() == places_.size());
  for (std::uint32_t column = 0; column < order_.size(); ++column) {
    const auto begin = rows_.begin() + begins_[column], end = rows_.begin() + begins_[column + 1];
    for (auto row = begin; row != end; ++row) *row = places_[*row];
    std::sort(begin, end);
    assert(*begin == column);
  }
}

/// The neighbours of an eliminated body become neighbours of each other.
void SpringSystem::eliminate(std::uint32_t body) {
  places_[body] = static_cast<std::uint32_t>(order_.size());
  order_.push_back(body);
  const std::vector<std::uint32_t>& left = neighbours_[body];
  rows_.push_back(body);
  rows_.insert(rows_.end(), left.begin(), left.end());
  begins_.push_back(static_cast<std::uint32_t>(rows_.size()));
  for (const std::uint32_t other : left) {
    std::vector<std::uint32_t>& own = neighbours_[other];
    joined_.clear();
    std::set_union(own.begin(), own.end(), left.begin(), left.end(), std::back_inserter(joined_));
    std::erase_if(joined_, [&](std::uint32_t who) { return who == body || who == other; });
    own.swap(joined_);
    if (own.size() == joined_.size()) continue;  // as the heap says
    queue_.emplace_back(static_cast<std::uint32_t>(own.size()), other);
    std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
  }
}

/// Of each row the squares before the diagonal, in order of their columns.
void SpringSystem::list_rows() {
  const auto count = static_cast<std::uint32_t>(order_.size());
  entry_begins_.assign(count + 2, 0);
  for (const std::uint32_t row : rows_) ++entry_begins_[row + 2];
  for (std::size_t i = 2; i < entry_begins_.size(); ++i) entry_begins_[i] += entry_begins_[i - 1];
  entries_.resize(rows_.size());
  for (std::uint32_t column = 0; column < count; ++column)
    for (std::uint32_t place = begins_[column]; place < begins_[column + 1]; ++place)
      entries_[entry_begins_[rows_[place] + 1]++] = {place, begins_[column + 1]};
  where_.resize(count);
  squares_.resize(rows_.size());
}

void SpringSystem::place_springs() {
  springs_.assign(pairs_.size(), 0);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (pairs_[i].second == fixed_place) continue;
    const auto [column, row] = std::minmax(places_[pairs_[i].first], places_[pairs_[i].second]);
    const std::span<const std::uint32_t> rows = column_rows(column);
    const auto found = std::lower_bound(rows.begin(), rows.end(), row);
    assert(found != rows.end() && *found == row);
    springs_[i] = begins_[column] + static_cast<std::uint32_t>(found - rows.begin());
  }
}

void SpringSystem::clear(const ContactProblem& problem) {
  assert(order_.size() == problem.body_count());
  std::fill(squares_.begin(), squares_.end(), Square{RealVector::Zero(), RealVector::Zero()});
  for (std::size_t column = 0; column < order_.size(); ++column) {
    const Real mass = problem.masses[order_[column]];
    squares_[begins_[column]] = {{mass, 0.0}, {0.0, mass}};
  }
}

void SpringSystem::add_spring(const ContactProblem& problem, std::size_t i, Real stiffness) {
  assert(i < springs_.size() && !(stiffness < 0.0));
  const Touch& touch = problem.touches[i];
  const RealVector upper = (stiffness * touch.normal.x()) * touch.normal,
                   lower = (stiffness * touch.normal.y()) * touch.normal;
  Square& own = squares_[begins_[places_[touch.body]]];
  own.upper += upper, own.lower += lower;
  if (touch.other == fixed_place) return;
  Square &other = squares_[begins_[places_[touch.other]]], &both = squares_[springs_[i]];
  other.upper += upper, other.lower += lower;
  both.upper -= upper, both.lower -= lower;
}

void SpringSystem::factorise() {
  for (std::uint32_t column = 0; column < order_.size(); ++column) {
    gather_column(column);
    finish_column(column);
  }
}

/// What the elimination of earlier bodies does to a column.
void SpringSystem::gather_column(std::uint32_t column) {
  for (std::uint32_t place = begins_[column]; place < begins_[column + 1]; ++place)
    where_[rows_[place]] = place;
  for (std::uint32_t i = entry_begins_[column]; i + 1 < entry_begins_[column + 1]; ++i) {
    const Entry& entry = entries_[i];
    const Square& s = squares_[entry.place];
    const RealVector first(s.upper.x(), s.lower.x()), second(s.upper.y(), s.lower.y());
    for (std::uint32_t place = entry.place; place < entry.end; ++place) {
      const Square& from = squares_[place];
      Square& to = squares_[where_[rows_[place]]];
      to.upper -= from.upper.x() * first + from.upper.y() * second;
      to.lower -= from.lower.x() * first + from.lower.y() * second;
    }
  }
}

/// The square on the diagonal keeps its sides' inverses: there are far more products than squares.
void SpringSystem::finish_column(std::uint32_t column) {
  constexpr Real least = std::numeric_limits<Real>::min();
  Square& corner = squares_[begins_[column]];
  const Real x = std::sqrt(std::max(least, corner.upper.x())), across = corner.lower.x() / x,
             y = std::sqrt(std::max(least, corner.lower.y() - across * across));
  const Real per_x = 1.0 / x, per_y = 1.0 / y;
  corner = {{per_x, 0.0}, {across, per_y}};
  for (std::uint32_t place = begins_[column] + 1; place < begins_[column + 1]; ++place)
    for (RealVector* const row : {&squares_[place].upper, &squares_[place].lower}) {
      row->x() *= per_x;
      row->y() = (row->y() - row->x() * across) * per_y;
    }
}

/// Forwards through the triangle and back.
void SpringSystem::solve(std::vector<RealVector>& forces) {
  assert(forces.size() == order_.size());
  const auto count = static_cast<std::uint32_t>(order_.size());
  solution_.resize(count);
  for (std::uint32_t row = 0; row < count; ++row) solution_[row] = forces[order_[row]];
  for (std::uint32_t column = 0; column < count; ++column) {
    const Square& corner = squares_[begins_[column]];
    RealVector& x = solution_[column];
    x.x() *= corner.upper.x();
    x.y() = (x.y() - corner.lower.x() * x.x()) * corner.lower.y();
    for (std::uint32_t place = begins_[column] + 1; place < begins_[column + 1]; ++place) {
      const Square& s = squares_[place];
      solution_[rows_[place]] -= RealVector(s.upper.dot(x), s.lower.dot(x));
    }
  }
  for (std::uint32_t column = count; column-- > 0;) {
    const Square& corner = squares_[begins_[column]];
    RealVector x = solution_[column];
    for (std::uint32_t place = begins_[column] + 1; place < begins_[column + 1]; ++place) {
      const Square& s = squares_[place];
      const RealVector& later = solution_[rows_[place]];
      x -= later.x() * s.upper + later.y() * s.lower;
    }
    x.y() *= corner.lower.y();
    x.x() = (x.x() - corner.lower.x() * x.y()) * corner.upper.x();
    solution_[column] = x;
  }
  for (std::uint32_t row = 0; row < count; ++row) forces[order_[row]] = solution_[row];
}

}  // namespace rink::physics::inline RINK_PRECISION
