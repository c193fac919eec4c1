// The scheme `aura`: an entity matters to a subscriber while its rectangle touches the closed disc that the subscriber's region holds.
#include <algorithm>

#include "im/predicate_filter.h"

namespace rink::im {
namespace {

/// Of the disc around the region's middle whose radius is half its shorter side, and the point of the entity that is nearest to the middle; all doubled, so
/// that nothing needs halving. The wider numbers have room for the square of any double, and see a tie wherever one can be meant (docs/im.md).
bool is_within_aura(const Party& subscriber, const Party& entity) {
  const auto distance = [](long double middle, double low, double high) { return std::max({2.0L * low - middle, middle - 2.0L * high, 0.0L}); };
  const Region &disc = subscriber.region, &box = entity.region;
  const long double width = static_cast<long double>(disc.high_x) - disc.low_x, height = static_cast<long double>(disc.high_y) - disc.low_y;
  const long double x = distance(static_cast<long double>(disc.low_x) + disc.high_x, box.low_x, box.high_x);
  const long double y = distance(static_cast<long double>(disc.low_y) + disc.high_y, box.low_y, box.high_y), diameter = std::min(width, height);
  return x * x + y * y <= diameter * diameter;
}

}  // namespace

std::unique_ptr<Filter> make_aura_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_aura_filter(const FilterSettings& settings) { return make_predicate_filter(settings, &is_within_aura); }

}  // namespace rink::im
