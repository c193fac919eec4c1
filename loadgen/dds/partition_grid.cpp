// Cells by division.
#include "loadgen/dds/partition_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rink::loadgen {
namespace {

double cells_along(double length, double cell_size) {
  return cell_size > 0.0 ? std::max(1.0, std::ceil(length / cell_size)) : 1.0;
}

}  // namespace

double PartitionGrid::cells_in(const im::Region& world, double cell_size) {
  return cells_along(world.high_x - world.low_x, cell_size) *
         cells_along(world.high_y - world.low_y, cell_size);
}

PartitionGrid::PartitionGrid(const im::Region& world, double cell_size)
    : world_(world), cell_size_(cell_size) {
  assert(im::is_valid(world) && cell_size >= 0.0 && cells_in(world, cell_size) <= cells_max);
  columns_ = static_cast<std::uint32_t>(cells_along(world.high_x - world.low_x, cell_size));
  rows_ = static_cast<std::uint32_t>(cells_along(world.high_y - world.low_y, cell_size));
}

std::uint32_t PartitionGrid::along(double distance, std::uint32_t count) const {
  if (count == 1) return 0;
  const double last = static_cast<double>(count - 1);
  return static_cast<std::uint32_t>(std::clamp(std::floor(distance / cell_size_), 0.0, last));
}

std::vector<std::uint32_t> PartitionGrid::cells_of(const im::Region& region) const {
  assert(im::is_valid(region));
  std::vector<std::uint32_t> cells;
  for (std::uint32_t y = row(region.low_y); y <= row(region.high_y); ++y)
    for (std::uint32_t x = column(region.low_x); x <= column(region.high_x); ++x)
      cells.push_back(y * columns_ + x);
  return cells;
}

std::string PartitionGrid::name_of(std::uint32_t cell) const {
  assert(cell < size());
  if (size() == 1) return {};
  return "cell " + std::to_string(cell % columns_) + " " + std::to_string(cell / columns_);
}

}  // namespace rink::loadgen
