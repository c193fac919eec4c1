// Choice of the cell size.
#include "game/physics/cell_grid.h"

namespace rink::physics {

/// Empties the grid. At packing 0.2 (0.05) one body in two cells needs 17 % (0 %) less time than one per cell, 40 % (35 %) less than two. `reach` [m] is the longest
/// distance along an axis at which two bodies touch.
void CellGrid::rebuild(double length, double width, double reach, std::uint32_t body_max, double least_cell) {
  const double wanted = std::max({0.75 * std::sqrt(length * width / std::max(1u, body_max)), least_cell, reach * (1.0 + 1.0 / 16.0), std::max(length, width) / 30000.0});
  columns_ = static_cast<std::uint32_t>(std::max(1.0, std::floor(length / wanted)));
  rows_ = static_cast<std::uint32_t>(std::max(1.0, std::floor(width / wanted)));
  side_ = std::max(length / columns_, width / rows_);
  inverse_side_ = 1.0 / side_;
  margin_ = side_ / 64.0;
  heads_.assign(std::size_t{columns_} * rows_, none);
  std::fill(cell_.begin(), cell_.end(), none);
}

}  // namespace rink::physics
