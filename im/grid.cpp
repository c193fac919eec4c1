// The scheme `grid`: an entity matters to a subscriber while the cell of its centre is one that the subscriber's region touches.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "im/overlap_filter.h"

namespace rink::im {
namespace {

/// At 5 % of a square world per subscription, 7 of these make its side and three quarters of what is sent is wanted (docs/im.md).
constexpr double cells_across = 32.0;

double chosen_cell_size(const Region& world) {
  const double width = world.high_x - world.low_x, height = world.high_y - world.low_y;
  const double side = width > 0.0 && height > 0.0 ? std::sqrt(width) * std::sqrt(height) : std::max(width, height);
  return side > 0.0 ? side / cells_across : 1.0;
}

/// Cells are half-open squares counted from the world's low corner; there is no last one. Whole numbers in doubles, so that no coordinate is too far.
class GridFilter final : public OverlapFilter {
 public:
  GridFilter(const Region& world, double cell_size) : OverlapFilter(touched(world, world, cell_size)), world_(world), cell_size_(cell_size) {
    assert(cell_size > 0.0);
  }

  void set_update_region(Entity entity, const Region& region) override {
    const double x = 0.5 * region.low_x + 0.5 * region.high_x, y = 0.5 * region.low_y + 0.5 * region.high_y;
    OverlapFilter::set_update_region(entity, touched({x, y, x, y}, world_, cell_size_));
  }
  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    OverlapFilter::set_subscription_region(subscriber, touched(region, world_, cell_size_));
  }
  double cell_size() const override { return cell_size_; }

 private:
  static Region touched(const Region& region, const Region& world, double size) {
    return {cell(region.low_x, world.low_x, size), cell(region.low_y, world.low_y, size), cell(region.high_x, world.low_x, size), cell(region.high_y, world.low_y, size)};
  }
  /// What lies beyond the largest number shares the last cell.
  static double cell(double coordinate, double origin, double size) {
    constexpr double bound = std::numeric_limits<double>::max();
    return std::clamp(std::floor((coordinate - origin) / size), -bound, bound);
  }

  Region world_;
  double cell_size_;
};

}  // namespace

std::unique_ptr<Filter> make_grid_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_grid_filter(const FilterSettings& settings) {
  const double cell_size = settings.cell_size > 0.0 ? settings.cell_size : chosen_cell_size(settings.world);
  return std::make_unique<GridFilter>(settings.world, cell_size);
}

}  // namespace rink::im
