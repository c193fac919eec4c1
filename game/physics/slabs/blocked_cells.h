// Where in a tile nothing more happens.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "game/physics/grid/cell_grid.h"
#include "game/physics/grid/cell_lists.h"
#include "game/physics/real.h"
#include "game/physics/slabs/tiling.h"

namespace rink::physics::inline RINK_PRECISION {

enum class Blocked : std::uint8_t { for_nobody, for_impacts, for_all };

/// The cells of one tile.
class BlockedCells {
 public:
  /// Those of another tile: closes the cells next to which another one plays, and to impacts those
  /// next to which it may have put one off, up to `radius` of them along each edge.
  void open(const CellRange& range, const CellGrid& grid, int radius);
  /// As far as they are in the tile.
  void block(const CellRange& cells, Blocked whom);
  void block_all(const CellBlock& cells, Blocked whom) {
    block({static_cast<int>(cells.column_low), static_cast<int>(cells.row_low),
           static_cast<int>(cells.column_high) + 1, static_cast<int>(cells.row_high) + 1},
          whom);
  }
  /// The cell for all, and those around it for impacts.
  void block_around(const CellGrid::Place& place, int radius);

  const CellRange& range() const { return range_; }
  /// How many there are.
  std::size_t count() const { return blocked_.size(); }
  bool has(const CellGrid::Place& place) const {
    return static_cast<std::uint32_t>(place.column - range_.first_column) < range_.columns() &&
           static_cast<std::uint32_t>(place.row - range_.first_row) < range_.rows();
  }
  /// For what `place` is blocked; for all where it is not in the tile.
  [[gnu::always_inline]] Blocked at(const CellGrid::Place& place) const {
    const auto column = static_cast<std::uint32_t>(place.column - range_.first_column),
               row = static_cast<std::uint32_t>(place.row - range_.first_row);
    return column < range_.columns() && row < range_.rows()
               ? blocked_[row * range_.columns() + column]
               : Blocked::for_all;
  }
  /// Whether all of them are in the tile, and blocked for nobody.
  bool are_open(const CellBlock& cells) const;

 private:
  void close_edges(const CellGrid& grid, int width, Blocked whom);

  CellRange range_{};
  std::vector<Blocked> blocked_;  // by cell of the range
};

}  // namespace rink::physics::inline RINK_PRECISION
