// How a pass divides the field into tiles.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "game/physics/grid/cell_grid.h"
#include "game/physics/grid/cell_lists.h"
#include "game/physics/grid/wide_bodies.h"

namespace rink::physics {

/// Columns and rows of cells, the end excluded.
struct CellRange {
  int first_column, first_row, end_column, end_row;

  std::uint32_t columns() const { return static_cast<std::uint32_t>(end_column - first_column); }
  std::uint32_t rows() const { return static_cast<std::uint32_t>(end_row - first_row); }
};

/// Where a body stands: its cell, or all cells of a wide one.
inline CellBlock cells_of(const CellGrid& grid, std::uint32_t body) {
  assert(grid.is_listed(body));
  const CellGrid::Place place = grid.place(body);
  if (!grid.is_in_one_cell(body)) return grid.wide()[place.column - grid.columns()].block;
  return {place.column, place.row, place.column, place.row};
}

/// Division of many small numbers by the same one, by a product.
class Divider {
 public:
  explicit Divider(std::uint32_t divisor)
      : divisor_(divisor), inverse_((std::uint64_t{1} << 32) / divisor + 1) {
    assert(divisor >= 1 && divisor <= 0x7fff);
  }
  /// The quotient, rounded down, of a number up to 0x1ffff.
  std::uint32_t operator()(std::uint32_t number) const {
    return static_cast<std::uint32_t>(number * inverse_ >> 32);
  }
  std::uint32_t divisor() const { return divisor_; }

 private:
  std::uint32_t divisor_;
  std::uint64_t inverse_;
};

/// Square tiles, numbered row by row. The first ones begin some cells before the field does.
class Tiling {
 public:
  struct Shift {
    std::uint32_t columns = 0, rows = 0;
  };

  /// Tiles of `side` by `side` cells.
  Tiling(const CellGrid& grid, std::uint32_t side, Shift shift)
      : columns_(grid.columns()),
        rows_(grid.rows()),
        shift_(shift),
        divided_(side),
        across_(divided_(columns_ + shift.columns + side - 1)),
        along_(divided_(rows_ + shift.rows + side - 1)) {
    assert(shift.columns < side && shift.rows < side);
  }

  std::uint32_t count() const { return across_ * along_; }
  /// The number of the tile that a cell of the field is in.
  std::uint32_t tile_of(std::uint32_t column, std::uint32_t row) const {
    assert(column < columns_ && row < rows_);
    return divided_(row + shift_.rows) * across_ + divided_(column + shift_.columns);
  }
  /// Calls `visit(tile)` for each that has some of the cells.
  template <class Visit>
  void visit_with(const CellBlock& cells, Visit&& visit) const {
    const std::uint32_t first = tile_of(cells.column_low, cells.row_low),
                        last = tile_of(cells.column_high, cells.row_high),
                        width = last % across_ - first % across_;
    for (std::uint32_t row = first; row <= last - width; row += across_)
      for (std::uint32_t tile = row; tile <= row + width; ++tile) visit(tile);
  }
  /// As far as it is on the field.
  CellRange cells_of(std::uint32_t tile) const {
    assert(tile < count());
    const auto side = static_cast<int>(divided_.divisor());
    const int column = static_cast<int>(tile % across_) * side - static_cast<int>(shift_.columns),
              row = static_cast<int>(tile / across_) * side - static_cast<int>(shift_.rows);
    return {std::max(0, column), std::max(0, row),
            std::min(static_cast<int>(columns_), column + side),
            std::min(static_cast<int>(rows_), row + side)};
  }

 private:
  std::uint32_t columns_, rows_;  // of the field
  Shift shift_;
  Divider divided_;  // by the side of a tile
  std::uint32_t across_, along_;
};

}  // namespace rink::physics
