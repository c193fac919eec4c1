// Finds the reach by trial: pairs of a viewer and a body that moves away from it.
#include "game/replication/scheme_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace rink::game {

namespace {

/// Each viewer has a place of its own, so that cells and strips lie differently around each; every
/// other body is tiny, since a scheme may depend on sizes.
class Trial {
 public:
  Trial(const std::string& scheme, const im::FilterSettings& settings, double extent_max)
      : filter_(im::make_filter(scheme, settings)),
        world_(settings.world),
        extent_max_(extent_max),
        is_in_(pair_count, false) {
    const double width = world_.high_x - world_.low_x, height = world_.high_y - world_.low_y,
                 side = 0.1 * std::min(width, height);
    for (std::uint32_t k = 0; k < pair_count; ++k) {
      const double x = world_.low_x + 0.5 * width * fraction(0.6180339887498949 * k),
                   y = world_.low_y + 0.5 * height * fraction(0.7548776662466927 * k);
      views_.push_back({x, y, x + side, y + side});
      filter_->set_subscription_region(k, views_.back());
    }
    put(0.0, 0.0);
    // Roles and headings are the same for all pairs.
    for (std::uint32_t k = 0; k < pair_count; ++k)
      filter_->set_entity_role(k, role), filter_->set_subscriber_role(k, role);
  }

  /// Moves the bodies to the middles of the regions, so that every possible pair is relevant.
  void come_back() {
    put(0.0, 0.0);
    match();
  }
  /// True if any pair is relevant with the body so far beyond the region's edge in the direction of
  /// (x, y) [m].
  bool reaches(double x, double y) {
    put(x, y);
    match();
    return std::find(is_in_.begin(), is_in_.end(), true) != is_in_.end();
  }

 private:
  static constexpr std::uint32_t pair_count = 32;
  static constexpr im::Role role{.team = 1, .owner = 1, .is_always_relevant = true};
  static double fraction(double value) { return value - std::floor(value); }

  void put(double x, double y) {
    for (std::uint32_t k = 0; k < pair_count; ++k) {
      const im::Region& view = views_[k];
      const auto beyond = [](double low, double high, double by) {
        return by > 0.0 ? high + by : by < 0.0 ? low + by : 0.5 * (low + high);
      };
      const double at_x = beyond(view.low_x, view.high_x, x),
                   at_y = beyond(view.low_y, view.high_y, y),
                   extent = k % 2 == 0 ? extent_max_ : 1e-3 * extent_max_;
      filter_->set_update_region(k, {at_x - extent, at_y - extent, at_x + extent, at_y + extent});
    }
  }
  void match() {
    for (const im::Change& change : filter_->match())
      if (change.subscriber == change.entity)
        is_in_[change.entity] = change.transition != im::Transition::left;
  }

  std::unique_ptr<im::Filter> filter_;
  im::Region world_;
  double extent_max_;
  std::vector<im::Region> views_;
  std::vector<bool> is_in_;
};

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Distances grow by a factor of two from trial to trial. With cells of side c a body d beyond the
/// edge is let in in a share 1 - d/c of the trials: among 32 a distance up to 0.8 c is found, so
/// 2.5 times the largest found exceeds c.
double reach_along(Trial& trial, double x, double y, double farthest) {
  constexpr int trials = 14;
  constexpr double safety = 2.5;
  double reach = 0.0;
  for (const double sign : {-1.0, 1.0}) {
    // A scheme that keeps pairs for a while shows this when the body goes away at once.
    for (const double first : {farthest, std::ldexp(farthest, 1 - trials)}) {
      trial.come_back();
      for (double distance = first; distance <= farthest; distance *= 2.0)
        if (trial.reaches(sign * x * distance, sign * y * distance))
          reach = std::max(reach, distance);
    }
  }
  return reach >= farthest ? infinity : safety * reach;
}

}  // namespace

SchemeReach reach_of(const std::string& scheme, im::FilterSettings settings, double extent_max) {
  for (const char* const plain :
       {"region", "aura", "hybrid", "sight", "cone", "diamond", "nimbus", "pvs", "tiles"})
    if (scheme == plain) return {extent_max, extent_max};
  // What follows from all bodies is not seen with the few of a trial.
  if (scheme == "none" || im::make_filter(scheme, settings)->traits().depends_on_crowd)
    return {infinity, infinity};
  settings.posts.clear();  // which only hide
  const double farthest = std::max(settings.world.high_x - settings.world.low_x,
                                   settings.world.high_y - settings.world.low_y);
  Trial trial(scheme, settings, extent_max);
  const double along_x = reach_along(trial, 1.0, 0.0, farthest),
               along_y = reach_along(trial, 0.0, 1.0, farthest),
               across = reach_along(trial, 1.0, 1.0, farthest);
  return {std::max({along_x, across, extent_max}), std::max({along_y, across, extent_max})};
}

}  // namespace rink::game
