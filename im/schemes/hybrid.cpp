// The scheme `hybrid`: an entity matters to a subscriber while `grid` says so and their closed
// rectangles overlap.
#include <cassert>

#include "im/schemes/cells.h"
#include "im/schemes/following_cells.h"
#include "im/schemes/predicate_filter.h"

namespace rink::im {
namespace {

/// Pairs come subscriber by subscriber, so the cells that one touches are kept until another asks.
struct InTouchedCell {
  Region world;
  double cell_size;
  Region asked = nowhere, touched = nowhere;

  /// A centre within the rectangle is in one of its cells, for no cell's number falls where the
  /// coordinate rises: only near the edges cells matter.
  Judgement operator()(const Party& subscriber, const Party& entity) {
    const Region &mine = subscriber.region, centre = centre_of(entity.region);
    const double depth = std::min(std::min(centre.low_x - mine.low_x, mine.high_x - centre.low_x),
                                  std::min(centre.low_y - mine.low_y, mine.high_y - centre.low_y));
    if (depth > 0.0) return {true, depth};
    if (!(mine == asked)) asked = mine, touched = cells_of(asked, world, cell_size);
    const double column = cell_of(centre.low_x, world.low_x, cell_size),
                 row = cell_of(centre.low_y, world.low_y, cell_size);
    return {touched.low_x <= column && column <= touched.high_x && touched.low_y <= row &&
                row <= touched.high_y,
            0.0};
  }
};

class HybridFilter : public PredicateFilter<InTouchedCell> {
 public:
  HybridFilter(const Region& world, double cell_size)
      : PredicateFilter(world, {.world = world, .cell_size = cell_size}),
        world_(world),
        cell_size_(cell_size) {
    assert(cell_size_ > 0.0);
  }
  double cell_size() const override { return cell_size_; }

 protected:
  /// All regions must be set anew afterwards.
  void resize_cells(double size) {
    cell_size_ = size;
    replace({.world = world_, .cell_size = size});
  }

 private:
  Region world_;
  double cell_size_;
};

}  // namespace

std::unique_ptr<Filter> make_hybrid_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_hybrid_filter(const FilterSettings& settings) {
  return make_celled_filter<HybridFilter>(settings);
}

}  // namespace rink::im
