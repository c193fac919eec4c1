// Other people's matchers of rectangles, behind the narrowest interface that a comparison needs.
// Each is absent if its library was.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "im/filter.h"

namespace rink::bench {

struct RegionPair {
  std::uint32_t subscription, update;
};

/// Appends all pairs that overlap; building included.
using RegionMatch = void (*)(std::span<const im::Region> updates,
                             std::span<const im::Region> subscriptions,
                             std::vector<RegionPair>& pairs);

/// Boost.Geometry: a packed rtree of the updates, asked for each subscription. Null if Boost was
/// not there.
extern const RegionMatch match_by_rtree;
/// CGAL's box_intersection_d. Null if CGAL was not there.
extern const RegionMatch match_by_box_intersection;

/// Keeps two trees and moves one region at a time: removes it, inserts it anew and asks the other
/// tree around both places for overlaps that changed.
class MovingRegions {
 public:
  virtual ~MovingRegions() = default;
  virtual void move_update(std::uint32_t id, const im::Region& region,
                           std::vector<im::Change>& changes) = 0;
  virtual void move_subscription(std::uint32_t id, const im::Region& region,
                                 std::vector<im::Change>& changes) = 0;
};
std::unique_ptr<MovingRegions> make_moving_rtrees(std::span<const im::Region> updates,
                                                  std::span<const im::Region> subscriptions);

}  // namespace rink::bench
