// Cells as linked lists in one array, which an impact within the frame may lengthen.
#include "game/physics/paper/frame_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rink::physics::paper {

void FrameGrid::clear(const Field& field, std::uint32_t count) {
  assert(field.length > 0.0 && field.width > 0.0);
  const double side = std::sqrt(field.length * field.width / std::max(1u, count));
  const auto cells_along = [&](double length) {
    return static_cast<std::uint32_t>(std::clamp(length / side, 1.0, 1e4));
  };
  columns_ = cells_along(field.length);
  rows_ = cells_along(field.width);
  columns_per_metre_ = columns_ / field.length;
  rows_per_metre_ = rows_ / field.width;
  first_.assign(std::size_t{columns_} * rows_, none);
  entries_.clear();
  asked_.assign(count, 0);
  question_ = 0;
}

/// Also for places outside and for what is not a number.
std::uint32_t FrameGrid::cell(double place, double per_metre, std::uint32_t count) {
  const double cell = place * per_metre;
  if (!(cell > 0.0)) return 0;
  return cell < count ? static_cast<std::uint32_t>(cell) : count - 1;
}

FrameGrid::Range FrameGrid::range(const Extent& box) const {
  return {cell(box.low.x(), columns_per_metre_, columns_),
          cell(box.high.x(), columns_per_metre_, columns_),
          cell(box.low.y(), rows_per_metre_, rows_), cell(box.high.y(), rows_per_metre_, rows_)};
}

void FrameGrid::insert(std::uint32_t body, const Extent& box) {
  const Range cells = range(box);
  assert(cells.right < columns_ && cells.top < rows_);
  if (body >= asked_.size()) asked_.resize(body + 1, 0);
  for (std::uint32_t row = cells.bottom; row <= cells.top; ++row)
    for (std::uint32_t column = cells.left; column <= cells.right; ++column) {
      std::uint32_t& first = first_[row * columns_ + column];
      entries_.push_back({body, first});
      first = static_cast<std::uint32_t>(entries_.size() - 1);
    }
}

}  // namespace rink::physics::paper
