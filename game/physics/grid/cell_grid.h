// A grid of square cells over the field: which bodies are near each other, and nothing else.
#pragma once

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "game/physics/grid/cell_lists.h"
#include "game/physics/grid/wide_bodies.h"
#include "game/physics/large_pages.h"
#include "game/physics/prefetch.h"

namespace rink::physics {

/// Bodies are listed by the cell of their centre. A body may leave its cell by `margin` before it
/// is moved to the next, so that rounding at an edge never matters and nobody flickers; cells are
/// therefore wider than the longest reach by two margins.
///
/// One long bat would thus make all cells long. So cells fit the small bodies, and one that reaches
/// further is wide: it stands in all cells where a small one may touch it. Two see each other
///
///     small and small   if their cells are the same or neighbours,
///     small and wide    if the wide one stands in the cell of the small one,
///     wide and wide     if they stand in one cell together,
///
/// so that whoever comes into sight does so by entering cells. Where all are small this takes one
/// branch. (A level of cells for each size would spare a bat 25 times as long as the pucks its
/// entries in many cells; but it has to look into these, and each puck into every level.)
class CellGrid {
 public:
  static constexpr std::uint32_t none = 0xffffffff;
  using enum CellLists::Direction;
  using Direction = CellLists::Direction;
  using Range = CellBlock;
  struct alignas(4) Place {
    std::uint16_t column = 0xffff, row = 0xffff;
    Place towards(Direction direction) const {
      const int step = (direction & 1) != 0 ? 1 : -1;
      Place place = *this;
      std::uint16_t& index = direction <= right ? place.column : place.row;
      index = static_cast<std::uint16_t>(index + step);
      return place;
    }
  };
  /// Of a wide body: its own half extents, not what a small one adds [m].
  struct Box {
    double x, y, half_width, half_height;
  };

  /// A rectangle of the field [m]. Whoever lies beyond it is listed in the cells at its rim.
  struct Ground {
    double low_x, low_y, length, width;
  };
  void rebuild(const Ground& ground, double reach, std::uint32_t body_max, double least_cell);
  void rebuild(double length, double width, double reach, std::uint32_t body_max,
               double least_cell) {
    rebuild({0.0, 0.0, length, width}, reach, body_max, least_cell);
  }
  void resize(std::uint32_t count) {
    places_.resize(count);
    if (has_wide_) cells_.require_room(count + spare_room);
  }

  void insert(std::uint32_t body, double x, double y);
  void insert_wide(std::uint32_t body, const Box& box);
  void remove(std::uint32_t body) {
    if (!is_in_one_cell(body)) return remove_wide(body);
    cells_.remove(cell_of(body), body);
    set_place(body, Place{});
  }
  /// Different threads may move different bodies as long as none is in a cell, or comes to one,
  /// that another reads or writes.
  [[gnu::always_inline]] void move(std::uint32_t body, Direction direction) {
    assert(is_listed(body));
    if (has_wide_ && is_wide(body)) return move_wide(body, direction);
    const Place from = places_[body], to = from.towards(direction);
    assert(to.column < columns_ && to.row < rows_);
    cells_.remove(cells_.at(from.column, from.row), body);
    cells_.add(cells_.at(to.column, to.row), body);
    set_place(body, to);
  }

  /// As move(); false, with nothing done, if cells would have to go elsewhere in
  /// memory.
  [[gnu::always_inline]] bool move_in_place(std::uint32_t body, Direction direction) {
    assert(is_listed(body));
    if (has_wide_ && is_wide(body)) {
      if (!wide_.has_room_beyond(slot_of(body), direction)) return false;
      return move_wide(body, direction), true;
    }
    const std::size_t from = cell_of(body), to = cells_.neighbour(from, direction);
    if (!cells_.has_room(to)) return false;
    cells_.remove(from, body);
    cells_.add(to, body);
    set_place(body, places_[body].towards(direction));
    return true;
  }

  double side() const { return side_; }
  bool is_listed(std::uint32_t body) const { return places_[body].column != Place{}.column; }
  /// Listed, and not wide.
  bool is_in_one_cell(std::uint32_t body) const { return places_[body].column < columns_; }
  const WideBodies& wide() const { return wide_; }
  /// That of a wide one is beyond all columns and rows; it has edges like theirs.
  Place place(std::uint32_t body) const { return places_[body]; }
  /// The same while others may move `body`: where it is or was.
  Place place_meanwhile(std::uint32_t body) const {
    return std::atomic_ref(const_cast<Place&>(places_[body])).load(std::memory_order_relaxed);
  }
  /// Where a body leaves its cell downwards (`is_high` 0) and upwards (1) along an axis; infinite
  /// at the rim.
  double column_edge(std::uint32_t column, bool is_high) const {
    return column_edges_[2 * column + is_high];
  }
  double row_edge(std::uint32_t row, bool is_high) const { return row_edges_[2 * row + is_high]; }

