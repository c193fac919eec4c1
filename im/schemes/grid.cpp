// The scheme `grid`: an entity matters to a subscriber while the cell of its centre is one that the
// subscriber's region touches.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <vector>

#include "im/schemes/cells.h"
#include "im/schemes/following_cells.h"
#include "im/schemes/overlap_filter.h"

namespace rink::im {
namespace {

class GridFilter : public OverlapFilter {
 public:
  GridFilter(const Region& world, double cell_size)
      : OverlapFilter(cells_of(world, world, cell_size)), world_(world), cell_size_(cell_size) {}

  void set_update_region(Entity entity, const Region& region) override {
    const Region centre = centre_of(region);
    const std::uint64_t cell = packed(centre.low_x, centre.low_y);
    if (entity < cells_.size() && cells_[entity] == cell && cell != unpacked) return;
    // Packed and unpacked it is the same cell, or an entity would not be where its cell is.
    assert(cell == unpacked ||
           cells_of(centre, world_, cell_size_).low_x == static_cast<std::int32_t>(cell >> 32));
    OverlapFilter::set_update_region(entity, cells_of(centre, world_, cell_size_));
    if (entity >= cells_.size()) cells_.resize(entity + std::size_t{1}, unpacked);
    cells_[entity] = cell;
  }
  /// All cells of the rectangle that its centre crosses.
  void set_swept_update_region(Entity entity, const Region& from, const Region& to) override {
    OverlapFilter::set_update_region(
        entity, cells_of(hull_of(centre_of(from), centre_of(to)), world_, cell_size_));
    if (entity < cells_.size()) cells_[entity] = unpacked;
  }
  void remove_entity(Entity entity) override {
    OverlapFilter::remove_entity(entity);
    if (entity < cells_.size()) cells_[entity] = unpacked;
  }
  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    OverlapFilter::set_subscription_region(subscriber, cells_of(region, world_, cell_size_));
  }
  double cell_size() const override { return cell_size_; }

 protected:
  /// All regions must be set anew afterwards.
  void resize_cells(double size) {
    cell_size_ = size;
    std::fill(cells_.begin(), cells_.end(), unpacked);
    expect(cells_of(world_, world_, cell_size_));
  }

 private:
  /// Of no cell that can be packed.
  static constexpr std::uint64_t unpacked = 0x8000000080000000u;

  /// The cell of a point in whole numbers of 32 bits; `unpacked` if it is farther from the origin
  /// than those go.
  std::uint64_t packed(double x, double y) const {
    constexpr double bound = 1 << 30;
    const double across = (x - world_.low_x) / cell_size_, up = (y - world_.low_y) / cell_size_;
    if (!(std::abs(across) < bound && std::abs(up) < bound)) return unpacked;
    return std::uint64_t{whole(across)} << 32 | whole(up);
  }
  /// As `floored`, in half the time.
  static std::uint32_t whole(double number) {
    const auto towards_zero = static_cast<std::int32_t>(number);
    return static_cast<std::uint32_t>(towards_zero - (number < towards_zero));
  }

  Region world_;
  double cell_size_;
  std::vector<std::uint64_t> cells_;  // of each entity: most stay in their cell, which 8 bytes
                                      // show, where the history needs a line of 64
};

}  // namespace

std::unique_ptr<Filter> make_grid_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_grid_filter(const FilterSettings& settings) {
  return make_celled_filter<GridFilter>(settings);
}

}  // namespace rink::im
