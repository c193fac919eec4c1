// Edges and blocks of cells.
#include "game/physics/slabs/blocked_cells.h"

namespace rink::physics::inline RINK_PRECISION {

void BlockedCells::open(const CellRange& range, const CellGrid& grid, int radius) {
  assert(radius >= 0);
  range_ = range;
  blocked_.assign(std::size_t{range.columns()} * range.rows(), Blocked::for_nobody);
  close_edges(grid, 1, Blocked::for_all);
  close_edges(grid, radius, Blocked::for_impacts);
}

/// Closes `width` cells along each edge that is not the field's.
void BlockedCells::close_edges(const CellGrid& grid, int width, Blocked whom) {
  const auto& [first_column, first_row, end_column, end_row] = range_;
  const int columns = static_cast<int>(grid.columns()), rows = static_cast<int>(grid.rows());
  if (first_column > 0) block({first_column, first_row, first_column + width, end_row}, whom);
  if (end_column < columns) block({end_column - width, first_row, end_column, end_row}, whom);
  if (first_row > 0) block({first_column, first_row, end_column, first_row + width}, whom);
  if (end_row < rows) block({first_column, end_row - width, end_column, end_row}, whom);
}

void BlockedCells::block_around(const CellGrid::Place& place, int radius) {
  block({place.column - radius, place.row - radius, place.column + radius + 1,
         place.row + radius + 1},
        Blocked::for_impacts);
  block({place.column, place.row, place.column + 1, place.row + 1}, Blocked::for_all);
}

void BlockedCells::block(const CellRange& cells, Blocked whom) {
  const int first_column = std::max(range_.first_column, cells.first_column),
            end_column = std::min(range_.end_column, cells.end_column),
            end_row = std::min(range_.end_row, cells.end_row);
  for (int row = std::max(range_.first_row, cells.first_row); row < end_row; ++row) {
    Blocked* const of_row =
        &blocked_[static_cast<std::uint32_t>(row - range_.first_row) * range_.columns()];
    for (int column = first_column; column < end_column; ++column) {
      Blocked& cell = of_row[column - range_.first_column];
      cell = std::max(cell, whom);
    }
  }
}

bool BlockedCells::are_open(const CellBlock& cells) const {
  for (std::uint32_t row = cells.row_low; row <= cells.row_high; ++row)
    for (std::uint32_t column = cells.column_low; column <= cells.column_high; ++column)
      if (at({static_cast<std::uint16_t>(column), static_cast<std::uint16_t>(row)}) !=
          Blocked::for_nobody)
        return false;
  return true;
}

}  // namespace rink::physics::inline RINK_PRECISION
