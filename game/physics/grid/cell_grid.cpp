// Choice of the cell size; who is in which cell, and in which cells.
#include "game/physics/grid/cell_grid.h"

#include <cmath>
#include <limits>

namespace rink::physics {

namespace {

/// The last cell takes what is left, up to twice the side, so that the side does not depend on the
/// field's length.
std::vector<double> edges_of(std::uint32_t count, double side, double low) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> edges;
  for (std::uint32_t index = 0; index < count; ++index) {
    edges.push_back(index == 0 ? -infinity : low + (index - 1.0 / 64.0) * side);
    edges.push_back(index + 1 == count ? infinity : low + (index + 1.0 + 1.0 / 64.0) * side);
  }
  return edges;
}

}  // namespace

/// Few crossings are worth many bodies in sight where the flights are long: 1.15 bodies in a cell
/// at packing 0.05, 0.9 at 0.2, the least possible cell at 0.5 and denser.
double cell_side(const CellPlan& plan, double reach) {
  const auto& [length, width, body_max, least_cell] = plan;
  assert(length > 0.0 && width > 0.0 && reach >= 0.0 && least_cell >= 0.0);
  const double spacing = std::sqrt(length * width / std::max(1u, body_max));
  return std::max({1.2 * spacing - 0.5 * reach, least_cell, reach * (1.0 + 1.0 / 16.0),
                   std::max(length, width) / 30000.0});
}

/// Empties the grid. `reach` [m] is the longest distance along an axis at which two small bodies
/// touch.
void CellGrid::rebuild(const Ground& ground, double reach, std::uint32_t body_max,
                       double least_cell) {
  const auto& [low_x, low_y, length, width] = ground;
  low_x_ = low_x, low_y_ = low_y, reach_ = reach;
  side_ = cell_side({length, width, body_max, least_cell}, reach);
  columns_ = static_cast<std::uint32_t>(std::max(1.0, std::floor(length / side_)));
  rows_ = static_cast<std::uint32_t>(std::max(1.0, std::floor(width / side_)));
  inverse_side_ = 1.0 / side_;
  column_edges_ = edges_of(columns_, side_, low_x_);
  row_edges_ = edges_of(rows_, side_, low_y_);
  cells_.restart(columns_, rows_);
  wide_.restart(side_, columns_, rows_);
  has_wide_ = false;
  std::fill(places_.begin(), places_.end(), Place{});
}

void CellGrid::insert(std::uint32_t body, double x, double y) {
  assert(body < places_.size() && !is_listed(body));
  places_[body] = {static_cast<std::uint16_t>(column(x)), static_cast<std::uint16_t>(row(y))};
  cells_.add(cell_of(body), body);
}

/// A small one may leave its cell by a margin; another is for rounding.
void CellGrid::insert_wide(std::uint32_t body, const Box& box) {
  assert(body < places_.size() && !is_listed(body));
  const double more = 0.5 * reach_ + side_ / 32.0;
  const std::uint32_t slot = wide_.add({body, {}, box.half_width + more, box.half_height + more},
                                       box.x - low_x_, box.y - low_y_);
  places_[body] = {static_cast<std::uint16_t>(columns_ + slot),
                   static_cast<std::uint16_t>(rows_ + slot)};
  has_wide_ = true;
  cells_.require_room(static_cast<std::uint32_t>(places_.size()) + spare_room);
  set_edges(slot);
}

void CellGrid::remove_wide(std::uint32_t body) {
  if (!is_listed(body)) return;
  wide_.remove(slot_of(body));
  places_[body] = Place{};
}

void CellGrid::move_wide(std::uint32_t body, Direction direction) {
  wide_.move(slot_of(body), direction);
  set_edges(slot_of(body));
}

void CellGrid::set_edges(std::uint32_t slot) {
  const std::size_t column = 2 * (std::size_t{columns_} + slot),
                    row = 2 * (std::size_t{rows_} + slot);
  column_edges_.resize(std::max(column_edges_.size(), column + 2));
  row_edges_.resize(std::max(row_edges_.size(), row + 2));
  const auto edges = wide_.edges(slot);
  column_edges_[column] = low_x_ + edges[left], column_edges_[column + 1] = low_x_ + edges[right];
  row_edges_[row] = low_y_ + edges[down], row_edges_[row + 1] = low_y_ + edges[up];
}

std::uint32_t CellGrid::collect_all_sizes(std::uint32_t body, std::uint32_t* list) const {
  std::uint32_t* end = list;
  if (is_wide(body)) {
    within(wide_[slot_of(body)].block, [&](std::uint32_t other) { *end++ = other; });
  } else {
    end += cells_.collect_nine(cell_of(body), list);
    wide_.visit_in(places_[body].column, places_[body].row,
                   [&](const WideBodies::Wide& wide) { *end++ = wide.body; });
  }
  return static_cast<std::uint32_t>(end - list);
}

/// Who was in sight before is not listed again: it would be taken for two that come at one instant.
std::uint32_t CellGrid::collect_all_sizes_ahead(std::uint32_t body, Direction direction,
                                                std::uint32_t* list) const {
  std::uint32_t* end = list;
  const auto add = [&](std::uint32_t other) { *end++ = other; };
  if (is_wide(body)) {
    const CellBlock after = wide_[slot_of(body)].block, before = moved(after, opposite(direction)),
                    strip = after.beyond(before);
    cells_.visit(strip, add);
    wide_.visit_in(strip, [&](const WideBodies::Wide& wide) {
      if (!wide.block.overlaps(before)) add(wide.body);
    });
  } else {
    const Place after = places_[body], before = after.towards(opposite(direction));
    end += cells_.collect_three(cells_.neighbour(cell_of(body), direction), direction, list);
    wide_.visit_in(after.column, after.row, [&](const WideBodies::Wide& wide) {
      if (!wide.block.holds(before.column, before.row)) add(wide.body);
    });
  }
  return static_cast<std::uint32_t>(end - list);
}

}  // namespace rink::physics
