// Finds each body's neighbours once, however many players they matter to.
#include "loadgen/measure/truth/encounters.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <functional>

#include "im/basics/checked.h"

namespace rink::loadgen {

std::uint32_t Encounters::column(double x) const { return clamped_cell(x / cell_, columns_); }
std::uint32_t Encounters::row(double y) const { return clamped_cell(y / cell_, rows_); }

void Encounters::choose_cells(std::span<const Reaching> bodies) {
  const auto count = static_cast<double>(std::max<std::size_t>(1, bodies.size()));
  assert(length_ > 0.0 && width_ > 0.0);
  cell_ = std::sqrt(length_ * width_ / count);
  columns_ = std::max(1u, static_cast<std::uint32_t>(std::ceil(length_ / cell_)));
  rows_ = std::max(1u, static_cast<std::uint32_t>(std::ceil(width_ / cell_)));
  double sum = 0.0;
  for (const Reaching& body : bodies) sum += body.around;
  wide_from_ = 2.0 * sum / count;
  narrow_max_ = 0.0;
  for (const Reaching& body : bodies)
    if (body.around <= wide_from_) narrow_max_ = std::max(narrow_max_, body.around);
}

void Encounters::build(std::span<const Reaching> bodies) {
  assert(std::ranges::is_sorted(bodies, std::less<>(), &Reaching::entity));
  choose_cells(bodies);
  const std::uint32_t wide = columns_ * rows_;  // the last bin
  begins_.assign(wide + 2, 0);
  bodies_.assign(bodies.begin(), bodies.end());
  cell_of_.resize(bodies.size()), sorted_.resize(bodies.size()), listed_.resize(bodies.size() + 1);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    cell_of_[i] = bodies[i].around > wide_from_
                      ? wide
                      : row(bodies[i].centre.y()) * columns_ + column(bodies[i].centre.x());
    ++begins_[cell_of_[i] + 1];
  }
  for (std::size_t cell = 1; cell < begins_.size(); ++cell) begins_[cell] += begins_[cell - 1];
  words_ = (bodies.size() + word_bits - 1) / word_bits;
  pucks_.assign(words_, 0);
  if (!bodies.empty() && bodies.back().entity >= index_of_.size())
    index_of_.resize(bodies.back().entity + 1);
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    sorted_[begins_[cell_of_[i]]++] = {bodies[i].centre.x(), bodies[i].centre.y(), bodies[i].around,
                                       i};
    index_of_[bodies[i].entity] = i;
    if (bodies[i].is_puck) pucks_[i / word_bits] |= Word{1} << i % word_bits;
  }
  for (std::size_t cell = begins_.size() - 1; cell > 0; --cell) begins_[cell] = begins_[cell - 1];
  begins_[0] = 0;
  near_row_.assign(bodies.size(), 0);
  near_rows_ = 0;
  if constexpr (checks_whole_structures) check();
}

void Encounters::check() const {
  assert(begins_.size() == std::size_t{columns_} * rows_ + 2 && begins_.front() == 0);
  assert(std::ranges::is_sorted(begins_) && begins_.back() == sorted_.size());
  assert(sorted_.size() == bodies_.size() && cell_of_.size() == bodies_.size());
  std::vector<bool> is_binned(bodies_.size());
  for (std::size_t cell = 0; cell + 1 < begins_.size(); ++cell)
    for (std::size_t i = begins_[cell]; i < begins_[cell + 1]; ++i) {
      assert(cell_of_[sorted_[i].index] == cell && !is_binned[sorted_[i].index]);
      is_binned[sorted_[i].index] = true;
    }
  assert(std::ranges::all_of(bodies_, [this](const Reaching& each) {
    return is_there(each.entity) && each.around >= 0.0;
  }));
}

