// The scheme `aura`: an entity matters to a subscriber while its rectangle touches the closed disc
// that the subscriber's region holds.
#include <algorithm>
#include <cmath>

#include "im/schemes/cells.h"
#include "im/schemes/overlap_filter.h"

namespace rink::im {
namespace {

class AuraFilter final : public OverlapFilter {
 public:
  explicit AuraFilter(const Region& world)
      : OverlapFilter(world, Instructions::best, Shape::disc) {}

  /// The disc around the middle of the way that holds the discs all along it: larger by half of the
  /// way.
  void set_swept_subscription_region(Subscriber subscriber, const Region& from,
                                     const Region& to) override {
    if (from == to) return set_subscription_region(subscriber, from);
    const Region start = centre_of(from), end = centre_of(to);
    const double way = std::hypot(end.low_x - start.low_x, end.low_y - start.low_y);
    const double radius = 0.5 * std::min(from.high_x - from.low_x, from.high_y - from.low_y);
    const double x = 0.5 * start.low_x + 0.5 * end.low_x, y = 0.5 * start.low_y + 0.5 * end.low_y;
    // Rounded outward: of the sum, and of coordinates far away.
    const double reach =
        (radius + 0.5 * way) * (1.0 + 1e-12) + 1e-12 * std::max(std::abs(x), std::abs(y));
    const auto bounded = [](double coordinate) {
      return std::clamp(coordinate, -largest, largest);
    };
    set_subscription_region(subscriber, {bounded(x - reach), bounded(y - reach), bounded(x + reach),
                                         bounded(y + reach)});
  }
};

}  // namespace

std::unique_ptr<Filter> make_aura_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_aura_filter(const FilterSettings& settings) {
  return std::make_unique<AuraFilter>(settings.world);
}

}  // namespace rink::im
