// Bodies wider than the cells of a grid: in which cells each of them stands, and where it leaves
// them.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <vector>

#include "game/physics/grid/cell_lists.h"

namespace rink::physics {

/// A wide body stands in every cell of a block where the centre of a small one may be that touches
/// it. The block has one column and row more than that takes, so that it moves, by one column or
/// row, but once per side of a cell. Each has a slot, which is free again when it leaves.
class WideBodies {
 public:
  struct Wide {
    std::uint32_t body;
    CellBlock block;
    double half_width, half_height;  ///< what the block must hold around the centre [m]
  };
  /// In the slots of a grid's cells there are 16 bits for them and for columns.
  static constexpr std::uint32_t slot_max = 32'000;

  /// Nobody stands anywhere in a field of so many cells.
  void restart(double side, std::uint32_t columns, std::uint32_t rows);
  /// Around `x` and `y` [m]; returns the slot.
  std::uint32_t add(const Wide& wide_without_block, double x, double y);
  void remove(std::uint32_t slot);
  void move(std::uint32_t slot, CellLists::Direction direction);

  /// Whether that would leave all lists of slots where they are in memory.
  bool has_room_beyond(std::uint32_t slot, CellLists::Direction direction) const;

  std::uint32_t count() const { return count_; }
  const Wide& operator[](std::uint32_t slot) const { return wides_[slot]; }
  /// Where the centre leaves the block to the left, right, down and up [m]; infinite at the rim.
  std::array<double, 4> edges(std::uint32_t slot) const;

  /// Whether `holds(body)` of any.
  template <class Holds>
  bool has(Holds&& holds) const {
    return std::any_of(wides_.begin(), wides_.end(),
                       [&](const Wide& wide) { return wide.body != nobody && holds(wide.body); });
  }
  /// Calls `visit(wide)` for each that stands in one cell.
  template <class Visit>
  void visit_in(std::uint32_t column, std::uint32_t row, Visit&& visit) const {
    for (const std::uint32_t slot : slots_[slots_.at(column, row)]) visit(wides_[slot]);
  }
  /// Once for each that stands in any of them: where its block and `cells` have their lowest cell
  /// in common.
  template <class Visit>
  void visit_in(const CellBlock& cells, Visit&& visit) const {
    if (count_ == 0) return;
    for (std::uint32_t row = cells.row_low; row <= cells.row_high; ++row)
      for (std::uint32_t column = cells.column_low; column <= cells.column_high; ++column)
        visit_in(column, row, [&](const Wide& wide) {
          if (column == std::max(cells.column_low, wide.block.column_low) &&
              row == std::max(cells.row_low, wide.block.row_low))
            visit(wide);
        });
  }

 private:
  static constexpr std::uint32_t nobody = 0xffffffff;

  void enter(std::uint32_t slot, const CellBlock& cells);
  void leave(std::uint32_t slot, const CellBlock& cells);

  CellLists slots_;
  std::vector<Wide> wides_;
  std::vector<std::uint32_t> free_;
  double side_ = 1.0;
  std::uint32_t count_ = 0, columns_ = 1, rows_ = 1;
};

/// The block one column or row further.
CellBlock moved(CellBlock block, CellLists::Direction direction);
/// The way back.
constexpr CellLists::Direction opposite(CellLists::Direction direction) {
  return static_cast<CellLists::Direction>(direction ^ 1);
}

}  // namespace rink::physics