/// Without a branch that chance decides.
void Encounters::add_near(const Reaching& body, std::uint32_t first, std::uint32_t last) {
  const double x = body.centre.x(), y = body.centre.y(), around = body.around;
  std::size_t count = listed_count_;
  for (std::uint32_t i = first; i < last; ++i) {
    const Disc& disc = sorted_[i];
    const double dx = disc.x - x, dy = disc.y - y, reach = around + disc.around;
    listed_[count] = disc.index;
    count += dx * dx + dy * dy <= reach * reach ? 1u : 0u;
  }
  listed_count_ = count;
  assert(first <= last && count <= bodies_.size());
}

/// The neighbours as bits, since unions of 30 are formed for each player: merging lists took twice
/// as long.
const Encounters::Word* Encounters::near(std::uint32_t index) {
  if (near_row_[index] != 0) return near_.data() + (near_row_[index] - 1) * words_;
  near_row_[index] = ++near_rows_;
  if (near_.size() < near_rows_ * words_) near_.resize(2 * near_rows_ * words_);
  const Reaching& own = bodies_[index];
  const Vector2 centre = own.centre;
  const double range = own.around + narrow_max_;
  const std::uint32_t top = row(centre.y() + range);
  listed_count_ = 0;
  for (std::uint32_t y = row(centre.y() - range); y <= top; ++y) {
    // The rim's rows hold what lies beyond them as well.
    const double below = y * cell_ - centre.y(), above = centre.y() - (y + 1) * cell_;
    const double off =
        std::min(range, std::max({0.0, y > 0 ? below : 0.0, y + 1 < rows_ ? above : 0.0}));
    const double half = std::sqrt(range * range - off * off);
    add_near(own, begins_[y * columns_ + column(centre.x() - half)],
             begins_[y * columns_ + column(centre.x() + half) + 1]);
  }
  add_near(own, begins_[columns_ * rows_], begins_[columns_ * rows_ + 1]);
  Word* const near = near_.data() + (near_rows_ - 1) * words_;
  std::fill_n(near, words_, Word{0});
  for (std::size_t i = 0; i < listed_count_; ++i)
    near[listed_[i] / word_bits] |= Word{1} << listed_[i] % word_bits;
  near[index / word_bits] &= ~(Word{1} << index % word_bits);
  return near;
}

void Encounters::find(std::uint32_t own, std::vector<Relevant>& found) {
  assert(is_there(own));
  const std::uint32_t bat = index_of_[own];
  const Word* const direct = near(bat);
  found_.assign(direct, direct + words_);
  for (std::size_t word = 0; word < words_; ++word)
    for (Word left = near(bat)[word] & pucks_[word]; left != 0;
         left &= left - 1) {  // near() again: another's may have moved the rows
      const Word* const other = near(static_cast<std::uint32_t>(word) * word_bits +
                                     static_cast<std::uint32_t>(std::countr_zero(left)));
      for (std::size_t i = 0; i < words_; ++i) found_[i] |= other[i];
    }
  found_[bat / word_bits] &= ~(Word{1} << bat % word_bits);
  found.clear();
  for (std::size_t word = 0; word < words_; ++word)
    for (Word left = found_[word]; left != 0; left &= left - 1)
      found.push_back(
          {bodies_[word * word_bits + static_cast<std::size_t>(std::countr_zero(left))].entity,
           0.0});
}

Encounters::Way Encounters::way(std::uint32_t own, std::uint32_t entity) const {
  const auto depth = [](const Reaching& a, const Reaching& b) {
    return a.around + b.around - (a.centre - b.centre).norm();
  };
  assert(is_there(own) && is_there(entity));
  Way deepest{depth(body(own), body(entity)), std::nullopt};
  for (const Reaching& each : bodies_) {
    if (!each.is_puck || each.entity == own || each.entity == entity) continue;
    const double through = std::min(depth(body(own), each), depth(each, body(entity)));
    if (through > deepest.depth) deepest = {through, each.entity};
  }
  return deepest;
}

}  // namespace rink::loadgen
