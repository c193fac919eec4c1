// The scheme `none`: every entity matters to every subscriber, wherever both are; what the others
// are measured against.
#include "im/schemes/overlap_filter.h"

namespace rink::im {
namespace {

/// Puts everything in the same place, so that nothing ever moves.
class NoneFilter final : public OverlapFilter {
 public:
  NoneFilter() : OverlapFilter(Region{}) {}
  void set_update_region(Entity entity, const Region&) override {
    OverlapFilter::set_update_region(entity, Region{});
  }
  void set_subscription_region(Subscriber subscriber, const Region&) override {
    OverlapFilter::set_subscription_region(subscriber, Region{});
  }
};

}  // namespace

std::unique_ptr<Filter> make_none_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_none_filter(const FilterSettings&) {
  return std::make_unique<NoneFilter>();
}

}  // namespace rink::im
