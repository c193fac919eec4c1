// A uniform grid of square cells over the field: who is near whom, and nothing else.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace rink::physics {

/// Bodies are listed by the cell of their centre. A body may leave its cell by `margin` before it is moved to the next, so that rounding at an edge never matters and
/// nobody flickers; cells are therefore wider than the longest reach by two margins.
class CellGrid {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  void rebuild(double length, double width, double reach, std::uint32_t body_max, double least_cell);
  void resize(std::uint32_t count) { next_.resize(count, none), previous_.resize(count, none), cell_.resize(count, none); }

  void insert(std::uint32_t body, double x, double y) { link(body, row(y) * columns_ + column(x)); }
  void remove(std::uint32_t body) {
    const std::uint32_t cell = cell_[body];
    if (cell == none) return;
    if (previous_[body] == none) heads_[cell] = next_[body];
    else next_[previous_[body]] = next_[body];
    if (next_[body] != none) previous_[next_[body]] = previous_[body];
    cell_[body] = none;
  }
  void move(std::uint32_t body, int columns, int rows) {
    const std::uint32_t cell = cell_[body];
    remove(body);
    link(body, cell + static_cast<std::uint32_t>(columns) + static_cast<std::uint32_t>(rows) * columns_);
  }

  double side() const { return side_; }
  std::uint32_t column_of(std::uint32_t body) const { return cell_[body] % columns_; }
  std::uint32_t row_of(std::uint32_t body) const { return cell_[body] / columns_; }
  /// Where `axis` coordinate leaves the cell downwards and upwards; infinite at the rim.
  double low(std::uint32_t index) const { return index == 0 ? -std::numeric_limits<double>::infinity() : index * side_ - margin_; }
  double high(std::uint32_t index, bool is_column) const {
    return index + 1 == (is_column ? columns_ : rows_) ? std::numeric_limits<double>::infinity() : (index + 1) * side_ + margin_;
  }

  /// Calls `visit(body)` for every body in the cells from (column + low_x, row + low_y) to (column + high_x, row + high_y).
  template <class Visit>
  void around(std::uint32_t column, std::uint32_t row, int low_x, int high_x, int low_y, int high_y, Visit&& visit) const {
    const int x0 = std::max(0, static_cast<int>(column) + low_x), x1 = std::min(static_cast<int>(columns_) - 1, static_cast<int>(column) + high_x);
    const int y0 = std::max(0, static_cast<int>(row) + low_y), y1 = std::min(static_cast<int>(rows_) - 1, static_cast<int>(row) + high_y);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        for (std::uint32_t body = heads_[static_cast<std::uint32_t>(y) * columns_ + static_cast<std::uint32_t>(x)]; body != none; body = next_[body]) visit(body);
  }
  std::uint32_t column(double x) const { return clamp(x, columns_); }
  std::uint32_t row(double y) const { return clamp(y, rows_); }

 private:
  std::uint32_t clamp(double coordinate, std::uint32_t count) const {
    return static_cast<std::uint32_t>(std::clamp(coordinate * inverse_side_, 0.0, static_cast<double>(count - 1)));
  }
  void link(std::uint32_t body, std::uint32_t cell) {
    cell_[body] = cell;
    next_[body] = heads_[cell];
    previous_[body] = none;
    if (heads_[cell] != none) previous_[heads_[cell]] = body;
    heads_[cell] = body;
  }

  std::vector<std::uint32_t> heads_{none}, next_, previous_, cell_;
  double side_ = 1.0, inverse_side_ = 1.0, margin_ = 0.0;
  std::uint32_t columns_ = 1, rows_ = 1;
};

}  // namespace rink::physics
