// Links rink::im and nothing else: filters decide who sees whom, one of the library and one of the
// project's own, that of docs/start-scheme.md.
#include <cstdio>
#include <memory>

#include "im/filter.h"

namespace rink::im {
std::unique_ptr<Filter> make_lane_filter(const FilterSettings& settings);
}

namespace {

/// Whether `filter` shows entity 7 and no other to a viewer of 1 m by 1 m.
bool shows_the_first_alone(rink::im::Filter& filter) {
  filter.set_subscription_region(0, {0.0, 0.0, 1.0, 1.0});
  filter.set_update_region(7, {0.7, 0.4, 0.8, 0.5});
  filter.set_update_region(8, {8.0, 8.0, 8.1, 8.1});
  const auto changes = filter.match();
  return changes.size() == 1 && changes[0].entity == 7;
}

}  // namespace

int main() {
  const rink::im::FilterSettings settings{.world = {0.0, 0.0, 10.0, 10.0}};
  const auto grid = rink::im::make_filter("grid(cell_size=2)", settings),
             lane = rink::im::make_lane_filter(settings);
  if (!shows_the_first_alone(*grid))
    return std::puts("the grid does not show the entity in the viewer's cell, and only that"), 1;
  lane->set_update_region(9, {0.7, 0.8, 0.8, 0.9});
  if (!shows_the_first_alone(*lane))
    return std::puts("the lane does not show the entity in its middle third, and only that"), 1;
  return 0;
}
