// Where every region is and where it was at the last match, with a list of those that moved in between.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "im/filter.h"

namespace rink::im {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Overlaps nothing, itself included; where an absent region is.
inline constexpr Region nowhere{infinity, infinity, -infinity, -infinity};

inline bool is_nowhere(const Region& region) { return region.low_x > region.high_x; }

/// Touching is overlap. Written without branches: in a join neither outcome is the likely one.
inline bool overlap(const Region& a, const Region& b) {
  return (a.low_x <= b.high_x) & (b.low_x <= a.high_x) & (a.low_y <= b.high_y) & (b.low_y <= a.high_y);
}

/// A region's two places: at the last match and now. Either may be `nowhere`.
struct Motion {
  Region before = nowhere, now = nowhere;
};

/// The regions of all entities, or of all subscribers, by id. Memory: 65 bytes per id up to the largest one used, 4 more per id that moved.
class RegionHistory {
 public:
  /// Adds or moves `id`; false, and nothing done, if it is there already.
  bool set(std::uint32_t id, const Region& region);
  /// Forgets `id`, its past included; false if it is not known.
  bool remove(std::uint32_t id);

  /// Ids run from 0 to size() - 1; some of them may be nowhere.
  std::size_t size() const { return motions_.size(); }
  const Motion& operator[](std::uint32_t id) const { return motions_[id]; }
  bool has_moved(std::uint32_t id) const { return is_listed_[id] != 0; }

  /// Sorts out and returns those whose place now is not the one before, in ascending order; has_moved agrees from here to `settle`.
  std::span<const std::uint32_t> take_moved();
  /// Makes now the new before.
  void settle();

 private:
  std::vector<Motion> motions_;
  std::vector<std::uint8_t> is_listed_;
  std::vector<std::uint32_t> moved_;
};

}  // namespace rink::im
