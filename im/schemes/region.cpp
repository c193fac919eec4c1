// The scheme `region`: an entity matters to a subscriber while their closed rectangles overlap,
// exactly.
#include "im/schemes/overlap_filter.h"

namespace rink::im {

std::unique_ptr<Filter> make_region_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_region_filter(const FilterSettings& settings) {
  return std::make_unique<OverlapFilter>(settings.world);
}

}  // namespace rink::im
