// Counting sort by cell; a query looks at the cells that its area, grown by the largest entity,
// touches.
#include "loadgen/measure/truth/surroundings.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

#include "im/basics/checked.h"

namespace rink::loadgen {
namespace {

constexpr double cells_per_side_max = 256.0;

}  // namespace

std::uint32_t clamped_cell(double cell, std::uint32_t count) {
  assert(count > 0);
  return static_cast<std::uint32_t>(
      std::clamp(std::floor(cell), 0.0, static_cast<double>(count - 1)));
}

Surroundings::Surroundings(const RelevanceArea& area, double length, double width) : area_(area) {
  assert(area.reach >= 0.0 && length > 0.0 && width > 0.0);
  cell_ = std::max({0.5 * area.reach, length / cells_per_side_max, width / cells_per_side_max});
  columns_ = std::max(1u, static_cast<std::uint32_t>(std::ceil(length / cell_)));
  rows_ = std::max(1u, static_cast<std::uint32_t>(std::ceil(width / cell_)));
}

std::uint32_t Surroundings::column(double x) const { return clamped_cell(x / cell_, columns_); }
std::uint32_t Surroundings::row(double y) const { return clamped_cell(y / cell_, rows_); }

void Surroundings::build(std::span<const Placed> placed) {
  begins_.assign(std::size_t{columns_} * rows_ + 1, 0);
  cell_of_.resize(placed.size());
  sorted_.resize(placed.size());
  farthest_ = 0.0;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    cell_of_[i] = row(placed[i].centre.y()) * columns_ + column(placed[i].centre.x());
    ++begins_[cell_of_[i] + 1];
    farthest_ = std::max({farthest_, placed[i].half_extent.x(), placed[i].half_extent.y()});
  }
  for (std::size_t cell = 1; cell < begins_.size(); ++cell) begins_[cell] += begins_[cell - 1];
  for (std::size_t i = 0; i < placed.size(); ++i) sorted_[begins_[cell_of_[i]]++] = placed[i];
  for (std::size_t cell = begins_.size() - 1; cell > 0; --cell) begins_[cell] = begins_[cell - 1];
  begins_[0] = 0;
  if constexpr (checks_whole_structures) check();
}

void Surroundings::check() const {
  assert(begins_.size() == std::size_t{columns_} * rows_ + 1 && begins_.front() == 0);
  assert(std::ranges::is_sorted(begins_) && begins_.back() == sorted_.size());
  for (std::size_t cell = 0; cell + 1 < begins_.size(); ++cell)
    for (std::size_t i = begins_[cell]; i < begins_[cell + 1]; ++i)
      assert(row(sorted_[i].centre.y()) * columns_ + column(sorted_[i].centre.x()) == cell);
}

void Surroundings::find(const Vector2& bat, std::uint32_t own, std::vector<Relevant>& found) const {
  found.clear();
  const double range = area_.reach + farthest_;
  const std::uint32_t first = column(bat.x() - range), last = column(bat.x() + range);
  for (std::uint32_t y = row(bat.y() - range); y <= row(bat.y() + range); ++y)
    for (std::size_t i = begins_[y * columns_ + first]; i < begins_[y * columns_ + last + 1]; ++i) {
      const double within = depth(area_, bat, sorted_[i].centre, sorted_[i].half_extent);
      if (within >= 0.0 && sorted_[i].entity != own) found.push_back({sorted_[i].entity, within});
    }
  std::sort(found.begin(), found.end(),
            [](const Relevant& a, const Relevant& b) { return a.entity < b.entity; });
  assert(std::ranges::adjacent_find(found, std::equal_to<>(), &Relevant::entity) == found.end());
}

}  // namespace rink::loadgen