  /// Room that collect() needs.
  std::uint32_t collected_max() const { return cells_.collected_max(); }
  /// Lists all bodies that `body` sees, itself included; returns how many.
  std::uint32_t collect(std::uint32_t body, std::uint32_t* list) const {
    if (has_wide_) return collect_all_sizes(body, list);
    return cells_.collect_nine(cell_of(body), list);
  }
  /// Lists only those who came into sight when `body` moved to its cell by `direction`.
  std::uint32_t collect_ahead(std::uint32_t body, Direction direction, std::uint32_t* list) const {
    if (has_wide_) return collect_all_sizes_ahead(body, direction, list);
    return cells_.collect_three(cells_.neighbour(cell_of(body), direction), direction, list);
  }
  /// The small ones of those that collect_ahead() will list after that move of a small one.
  std::uint32_t collect_ahead_of_move(std::uint32_t body, Direction direction,
                                      std::uint32_t* list) const {
    const std::size_t to = cells_.neighbour(cell_of(body), direction);
    return cells_.collect_three(cells_.neighbour(to, direction), direction, list);
  }

  /// Calls `visit(list, own, all)` for each cell that has small bodies: these are the first `own`
  /// of the `all` that are on the list, and each pair of small ones in sight of each other is once
  /// on a list with one of them among the `own`. The list is `room`, for collected_max().
  template <class Visit>
  void visit_pairs(std::uint32_t* room, Visit&& visit) const {
    for (std::uint32_t row = 0; row < rows_; ++row)
      for (std::uint32_t column = 0; column < columns_; ++column) {
        const std::size_t cell = cells_.at(column, row);
        const auto own = static_cast<std::uint32_t>(cells_[cell].size());
        if (own > 0) visit(room, own, cells_.collect_onwards(cell, room));
      }
  }

  /// Ask the processor to fetch the place of `body`; of a small one also the cells that collect()
  /// would read, and those of a move() and collect_ahead().
  void prefetch_place(std::uint32_t body) const { prefetch(&places_[body]); }
  void prefetch_cells(std::uint32_t body) const { cells_.prefetch_nine(cell_of(body)); }
  void prefetch_cells_ahead(std::uint32_t body, Direction direction) const {
    const std::size_t from = cell_of(body), to = cells_.neighbour(from, direction);
    cells_.prefetch(from), cells_.prefetch(to);
    cells_.prefetch_three(cells_.neighbour(to, direction), direction);
  }

  /// Calls `visit(body)` once for every body in those of the cells that there are.
  template <class Visit>
  void within(Range range, Visit&& visit) const {
    range.column_high = std::min(range.column_high, columns_ - 1);
    range.row_high = std::min(range.row_high, rows_ - 1);
    cells_.visit(range, visit);
    wide_.visit_in(range, [&](const WideBodies::Wide& wide) { visit(wide.body); });
  }
  /// The same for all bodies that `body` sees, and perhaps some more.
  template <class Visit>
  void around(std::uint32_t body, Visit&& visit) const {
    if (is_wide(body)) return within(wide_[slot_of(body)].block, visit);
    const std::uint32_t column = places_[body].column, row = places_[body].row;
    within({column - std::min(column, 1u), row - std::min(row, 1u), column + 1, row + 1}, visit);
  }
  std::uint32_t columns() const { return columns_; }
  std::uint32_t rows() const { return rows_; }
  std::uint32_t column(double x) const { return clamp(x - low_x_, columns_); }
  std::uint32_t row(double y) const { return clamp(y - low_y_, rows_); }

 private:
  std::uint32_t clamp(double coordinate, std::uint32_t count) const {
    return static_cast<std::uint32_t>(
        std::clamp(coordinate * inverse_side_, 0.0, static_cast<double>(count - 1)));
  }
  bool is_wide(std::uint32_t body) const { return is_listed(body) && !is_in_one_cell(body); }
  std::uint32_t slot_of(std::uint32_t wide) const { return places_[wide].column - columns_; }
  std::size_t cell_of(std::uint32_t body) const {
    return cells_.at(places_[body].column, places_[body].row);
  }
  void set_place(std::uint32_t body, Place place) {
    std::atomic_ref(places_[body]).store(place, std::memory_order_relaxed);
  }
  void remove_wide(std::uint32_t body);
  void move_wide(std::uint32_t body, Direction direction);
  void set_edges(std::uint32_t slot);
  std::uint32_t collect_all_sizes(std::uint32_t body, std::uint32_t* list) const;
  std::uint32_t collect_all_sizes_ahead(std::uint32_t body, Direction direction,
                                        std::uint32_t* list) const;

  /// Nobody is listed twice; cells are copied with room to spare.
  static constexpr std::uint32_t spare_room = 8;

  CellLists cells_;
  LargeArray<Place> places_;
  WideBodies wide_;
  bool has_wide_ = false;
  std::vector<double> column_edges_, row_edges_;  // by column and row, then by slot of a wide body
  double low_x_ = 0.0, low_y_ = 0.0;              // where the cells begin [m]
  double side_ = 1.0, inverse_side_ = 1.0, reach_ = 0.0;
  std::uint32_t columns_ = 1, rows_ = 1;
};

/// What the side of a grid's cells follows from.
struct CellPlan {
  double length, width;  ///< of the field [m]
  std::uint32_t body_max;
  double least_cell;  ///< m
};
/// In metres, for `reach` [m], the longest distance along an axis at which two small bodies touch.
double cell_side(const CellPlan& plan, double reach);

}  // namespace rink::physics
