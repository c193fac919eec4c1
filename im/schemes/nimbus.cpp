// The scheme `nimbus`: an entity matters to a subscriber as far as it is in the subscriber's focus
// and the subscriber is in its nimbus (Benford & Fahlen, ECSCW 1993).
#include <algorithm>
#include <cassert>
#include <cmath>

#include "im/schemes/predicate_filter.h"

namespace rink::im {
namespace {

double middle(double low, double high) { return 0.5 * low + 0.5 * high; }

/// The distance, in radii of the smaller disc, within which awareness is at least `level`; `ratio`
/// is the smaller radius over the larger. It solves (1 - d)(1 - ratio d) = level in a form that
/// does not cancel.
double reach_of(double ratio, double level) {
  assert(ratio >= 0.0 && ratio <= 1.0 && level >= 0.0 && level <= 1.0);
  if (level == 0.0) return 1.0;
  const double root = std::sqrt((1.0 - ratio) * (1.0 - ratio) + 4.0 * ratio * level);
  return 2.0 * (1.0 - level) / (1.0 + ratio + root);
}

/// Focus and nimbus fall evenly from 1 in the middle to 0 at the rim of a disc. Awareness is their
/// product inside of both.
class Nimbus {
 public:
  explicit Nimbus(const FilterSettings& settings)
      : diameter_(2.0 * settings.nimbus_radius), level_(settings.awareness) {}

  Judgement operator()(const Party& me, const Party& entity) const {
    const Lengths plain = lengths(me.region, entity.region, 1.0);
    const double smaller = std::min(plain.focus, plain.nimbus);
    // Squares of the longest lengths have no double, and those of the shortest are 0.
    if (smaller > 1e150) return judge(lengths(me.region, entity.region, 0x1p-600), 0x1p-600);
    if (std::max({std::abs(plain.x), std::abs(plain.y), smaller}) < 1e-140) {
      constexpr double scale = 0x1p600;
      return judge({scale * plain.x, scale * plain.y, scale * plain.focus, scale * plain.nimbus},
                   scale);
    }
    return judge(plain, 1.0);
  }

 private:
  /// All doubled, so that nothing needs halving.
  struct Lengths {
    double x, y, focus, nimbus;
  };
  Lengths lengths(const Region& mine, const Region& its, double scale) const {
    const double focus = std::min(scale * mine.high_x - scale * mine.low_x,
                                  scale * mine.high_y - scale * mine.low_y);
    return {2.0 * (scale * middle(its.low_x, its.high_x) - scale * middle(mine.low_x, mine.high_x)),
            2.0 * (scale * middle(its.low_y, its.high_y) - scale * middle(mine.low_y, mine.high_y)),
            focus, diameter_ > 0.0 ? scale * diameter_ : focus};
  }
  Judgement judge(const Lengths& all, double scale) const {
    const auto [smaller, larger] = std::minmax(all.focus, all.nimbus);
    const double reach = smaller * reach_of(larger > 0.0 ? smaller / larger : 1.0, level_);
    const double squared = all.x * all.x + all.y * all.y;
    // The offset changes by at most sqrt(2) of how far both come, the reach by no more than that.
    return {squared <= reach * reach, std::abs(std::sqrt(squared) - reach) / (6.0 * scale)};
  }

  double diameter_;  ///< 0: that of the focus
  double level_;
};

}  // namespace

std::unique_ptr<Filter> make_nimbus_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_nimbus_filter(const FilterSettings& settings) {
  return make_predicate_filter(settings, Nimbus(settings));
}

}  // namespace rink::im
