// The scheme `hybrid`: an entity matters to a subscriber while `grid` says so and their closed rectangles overlap.
#include "im/cells.h"
#include "im/predicate_filter.h"

namespace rink::im {
namespace {

struct InTouchedCell {
  Region world;
  double cell_size;
  bool operator()(const Party& subscriber, const Party& entity) const {
    const Region touched = cells_of(subscriber.region, world, cell_size), cell = cells_of(centre_of(entity.region), world, cell_size);
    return touched.low_x <= cell.low_x && cell.low_x <= touched.high_x && touched.low_y <= cell.low_y && cell.low_y <= touched.high_y;
  }
};

class HybridFilter final : public PredicateFilter<InTouchedCell> {
 public:
  HybridFilter(const Region& world, double cell_size) : PredicateFilter(world, {world, cell_size}), cell_size_(cell_size) {}
  double cell_size() const override { return cell_size_; }

 private:
  double cell_size_;
};

}  // namespace

std::unique_ptr<Filter> make_hybrid_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_hybrid_filter(const FilterSettings& settings) { return std::make_unique<HybridFilter>(settings.world, cell_size_of(settings)); }

}  // namespace rink::im
