// The scheme `grid`: an entity matters to a subscriber while the cell of its centre is one that the subscriber's region touches.
#include "im/cells.h"
#include "im/overlap_filter.h"

namespace rink::im {
namespace {

class GridFilter final : public OverlapFilter {
 public:
  GridFilter(const Region& world, double cell_size) : OverlapFilter(cells_of(world, world, cell_size)), world_(world), cell_size_(cell_size) {}

  void set_update_region(Entity entity, const Region& region) override {
    OverlapFilter::set_update_region(entity, cells_of(centre_of(region), world_, cell_size_));
  }
  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    OverlapFilter::set_subscription_region(subscriber, cells_of(region, world_, cell_size_));
  }
  double cell_size() const override { return cell_size_; }

 private:
  Region world_;
  double cell_size_;
};

}  // namespace

std::unique_ptr<Filter> make_grid_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_grid_filter(const FilterSettings& settings) { return std::make_unique<GridFilter>(settings.world, cell_size_of(settings)); }

}  // namespace rink::im
