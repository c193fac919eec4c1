// A uniform grid of square cells over the field: which bodies are near each other, and nothing
// else.
#pragma once

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "game/physics/large_pages.h"

namespace rink::physics {

/// Bodies are listed by the cell of their centre. A body may leave its cell by `margin` before it
/// is moved to the next, so that rounding at an edge never matters and nobody flickers; cells are
/// therefore wider than the longest reach by two margins. Each cell holds its bodies side by side,
/// and a frame of empty cells around the field spares every question where it ends: to collect a
/// neighbourhood takes no branch that depends on who is there.
class CellGrid {
 public:
  static constexpr std::uint32_t none = 0xffffffff;
  /// The sides of a cell, as a body leaves it.
  enum Direction : std::uint8_t { left, right, down, up };
  struct alignas(4) Place {
    std::uint16_t column = 0xffff, row = 0xffff;
  };

  void rebuild(double length, double width, double reach, std::uint32_t body_max,
               double least_cell);
  void resize(std::uint32_t count) { places_.resize(count); }

  void insert(std::uint32_t body, double x, double y);
  void remove(std::uint32_t body) {
    if (!is_listed(body)) return;
    unlink(body);
    set_place(body, Place{});
  }
  /// Different threads may move different bodies as long as none is in a cell, or comes to one,
  /// that another reads or writes.
  void move(std::uint32_t body, Direction direction) {
    Place place = places_[body];
    assert(is_listed(body));
    unlink(body);
    const int step = (direction & 1) != 0 ? 1 : -1;
    std::uint16_t& index = direction <= right ? place.column : place.row;
    index = static_cast<std::uint16_t>(index + step);
    link(body, place);
  }

  /// Whether a move() would leave all cells where they are in memory.
  bool has_room_beyond(std::uint32_t body, Direction direction) const {
    return cells_[neighbour(cell_at(places_[body]), direction) * stride_] + 1 < stride_;
  }

  double side() const { return side_; }
  bool is_listed(std::uint32_t body) const { return places_[body].column != Place{}.column; }
  Place place(std::uint32_t body) const { return places_[body]; }
  /// The same while others may move `body`: where it is or was.
  Place place_meanwhile(std::uint32_t body) const {
    return std::atomic_ref(const_cast<Place&>(places_[body])).load(std::memory_order_relaxed);
  }
  std::uint32_t column_of(std::uint32_t body) const { return places_[body].column; }
  std::uint32_t row_of(std::uint32_t body) const { return places_[body].row; }
  /// Where a body leaves its cell downwards (`is_high` 0) and upwards (1) along an axis; infinite
  /// at the rim.
  double column_edge(std::uint32_t column, bool is_high) const {
    return column_edges_[2 * column + is_high];
  }
  double row_edge(std::uint32_t row, bool is_high) const { return row_edges_[2 * row + is_high]; }

  /// Room that collect() needs.
  std::uint32_t collected_max() const { return 9 * stride_ + 8; }
  /// Lists everybody in the nine cells around `body`, itself included; returns how many.
  std::uint32_t collect(std::uint32_t body, std::uint32_t* list) const {
    const std::size_t middle = cell_at(places_[body]);
    std::uint32_t* end = list;
    for (const std::size_t row : {middle - pitch_, middle, middle + pitch_})
      for (std::size_t cell = row - 1; cell <= row + 1; ++cell) end = append(cell, end);
    return static_cast<std::uint32_t>(end - list);
  }
  /// Collects only the bodies in the three cells that came into sight when `body` moved to its cell
  /// by `direction`.
  std::uint32_t collect_ahead(std::uint32_t body, Direction direction, std::uint32_t* list) const {
    return collect_three(neighbour(cell_at(places_[body]), direction), direction, list);
  }
  /// As collect_ahead() will do after that move.
  std::uint32_t collect_ahead_of_move(std::uint32_t body, Direction direction,
                                      std::uint32_t* list) const {
    return collect_three(neighbour(neighbour(cell_at(places_[body]), direction), direction),
                         direction, list);
  }

  /// Ask the processor to fetch the place of `body`; the cells that collect() would read, and those
  /// of a move() and collect_ahead().
  void prefetch_place(std::uint32_t body) const { __builtin_prefetch(&places_[body], 1); }
  void prefetch_cells(std::uint32_t body) const {
    const std::size_t middle = cell_at(places_[body]);
    for (const std::size_t row : {middle - pitch_, middle, middle + pitch_})
      prefetch(row - 1), prefetch(row + 1);
  }
  void prefetch_cells_ahead(std::uint32_t body, Direction direction) const {
    const std::size_t from = cell_at(places_[body]),
                      middle = neighbour(neighbour(from, direction), direction),
                      across = direction <= right ? pitch_ : 1;
    prefetch(from), prefetch(neighbour(from, direction)), prefetch(middle - across),
        prefetch(middle), prefetch(middle + across);
  }

