// The predicate `near_by_steps`: an entity matters while it is within half the shorter side of the
// view by steps along the axes. An experiment names it as "when near_by_steps".
#include <algorithm>
#include <cmath>

#include "im/pairs/rink_plugin.h"

namespace {

void evaluate(const rink_pairs* pairs, double* results, double* slacks) {
  for (size_t i = 0; i < pairs->count; ++i) {
    const rink_party& me = pairs->subscribers[pairs->pairs[i].subscriber];
    const rink_party& its = pairs->entities[pairs->pairs[i].entity];
    const double steps = std::abs(std::clamp(me.x, its.low_x, its.high_x) - me.x) +
                         std::abs(std::clamp(me.y, its.low_y, its.high_y) - me.y);
    const double reach = 0.5 * std::min(me.high_x - me.low_x, me.high_y - me.low_y);
    results[i] = steps <= reach ? 1.0 : 0.0;
    slacks[i] = std::abs(reach - steps) / 3.0;  // optional: spares asking again too early
  }
}

const rink_plugin plugin{
    RINK_PLUGIN_VERSION, sizeof(rink_party), "near_by_steps", RINK_PREDICATE, 0, evaluate};

}  // namespace

const rink_plugin* rink_plugin_describe(void) { return &plugin; }
