// Cells for boxes, a grid for each class of sizes: from a box to its cell, and from a question to
// the cells that can hold answers.
#pragma once

#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "im/matching/index/size_levels.h"
#include "im/matching/projection.h"

namespace rink::im {

/// A closed range of columns or rows; empty if first > last.
struct CellRange {
  std::int32_t first, last;
  bool is_empty() const { return first > last; }
};

/// Cells along one axis; those at the rim reach to infinity. A box is in the cell of its low edge.
struct CellAxis {
  float cells_per_metre = 0.0f;
  std::int32_t last = 0;
  float widest = 0.0f;  ///< longest side of the boxes in the cells [m]
  float drift = 0.0f;   ///< how far a box may be from where it was when it got its cell [m]

  /// Never decreases with `coordinate`, rounding included: all that is relied on. Not a number
  /// (nothing times infinity) is before the first.
  std::int32_t cell(float coordinate) const {
    return static_cast<std::int32_t>(
        std::min(std::max(0.0f, coordinate * cells_per_metre), static_cast<float>(last)));
  }
  /// Cells whose boxes may touch [low, high].
  CellRange touched(float low, float high) const {
    return {cell(low - widest - drift - margin(low)), cell(high + drift + drift_margin(high))};
  }
  /// Cells whose boxes begin after `low` and end before `high`.
  CellRange within(float low, float high) const {
    const float earliest = low + drift + drift_margin(low),
                latest = high - widest - drift - margin(high);
    return earliest < latest ? CellRange{cell(earliest) + 1, cell(latest) - 1} : CellRange{0, -1};
  }
  /// Below and above all edges in a cell and what reaches out of it.
  float lowest_in(std::int32_t cell) const {
    assert(0 <= cell && cell <= last);
    return cell == 0
               ? -std::numeric_limits<float>::infinity()
               : static_cast<float>(cell) / cells_per_metre * (1.0f - 0x1p-20f) - drift * 1.01f;
  }
  float highest_in(std::int32_t cell) const {
    assert(0 <= cell && cell <= last);
    return cell == last ? std::numeric_limits<float>::infinity()
                        : (static_cast<float>(cell) + 1.0f) / cells_per_metre * (1.0f + 0x1p-20f) +
                              (widest + drift) * 1.01f;
  }

 private:
  /// Bounds the rounding of a side and of a difference with it: an edge is at most `widest` (1 + e)
  /// from the other, and the difference errs by e of its size, e = 2^-24. A drift is a sum of at
  /// most a hundred differences, each rounded, and stays below a cell, so that it errs by less than
  /// 2^-16 of itself.
  float margin(float coordinate) const {
    return (std::abs(coordinate) + widest + drift) * 0x1p-22f + drift * 0x1p-16f;
  }
  /// Nothing where nobody drifted: then cells are exact.
  float drift_margin(float coordinate) const { return drift > 0.0f ? margin(coordinate) : 0.0f; }
};

/// A grid over the world, row after row.
struct CellLevel {
  CellAxis x, y;
  std::uint32_t first_cell = 0;
  bool has_newcomers = false;  ///< a box that was nowhere before changes for every question

  /// Lets it hold a box of this size.
  void widen(const FloatBox& box) {
    x.widest = std::max(x.widest, box.high_x - box.low_x);
    y.widest = std::max(y.widest, box.high_y - box.low_y);
  }
  std::uint32_t columns() const { return static_cast<std::uint32_t>(x.last) + 1; }
  std::uint32_t cell_count() const { return columns() * (static_cast<std::uint32_t>(y.last) + 1); }
  std::uint32_t cell(float low_x, float low_y) const {
    return first_cell + static_cast<std::uint32_t>(y.cell(low_y)) * columns() +
           static_cast<std::uint32_t>(x.cell(low_x));
  }
};

/// How many boxes cells hold. Where boxes are, a square as high as a row holds `boxes_per_square`
/// and is cut into `columns_per_row` cells.
struct CellShape {
  double boxes_per_square, columns_per_row, cells_per_box_max;
};

/// The classes of size of many boxes and the cells of each.
class CellLevels {
 public:
  /// For boxes whose sides were counted in `sizes`. How they crowd is taken from a sample of
  /// `boxes`.
  void choose(SizeLevels& sizes, std::span<const FloatBox> boxes, const Region& world,
              const CellShape& shape);

  std::size_t size() const { return levels_.size(); }
  std::uint32_t cell_count() const {
    assert(!levels_.empty());  // `choose` was called
    return levels_.back().first_cell + levels_.back().cell_count();
  }
  CellLevel& operator[](std::size_t i) { return levels_[i]; }
  CellLevel& of(const SizeLevels& sizes, const FloatBox& box) {
    return levels_[levels_.size() == 1 ? 0 : sizes.level(longer_side(box))];
  }
  /// Of one level.
  void replace_only(const CellLevel& level) {
    assert(levels_.size() == 1 && level.cell_count() == levels_[0].cell_count());
    levels_[0] = level;
  }
  /// Asserts that the cells of the levels follow each other and are of a positive size.
  void check() const;
  auto begin() const { return levels_.begin(); }
  auto end() const { return levels_.end(); }
  const CellLevel& operator[](std::size_t i) const { return levels_[i]; }

 private:
  std::vector<CellLevel> levels_;
};

/// The cells of a level that a question must look at: `columns` of `rows`, but not those that are
/// in both `inner_columns` and `inner_rows`.
struct CellQuery {
  CellRange columns, rows, inner_columns{0, -1}, inner_rows{0, -1};
  bool has_inner(std::int32_t row) const {
    return !inner_columns.is_empty() && inner_rows.first <= row && row <= inner_rows.last;
  }

  /// Calls `visit(row, first, last)` with closed ranges of columns.
  template <class Visit>
  void for_each_part(const Visit& visit) const {
    for (std::int32_t row = rows.first; row <= rows.last; ++row) {
      if (has_inner(row)) {
        assert(columns.first <= inner_columns.first && inner_columns.last <= columns.last);
        if (columns.first < inner_columns.first) visit(row, columns.first, inner_columns.first - 1);
        if (inner_columns.last < columns.last) visit(row, inner_columns.last + 1, columns.last);
      } else {
        visit(row, columns.first, columns.last);
      }
    }
  }
  /// Calls `visit(first, last)` with closed ranges of adjacent cells of `level`.
  template <class Visit>
  void for_each_run(const CellLevel& level, const Visit& visit) const {
    for_each_part([&](std::int32_t row, std::int32_t first, std::int32_t last) {
      const std::uint32_t cell =
          level.first_cell + static_cast<std::uint32_t>(row) * level.columns();
      visit(cell + static_cast<std::uint32_t>(first), cell + static_cast<std::uint32_t>(last));
    });
  }
};

/// Where boxes may overlap `box`.
inline CellQuery cells_touched(const CellLevel& level, const FloatBox& box) {
  return {level.x.touched(box.low_x, box.high_x), level.y.touched(box.low_y, box.high_y)};
}

/// Where boxes may have an overlap that changed, of those whose places then and now are all within
/// `hull` and all hold `core`. Boxes well inside of that overlap then and now.
inline CellQuery cells_changed(const CellLevel& level, const FloatBox& hull, const FloatBox& core) {
  CellQuery query = cells_touched(level, hull);
  if (level.has_newcomers) return query;
  query.inner_columns = level.x.within(core.low_x, core.high_x);
  query.inner_rows = level.y.within(core.low_y, core.high_y);
  return query;
}

}  // namespace rink::im
