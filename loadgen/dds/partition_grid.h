// The square cells that a field is cut into, each a partition: where a body belongs, and what a
// region touches.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "game/physics/body.h"
#include "im/filter.h"

namespace rink::loadgen {

/// Numbers cells row by row. What is outside of the field belongs to the nearest cell.
class PartitionGrid {
 public:
  static constexpr double cells_max = 10'000.0;  ///< each is a writer at the server

  /// How many cells of `cell_size` [m] cover `world`; a size of 0 makes one of all.
  static double cells_in(const im::Region& world, double cell_size);

  /// At most `cells_max` cells (asserted).
  PartitionGrid(const im::Region& world, double cell_size);

  std::uint32_t size() const { return columns_ * rows_; }
  std::uint32_t cell_at(const physics::Vector2& place) const {
    return row(place.y()) * columns_ + column(place.x());
  }
  /// The cells in which a body may be that is within `region`, ascending.
  std::vector<std::uint32_t> cells_of(const im::Region& region) const;
  /// The cell's partition; empty, which is the default partition, of the only cell.
  std::string name_of(std::uint32_t cell) const;

 private:
  std::uint32_t column(double x) const { return along(x - world_.low_x, columns_); }
  std::uint32_t row(double y) const { return along(y - world_.low_y, rows_); }
  std::uint32_t along(double distance, std::uint32_t count) const;

  im::Region world_;
  double cell_size_;
  std::uint32_t columns_ = 1, rows_ = 1;
};

}  // namespace rink::loadgen
