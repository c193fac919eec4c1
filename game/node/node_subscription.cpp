// Cells are a quarter of a view wide: smaller ones change more often, larger ones hold more bodies
// that nobody sees.
#include "game/node/node_subscription.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace rink::game {
namespace {

im::Region grown(const im::Region& region, double x, double y) {
  return {region.low_x - x, region.low_y - y, region.high_x + x, region.high_y + y};
}

double median_side(std::span<const im::Region> regions) {
  std::vector<double> sides;
  for (const im::Region& each : regions)
    sides.push_back(std::sqrt((each.high_x - each.low_x) * (each.high_y - each.low_y)));
  const auto middle = sides.begin() + static_cast<std::ptrdiff_t>(sides.size() / 2);
  std::nth_element(sides.begin(), middle, sides.end());
  return *middle;
}

}  // namespace

void NodeSubscription::look(std::span<const im::Region> regions, bool at_everything) {
  const bool is_bounded = std::isfinite(reach_.x) && std::isfinite(reach_.y);
  Cells wanted = at_everything || !is_bounded ? Cells::all_of(field_) : around(regions);
  if (wanted == cells_) return;
  cells_ = std::move(wanted);
  const std::lock_guard lock(mutex_);
  changed_ = cells_;
}

Cells NodeSubscription::around(std::span<const im::Region> regions) {
  side_ = side_for(regions);
  Cells near(field_, side_), far(field_, side_);
  for (const im::Region& each : regions) {
    near.mark(grown(each, reach_.x + 0.5 * side_, reach_.y + 0.5 * side_));
    far.mark(grown(each, reach_.x + side_, reach_.y + side_));
  }
  if (cells_.side() == side_) near.mark_common(cells_, far);
  return near;
}

/// The side stays while it is about right, since another one makes all cells anew.
double NodeSubscription::side_for(std::span<const im::Region> regions) const {
  const double widest = std::max(field_.length, field_.width),
               least = std::min(widest,
                                std::sqrt(4.0 * field_.length * field_.width / Cells::count_max));
  const double wanted =
      regions.empty() ? widest : std::clamp(0.25 * median_side(regions), least, widest);
  const bool is_right =
      side_ > 0.0 && (regions.empty() || (wanted < 2.0 * side_ && wanted > 0.5 * side_));
  double side = is_right ? side_ : wanted;
  while (!Cells::fit(field_, side))
    side *= 1.5;  // rows and columns of a narrow field are rounded up
  return side;
}

}  // namespace rink::game