  /// Cells from one to another, both included.
  struct Range {
    std::uint32_t column_low, row_low, column_high, row_high;
  };
  /// Calls `visit(body)` for every body in those of the cells that there are.
  template <class Visit>
  void within(const Range& range, Visit&& visit) const {
    const std::uint32_t last_column = std::min(range.column_high, columns_ - 1),
                        last_row = std::min(range.row_high, rows_ - 1);
    for (std::uint32_t y = range.row_low; y <= last_row; ++y)
      for (std::uint32_t x = range.column_low; x <= last_column; ++x) {
        const std::uint32_t* cell =
            &cells_[cell_at({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)}) *
                    stride_];
        for (std::uint32_t k = 1; k <= cell[0]; ++k) visit(cell[k]);
      }
  }
  /// The same for the nine cells around `body`.
  template <class Visit>
  void around(std::uint32_t body, Visit&& visit) const {
    const std::uint32_t column = column_of(body), row = row_of(body);
    within({column - std::min(column, 1u), row - std::min(row, 1u), column + 1, row + 1}, visit);
  }
  std::uint32_t columns() const { return columns_; }
  std::uint32_t rows() const { return rows_; }
  std::uint32_t column(double x) const { return clamp(x, columns_); }
  std::uint32_t row(double y) const { return clamp(y, rows_); }

 private:
  static constexpr std::uint32_t few = 7, stride_min = few + 1;

  std::uint32_t clamp(double coordinate, std::uint32_t count) const {
    return static_cast<std::uint32_t>(
        std::clamp(coordinate * inverse_side_, 0.0, static_cast<double>(count - 1)));
  }
  std::size_t cell_at(Place place) const {
    return (place.row + std::size_t{1}) * pitch_ + place.column + 1;
  }
  std::size_t neighbour(std::size_t cell, Direction direction) const {
    const std::size_t step = direction <= right ? 1 : pitch_;
    return (direction & 1) != 0 ? cell + step : cell - step;
  }
  std::uint32_t collect_three(std::size_t middle, Direction direction, std::uint32_t* list) const {
    const std::size_t across = direction <= right ? pitch_ : 1;
    return static_cast<std::uint32_t>(
        append(middle + across, append(middle, append(middle - across, list))) - list);
  }
  std::uint32_t* append(std::size_t cell, std::uint32_t* list) const {
    const std::uint32_t* from = &cells_[cell * stride_];
    std::memcpy(list, from + 1, few * sizeof *from);  // places at once, taken or not
    if (from[0] > few) std::copy_n(from + 1 + few, from[0] - few, list + few);
    return list + from[0];
  }
  void set_place(std::uint32_t body, Place place) {
    std::atomic_ref(places_[body]).store(place, std::memory_order_relaxed);
  }
  void unlink(std::uint32_t body) {
    std::uint32_t* cell = &cells_[cell_at(places_[body]) * stride_];
    std::uint32_t* at = cell + 1;
    while (*at != body) ++at;
    assert(at <= cell + cell[0]);
    *at = cell[cell[0]--];
  }
  void link(std::uint32_t body, Place place) {
    assert(place.column < columns_ && place.row < rows_);
    set_place(body, place);
    if (cells_[cell_at(place) * stride_] + 1 == stride_) widen();
    std::uint32_t* cell = &cells_[cell_at(place) * stride_];
    cell[++cell[0]] = body;
  }
  void widen();
  void prefetch(std::size_t cell) const { __builtin_prefetch(&cells_[cell * stride_], 1); }

  // A cell is the number of its bodies followed by their ids, stride_ - 1 at most; the stride grows
  // with the fullest cell.
  LargeArray<std::uint32_t> cells_ = LargeArray<std::uint32_t>(9 * stride_min);
  LargeArray<Place> places_;
  std::vector<double> column_edges_, row_edges_;
  double side_ = 1.0, inverse_side_ = 1.0;
  std::uint32_t columns_ = 1, rows_ = 1, stride_ = stride_min;
  std::size_t pitch_ = 3;
};

}  // namespace rink::physics
