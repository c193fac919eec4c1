// The scheme `aura`: an entity matters to a subscriber while its rectangle touches the closed disc that the subscriber's region holds.
#include "im/overlap_filter.h"

namespace rink::im {

std::unique_ptr<Filter> make_aura_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_aura_filter(const FilterSettings& settings) { return std::make_unique<OverlapFilter>(settings.world, Instructions::best, Shape::disc); }

}  // namespace rink::im
