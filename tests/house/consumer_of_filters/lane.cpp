// The scheme `lane`: an entity matters while its middle is in the middle third of the view.
#include <cmath>

#include "im/schemes/predicate_filter.h"

namespace rink::im {
namespace {

bool is_in_lane(const Party& me, const Party& entity) {
  const Region &mine = me.region, &its = entity.region;
  const double off = 0.5 * its.low_y + 0.5 * its.high_y - (0.5 * mine.low_y + 0.5 * mine.high_y);
  return std::abs(off) <= (mine.high_y - mine.low_y) / 6.0;
}

}  // namespace

std::unique_ptr<Filter> make_lane_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_lane_filter(const FilterSettings& settings) {
  return make_predicate_filter(settings, &is_in_lane);
}

}  // namespace rink::im
