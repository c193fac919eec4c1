// Many boxes, each stored once, in the order of their cells: built at once, queried often, thrown
// away.
#pragma once

#include <cassert>
#include <cstdint>
#include <span>

#include "im/matching/buffer.h"
#include "im/matching/index/box_store.h"
#include "im/matching/index/cell_level.h"
#include "im/matching/index/scan.h"
#include "im/matching/index/size_levels.h"
#include "im/matching/probe_list.h"
#include "im/matching/projection.h"
#include "im/matching/region_history.h"

namespace rink::im {

/// What is staged, and who asks: boxes that rest, or that move; of these each asker alone, or
/// neighbours together (group_join.h).
enum class Boxes : std::uint8_t { resting, moving, moving_for_groups };

/// Stage boxes, then `build`, then ask. A box may be moving: then it is binned by the hull of where
/// it was and where it is.
class BoxIndex {
 public:
  /// Starts anew, with room for `count_max` boxes in a world of positive area.
  void begin(const Region& world, std::size_t count_max, Boxes kind);
  /// Adds a resting box.
  void stage(std::uint32_t id, const Region& region);
  /// Adds a box that may have come from elsewhere, or from nowhere.
  void stage(std::uint32_t id, const Motion& motion);
  /// Bins what was staged by counting sort: linear in boxes and cells.
  void build();
  /// Updates the places of all moving boxes: each stays in its cell, and queries reach as much
  /// farther as boxes have moved since. `regions` has their present places, and as last places
  /// those that are known here. False if they have moved or grown too far for that to pay: then the
  /// index must be built anew.
  bool follow(const RegionHistory& regions, Instructions instructions = Instructions::best);

  std::size_t size() const { return ids_.size(); }
  /// In the order of their cells.
  std::span<const std::uint32_t> ids() const { return ids_.span(); }
  /// True if no projection lost anything.
  bool is_exact() const { return is_exact_; }
  Candidates candidates() const {
    return {is_moving_ ? before_.columns() : now_.columns(), now_.columns(), ids_.data()};
  }
  /// The boxes in the order of their cells, as questions to another index.
  Probe probe(std::size_t i) const {
    return {is_moving_ ? before_[i] : now_[i], now_[i], ids_[i], 0};
  }

  /// Appends where boxes may overlap `box`; returns how many.
  std::size_t find_overlaps(const FloatBox& box, Buffer<Stretch>& stretches) const;
  /// Appends where boxes may have an overlap with `probe` that changed; returns how many. Cells
  /// well inside both its places hold none.
  std::size_t find_changes(const Probe& probe, Buffer<Stretch>& stretches) const {
    return find_changes(hull_of(probe.before, probe.now), core_of(probe.before, probe.now),
                        stretches);
  }
  /// As above for several probes, all of whose places are within `hull` and hold `core`.
  std::size_t find_changes(const FloatBox& hull, const FloatBox& core,
                           Buffer<Stretch>& stretches) const;
  /// As above for a query about the probe's disc.
  std::size_t find_disc_changes(const Probe& probe, Buffer<Stretch>& stretches) const;

  std::size_t bytes() const;
  /// Asserts that every box is in a cell, all of those staged are there, and each finds itself.
  void check() const;

 private:
  void check(const CellLevel& level) const;
  void count_cells();
  template <class LevelOf>
  void count_cells(const LevelOf& level_of);
  void sort();
  FloatBox hull(std::size_t staged) const;
  void take_up(const Advanced& advanced, CellLevel& level);
  template <class Query>
  std::size_t collect(const CellLevel& level, const Query& query, Buffer<Stretch>& stretches) const;

  Region world_;
  Projection projection_;
  bool is_moving_ = false, is_for_groups_ = false, is_exact_ = true;
  SizeLevels sizes_;
  CellLevels levels_;
  std::uint32_t follow_count_ = 0;  // since it was built
  bool may_follow_ = true;          // as far as the last step tells
  // As staged; the buffers have room for what was announced.
  std::size_t staged_count_ = 0;
  Buffer<FloatBox> staged_before_, staged_now_;
  Buffer<std::uint32_t> staged_ids_, cells_;
  // In the order of the cells.
  Buffer<std::uint32_t> starts_;  // of each cell, and the end
  Buffer<std::uint32_t> ids_;
  BoxStore before_, now_;
};

inline void BoxIndex::stage(std::uint32_t id, const Region& region) {
  assert(!is_moving_ && staged_count_ < staged_ids_.size());
  const FloatBox box = projection_(region);
  if (is_exact_) is_exact_ = projection_.is_exact(region, box);
  sizes_.count(longer_side(box));
  staged_ids_[staged_count_] = id;
  staged_now_[staged_count_++] = box;
}

inline void BoxIndex::stage(std::uint32_t id, const Motion& motion) {
  assert(is_moving_ && staged_count_ < staged_ids_.size());
  assert(!is_nowhere(motion.now));
  const ProjectedMotion projected = project(projection_, motion, is_exact_);
  sizes_.count(longer_side(hull_of(projected.before, projected.now)));
  staged_ids_[staged_count_] = id;
  staged_before_[staged_count_] = projected.before;
  staged_now_[staged_count_++] = projected.now;
}

}  // namespace rink::im
