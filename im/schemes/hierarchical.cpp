// The scheme `hierarchical`: like `grid`, but an entity is in a cell of its own size, so that a
// large one is not known by its centre alone.
#include <cassert>

#include "im/schemes/cells.h"
#include "im/schemes/following_cells.h"
#include "im/schemes/overlap_filter.h"

namespace rink::im {
namespace {

/// Level k has cells of side 2^k times the smallest. An entity is in the cell of its centre at the
/// first level whose cells are not shorter than it is.
class HierarchicalFilter : public OverlapFilter {
 public:
  HierarchicalFilter(const Region& world, double cell_size)
      : OverlapFilter(world), world_(world), cell_size_(cell_size) {}

  void set_update_region(Entity entity, const Region& region) override {
    OverlapFilter::set_update_region(entity, cell_around(region));
  }
  /// All cells of its level between those at both ends. Its length is what rounding left of it, and
  /// may be more elsewhere on the way: the cells of a higher level hold those of a lower one.
  void set_swept_update_region(Entity entity, const Region& from, const Region& to) override {
    if (from == to) return set_update_region(entity, from);
    const double rounding = rounding_of(from) + rounding_of(to);
    OverlapFilter::set_update_region(
        entity, hull_of(cell_around(from, rounding), cell_around(to, rounding)));
  }
  double cell_size() const override { return cell_size_; }

 protected:
  /// All regions must be set anew afterwards.
  void resize_cells(double size) { cell_size_ = size; }

 private:
  /// More than a difference of its coordinates may be wrong by.
  static double rounding_of(const Region& region) {
    return 1e-15 * std::max(std::max(std::abs(region.low_x), std::abs(region.high_x)),
                            std::max(std::abs(region.low_y), std::abs(region.high_y)));
  }
  /// The largest number below the next cell is the last that is in this one: so closed rectangles
  /// say what half-open cells mean.
  Region cell_around(const Region& region, double longer_by = 0.0) const {
    const double longer =
        std::min(std::max(region.high_x - region.low_x, region.high_y - region.low_y) + longer_by,
                 largest / 4.0);
    assert(longer >= 0.0 && cell_size_ > 0.0);
    double size = cell_size_;
    while (size < longer) size *= 2.0;
    const Region cell = cells_of(centre_of(region), world_, size);
    const auto low = [size](double number, double origin) {
      return std::clamp(origin + number * size, -largest, largest);
    };
    const double low_x = low(cell.low_x, world_.low_x), low_y = low(cell.low_y, world_.low_y);
    return {low_x, low_y, std::nextafter(low(cell.low_x + 1.0, world_.low_x), low_x),
            std::nextafter(low(cell.low_y + 1.0, world_.low_y), low_y)};
  }

  Region world_;
  double cell_size_;
};

}  // namespace

std::unique_ptr<Filter> make_hierarchical_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_hierarchical_filter(const FilterSettings& settings) {
  return make_celled_filter<HierarchicalFilter>(settings);
}

}  // namespace rink::im
