// The scheme `strips`: an entity matters to a subscriber while the upright strip that its middle is
// in is one that the subscription touches, as in corridors.
#include "im/schemes/cells.h"
#include "im/schemes/following_cells.h"
#include "im/schemes/overlap_filter.h"

namespace rink::im {
namespace {

/// Maps both to whole numbers along a line, so that a move within a strip is none.
class StripsFilter : public OverlapFilter {
 public:
  StripsFilter(const Region& world, double width)
      : OverlapFilter(strips_of(cells_of(world, world, width))), world_(world), width_(width) {}

  void set_update_region(Entity entity, const Region& region) override {
    OverlapFilter::set_update_region(entity,
                                     strips_of(cells_of(centre_of(region), world_, width_)));
  }
  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    OverlapFilter::set_subscription_region(subscriber, strips_of(cells_of(region, world_, width_)));
  }
  /// All strips that its middle crosses.
  void set_swept_update_region(Entity entity, const Region& from, const Region& to) override {
    OverlapFilter::set_update_region(
        entity, strips_of(cells_of(hull_of(centre_of(from), centre_of(to)), world_, width_)));
  }
  double cell_size() const override { return width_; }

 protected:
  /// All regions must be set anew afterwards.
  void resize_cells(double width) {
    width_ = width;
    expect(strips_of(cells_of(world_, world_, width_)));
  }

 private:
  static Region strips_of(const Region& cells) { return {cells.low_x, 0.0, cells.high_x, 0.0}; }

  Region world_;
  double width_;
};

}  // namespace

std::unique_ptr<Filter> make_strips_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_strips_filter(const FilterSettings& settings) {
  return make_celled_filter<StripsFilter>(settings);
}

}  // namespace rink::im
