// The scheme `diamond`: an entity matters to a subscriber while it is within reach of its middle by
// steps along the axes, as games on squares count distance.
#include <algorithm>
#include <cmath>

#include "im/schemes/predicate_filter.h"

namespace rink::im {
namespace {

Judgement is_in_diamond(const Party& me, const Party& entity) {
  const Region &mine = me.region, &its = entity.region;
  const double x = 0.5 * mine.low_x + 0.5 * mine.high_x, y = 0.5 * mine.low_y + 0.5 * mine.high_y;
  const double steps = std::abs(std::clamp(x, its.low_x, its.high_x) - x) +
                       std::abs(std::clamp(y, its.low_y, its.high_y) - y);
  const double reach = 0.5 * std::min(mine.high_x - mine.low_x, mine.high_y - mine.low_y);
  return {steps <= reach, std::abs(reach - steps) / 3.0};
}

}  // namespace

std::unique_ptr<Filter> make_diamond_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_diamond_filter(const FilterSettings& settings) {
  return make_predicate_filter(settings, &is_in_diamond);
}

}  // namespace rink::im
