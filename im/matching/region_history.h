// Where every region is and where it was at the last match, with a list of those that moved in
// between.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "im/filter.h"
#include "im/matching/buffer.h"

namespace rink::im {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Overlaps nothing, itself included; where an absent region is.
inline constexpr Region nowhere{infinity, infinity, -infinity, -infinity};

inline bool is_nowhere(const Region& region) { return region.low_x > region.high_x; }

/// Touching is overlap. Written without branches: in a join neither outcome is the likely one.
inline bool overlap(const Region& a, const Region& b) {
  return (a.low_x <= b.high_x) & (b.low_x <= a.high_x) & (a.low_y <= b.high_y) &
         (b.low_y <= a.high_y);
}

/// A region's two places: at the last match and now. Either may be `nowhere`. One line of memory.
struct alignas(64) Motion {
  Region before = nowhere, now = nowhere;
};

/// The regions of all entities, or of all subscribers, by id. Memory: 64 bytes and a bit per id up
/// to the largest one used, 8 more per id that moved. Most often all move at every match, so
/// `before` is written when a region first moves, to its line that is at hand anyway, and not by a
/// pass over all.
class RegionHistory {
 public:
  /// Ids are less than this.
  static constexpr std::uint32_t id_max = 0x7FFFFFFF;

  /// Adds or moves `id`; false, and nothing done, if it is there already.
  bool set(std::uint32_t id, const Region& region);
  /// Lists `id` as moved, though it stays, since something else about it changed. Ignored if it is
  /// not known.
  void touch(std::uint32_t id);
  /// True if `id` is somewhere.
  bool contains(std::uint32_t id) const {
    return id < motions_.size() && !is_nowhere(motions_[id].now);
  }
  /// Forgets `id`, its past included; false if it is not known.
  bool remove(std::uint32_t id);

  /// Ids run from 0 to size() - 1; some of them may be nowhere.
  std::size_t size() const { return motions_.size(); }
  /// How many are somewhere.
  std::size_t present_count() const { return motions_.size() - absent_count_; }
  const Motion& operator[](std::uint32_t id) const { return motions_[id]; }
  bool has_moved(std::uint32_t id) const { return is_listed(id); }
  /// The place of `id`, which is known, at the last match; maybe nowhere.
  const Region& last_place(std::uint32_t id) const {
    return is_listed(id) ? motions_[id].before : motions_[id].now;
  }

  /// The ids that were set to another place since the last match (and maybe back again), in
  /// ascending order; has_moved and `before` agree from here to `settle`.
  std::span<const std::uint32_t> take_moved();
  /// The ids that `take_moved` returned, until `settle`.
  std::span<const std::uint32_t> moved() const { return moved_.span(); }
  /// Makes now the new before.
  void settle();

  /// Asks the processor for a motion that will be wanted soon.
  void prefetch(std::uint32_t id) const { __builtin_prefetch(&motions_[id]); }

  /// Asserts that the list of movers, their marks and the count of those absent agree.
  void check() const;
  std::size_t bytes() const {
    return sizeof(Motion) * motions_.capacity() + sizeof(std::uint64_t) * listed_.capacity() +
           sizeof(std::uint32_t) * (moved_.capacity() + settled_.capacity());
  }

 private:
  void grow(std::size_t count);
  void list(std::uint32_t id);
  void unlist(std::uint32_t id);
  void drop_removed();
  bool is_listed(std::uint32_t id) const { return (listed_[id / 64] >> id % 64 & 1u) != 0; }

  Buffer<Motion> motions_;
  Buffer<std::uint64_t> listed_;  // a bit for each id
  Buffer<std::uint32_t> moved_;
  Buffer<std::uint32_t>
      settled_;  // moved at the match before: their `before` is out of date unless they move again
  bool has_removed_ = false, is_ascending_ = true;  // what is in `moved_`
  std::size_t absent_count_ = 0;  // nearly always 0, and then no new region need be checked for one
};

}  // namespace rink::im
