// Lists of numbers, one list for each cell of a field, side by side in memory.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "game/physics/large_pages.h"
#include "game/physics/prefetch.h"

namespace rink::physics {

/// Cells from one to another, both included.
struct CellBlock {
  std::uint32_t column_low, row_low, column_high, row_high;

  bool holds(std::uint32_t column, std::uint32_t row) const {
    return column_low <= column && column <= column_high && row_low <= row && row <= row_high;
  }
  bool overlaps(const CellBlock& other) const {
    return column_low <= other.column_high && other.column_low <= column_high &&
           row_low <= other.row_high && other.row_low <= row_high;
  }
  /// Those of its cells that `other` lacks: the same block, one column or row away.
  CellBlock beyond(const CellBlock& other) const {
    CellBlock strip = *this;
    if (column_high > other.column_high) strip.column_low = column_high;
    else if (column_low < other.column_low) strip.column_high = column_low;
    else if (row_high > other.row_high) strip.row_low = row_high;
    else strip.row_high = row_low;
    return strip;
  }
};

/// A frame of empty cells around the field spares every question where it ends: to collect a
/// neighbourhood takes no branch that depends on who is there. Cells are numbered; their numbers
/// hold until the next restart().
class CellLists {
 public:
  /// The sides of a cell, as one leaves it.
  enum Direction : std::uint8_t { left, right, down, up };

  /// All are empty.
  void restart(std::uint32_t columns, std::uint32_t rows);

  std::size_t at(std::uint32_t column, std::uint32_t row) const {
    return (row + std::size_t{1}) * pitch_ + column + 1;
  }
  std::size_t neighbour(std::size_t cell, Direction direction) const {
    const std::size_t step = direction <= right ? 1 : pitch_;
    return (direction & 1) != 0 ? cell + step : cell - step;
  }

  void add(std::size_t cell, std::uint32_t number) {
    if (!has_room(cell)) widen();
    std::uint32_t* list = &lists_[cell * stride_];
    list[++list[0]] = number;
  }
  /// It must be there.
  void remove(std::size_t cell, std::uint32_t number) {
    std::uint32_t* list = &lists_[cell * stride_];
    std::uint32_t* place = list + 1;
    while (*place != number) ++place;
    assert(place <= list + list[0]);
    *place = list[list[0]--];
  }
  /// Whether add() would leave all lists where they are in memory.
  bool has_room(std::size_t cell) const { return lists_[cell * stride_] + 1 < stride_; }
  std::span<const std::uint32_t> operator[](std::size_t cell) const {
    return {&lists_[cell * stride_ + 1], lists_[cell * stride_]};
  }
  /// Calls `visit(number)` for each in those cells of the field.
  template <class Visit>
  void visit(const CellBlock& cells, Visit&& visit) const {
    const std::size_t stride = stride_;  // or it would be read anew after each visit
    for (std::uint32_t row = cells.row_low; row <= cells.row_high; ++row) {
      const std::uint32_t* list = &lists_[at(cells.column_low, row) * stride];
      for (std::uint32_t column = cells.column_low; column <= cells.column_high;
           ++column, list += stride)
        for (const std::uint32_t number : std::span(list + 1, *list)) visit(number);
    }
  }

  /// Room that the next three need, or more.
  std::uint32_t collected_max() const { return collected_max_; }
  void require_room(std::uint32_t collected) {
    collected_max_ = std::max(collected_max_, collected);
  }
  /// Copies the numbers in the nine cells around one to `list`, and returns how many.
  std::uint32_t collect_nine(std::size_t middle, std::uint32_t* list) const {
    const std::size_t stride = stride_, pitch = pitch_ * stride;
    const std::uint32_t* const from = &lists_[middle * stride];
    std::uint32_t* end = append_row(from - pitch, stride, list);
    end = append_row(from, stride, end);
    end = append_row(from + pitch, stride, end);
    return static_cast<std::uint32_t>(end - list);
  }
  /// Those in a cell, then those in the four of its neighbours that have higher numbers: of two
  /// neighbours, one so lists the other's.
  std::uint32_t collect_onwards(std::size_t cell, std::uint32_t* list) const {
    const std::size_t stride = stride_, pitch = pitch_ * stride;
    const std::uint32_t* const from = &lists_[cell * stride];
    std::uint32_t* end = append(from + stride, append(from, list));
    end = append_row(from + pitch, stride, end);
    return static_cast<std::uint32_t>(end - list);
  }
  /// Those in a cell and the two beside it as seen in the direction.
  std::uint32_t collect_three(std::size_t middle, Direction direction, std::uint32_t* list) const {
    const std::size_t across = (direction <= right ? pitch_ : 1) * stride_;
    const std::uint32_t* const from = &lists_[middle * stride_];
    return static_cast<std::uint32_t>(
        append(from + across, append(from, append(from - across, list))) - list);
  }

  /// Ask the processor to fetch a cell, or what collect_nine() and collect_three() would read.
  void prefetch(std::size_t cell) const { physics::prefetch(&lists_[cell * stride_]); }
  void prefetch_nine(std::size_t middle) const {
    for (const std::size_t row : {middle - pitch_, middle, middle + pitch_})
      prefetch(row - 1), prefetch(row + 1);
  }
  void prefetch_three(std::size_t middle, Direction direction) const {
    const std::size_t across = direction <= right ? pitch_ : 1;
    prefetch(middle - across), prefetch(middle), prefetch(middle + across);
  }

 private:
  static constexpr std::uint32_t few = 7, stride_min = few + 1;

  std::uint32_t room_for_nine() const { return 9 * stride_ + few; }
  // Where lists begin is handed in: what is written might be stride_, for all that the compiler
  // knows, which would be read anew for each.
  static std::uint32_t* append(const std::uint32_t* from, std::uint32_t* list) {
    const std::uint32_t count = from[0];
    std::memcpy(list, from + 1, few * sizeof *from);  // places at once, taken or not
    if (count > few) [[unlikely]]
      std::copy_n(from + 1 + few, count - few, list + few);
    return list + count;
  }
  /// A cell and those to its left and right.
  static std::uint32_t* append_row(const std::uint32_t* from, std::size_t stride,
                                   std::uint32_t* list) {
    return append(from + stride, append(from, append(from - stride, list)));
  }
  void widen();

  // A list is how many there are followed by them, stride_ - 1 at most; the stride grows with the
  // longest.
  LargeArray<std::uint32_t> lists_ = LargeArray<std::uint32_t>(9 * stride_min);
  std::uint32_t stride_ = stride_min, collected_max_ = 0;
  std::size_t pitch_ = 3;
};

}  // namespace rink::physics
