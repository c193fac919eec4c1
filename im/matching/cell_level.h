// The cells of one class of sizes: from a box to its cell, and from a question to the cells that can hold answers.
#pragma once

#include <cmath>
#include <cstdint>

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

  /// Never decreases with `coordinate`, rounding included: all that is relied on. Not a number (nothing times infinity) is before the first.
  std::int32_t cell(float coordinate) const {
    return static_cast<std::int32_t>(std::min(std::max(0.0f, coordinate * cells_per_metre), static_cast<float>(last)));
  }
  /// Cells whose boxes may touch [low, high].
  CellRange touched(float low, float high) const { return {cell(low - widest - margin(low)), cell(high)}; }
  /// Cells whose boxes begin after `low` and end before `high`.
  CellRange within(float low, float high) const {
    const float latest = high - widest - margin(high);
    return low < latest ? CellRange{cell(low) + 1, cell(latest) - 1} : CellRange{0, -1};
  }

 private:
  /// Bounds the rounding of a side and of a difference with it: an edge is at most `widest` (1 + e) from the other, and the difference errs by e of its size, e = 2^-24.
  float margin(float coordinate) const { return (std::abs(coordinate) + widest) * 0x1p-22f; }
};

/// A grid over the world of `count` cells at most twice as many as its boxes, stored row after row.
struct CellLevel {
  CellAxis x, y;
  std::uint32_t first_cell = 0;
  bool has_newcomers = false;  ///< a box that was nowhere before changes for every question

  std::uint32_t columns() const { return static_cast<std::uint32_t>(x.last) + 1; }
  std::uint32_t cell_count() const { return columns() * (static_cast<std::uint32_t>(y.last) + 1); }
  std::uint32_t cell(float low_x, float low_y) const {
    return first_cell + static_cast<std::uint32_t>(y.cell(low_y)) * columns() + static_cast<std::uint32_t>(x.cell(low_x));
  }
};

/// Rows as high as `boxes_per_square` boxes fill a square of, columns a fraction of it, over a world of `width` times `height` in which a box sees
/// `crowding` times the mean density around it.
CellLevel lay_out(std::size_t box_count, double width, double height, double crowding);

}  // namespace rink::im
