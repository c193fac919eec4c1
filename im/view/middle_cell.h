// The square cells of regions' middles, for predicates that compare cells.
#pragma once

#include <algorithm>
#include <cmath>

#include "im/schemes/cells.h"
#include "im/view/sector.h"

namespace rink::im {

/// The cell of a region's middle.
struct MiddleCell {
  double column, row;
  Region box;    ///< plain
  double slack;  ///< how far the middle may come before it leaves the cell [m], at least 0
};

/// Cells of one size, counted from the world's low corner.
class MiddleCells {
 public:
  explicit MiddleCells(const FilterSettings& settings)
      : size_(cell_size_of(settings)), low_x_(settings.world.low_x), low_y_(settings.world.low_y) {}

  double size() const { return size_; }
  /// Where the cells of a column or row begin [m].
  double low_x(double column) const { return low_x_ + column * size_; }
  double low_y(double row) const { return low_y_ + row * size_; }

  MiddleCell around(const Region& region) const {
    const Region middle = centre_of(region);
    const double column = cell_of(middle.low_x, low_x_, size_),
                 row = cell_of(middle.low_y, low_y_, size_);
    const Region box{low_x(column), low_y(row), low_x(column + 1.0), low_y(row + 1.0)};
    const double slack = std::min({middle.low_x - box.low_x, box.high_x - middle.low_x,
                                   middle.low_y - box.low_y, box.high_y - middle.low_y}),
                 rounding = 1e-12 * (std::abs(low_x_) + std::abs(low_y_) + size_);
    return {column, row, plain(box), std::max(slack - rounding, 0.0)};
  }

 private:
  double size_, low_x_, low_y_;
};

}  // namespace rink::im
