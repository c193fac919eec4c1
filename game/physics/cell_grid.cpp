// Choice of the cell size; who is in which cell.
#include "game/physics/cell_grid.h"

#include <cassert>

namespace rink::physics {

namespace {

/// The last cell takes what is left, up to twice the side, so that the side does not depend on the
/// field's length.
std::vector<double> edges_of(std::uint32_t count, double side) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> edges;
  for (std::uint32_t index = 0; index < count; ++index) {
    edges.push_back(index == 0 ? -infinity : (index - 1.0 / 64.0) * side);
    edges.push_back(index + 1 == count ? infinity : (index + 1.0 + 1.0 / 64.0) * side);
  }
  return edges;
}

}  // namespace

/// Empties the grid. `reach` [m] is the longest distance along an axis at which two bodies touch.
/// Few crossings are worth many bodies in sight where the flights are long: 1.15 bodies in a cell
/// at packing 0.05, 0.9 at 0.2, the least possible cell at 0.5 and denser.
void CellGrid::rebuild(double length, double width, double reach, std::uint32_t body_max,
                       double least_cell) {
  assert(length > 0.0 && width > 0.0 && reach >= 0.0 && least_cell >= 0.0);
  const double spacing = std::sqrt(length * width / std::max(1u, body_max));
  side_ = std::max({1.2 * spacing - 0.5 * reach, least_cell, reach * (1.0 + 1.0 / 16.0),
                    std::max(length, width) / 30000.0});
  columns_ = static_cast<std::uint32_t>(std::max(1.0, std::floor(length / side_)));
  rows_ = static_cast<std::uint32_t>(std::max(1.0, std::floor(width / side_)));
  inverse_side_ = 1.0 / side_;
  column_edges_ = edges_of(columns_, side_);
  row_edges_ = edges_of(rows_, side_);
  pitch_ = columns_ + 2;
  stride_ = stride_min;
  cells_.assign((rows_ + 2) * pitch_ * stride_, 0);
  std::fill(places_.begin(), places_.end(), Place{});
}

void CellGrid::insert(std::uint32_t body, double x, double y) {
  assert(body < places_.size() && !is_listed(body));
  link(body, {static_cast<std::uint16_t>(column(x)), static_cast<std::uint16_t>(row(y))});
}

void CellGrid::widen() {
  const std::size_t count = cells_.size() / stride_;
  LargeArray<std::uint32_t> wider(2 * cells_.size());
  for (std::size_t cell = 0; cell < count; ++cell)
    std::copy_n(&cells_[cell * stride_], stride_, &wider[cell * 2 * stride_]);
  cells_ = std::move(wider);
  stride_ *= 2;
}

}  // namespace rink::physics
