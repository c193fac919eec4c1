// Many boxes, each stored once, in the order of the cells they are in: built at a stroke, asked often, thrown away.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "im/matching/buffer.h"
#include "im/matching/cell_level.h"
#include "im/matching/projection.h"
#include "im/matching/scan.h"
#include "im/matching/size_levels.h"

namespace rink::im {

/// Four columns of boxes.
class BoxStore {
 public:
  void resize(std::size_t count);
  void set(std::size_t i, const FloatBox& box) { low_x_[i] = box.low_x, low_y_[i] = box.low_y, high_x_[i] = box.high_x, high_y_[i] = box.high_y; }
  FloatBox operator[](std::size_t i) const { return {low_x_[i], low_y_[i], high_x_[i], high_y_[i]}; }
  BoxColumns columns() const { return {low_x_.data(), low_y_.data(), high_x_.data(), high_y_.data()}; }
  std::size_t bytes() const { return 4 * sizeof(float) * low_x_.capacity(); }

 private:
  Buffer<float> low_x_, low_y_, high_x_, high_y_;
};

/// Stage boxes, then `build`, then ask. A box may be moving: then it is binned by the hull of where it was and where it is.
class BoxIndex {
 public:
  /// Starts anew, with room for `count_max` boxes in a world of positive area.
  void begin(const Region& world, std::size_t count_max, bool is_moving);
  /// Adds a resting box.
  void stage(std::uint32_t id, const Region& region);
  /// Adds a box that was at `before`, maybe nowhere, and is at `now`.
  void stage(std::uint32_t id, const Region& before, const Region& now);
  /// Bins what was staged by counting sort: linear in boxes and cells.
  void build();

  std::size_t size() const { return ids_.size(); }
  /// True if no projection lost anything.
  bool is_exact() const { return is_exact_; }
  Candidates candidates() const { return {is_moving_ ? before_.columns() : now_.columns(), now_.columns(), ids_.data()}; }
  /// The boxes in the order of their cells, as questions to another index.
  Probe probe(std::size_t i) const { return {is_moving_ ? before_[i] : now_[i], now_[i], ids_[i], 0}; }

  /// Appends where boxes may overlap `box`; returns how many.
  std::size_t find_overlaps(const FloatBox& box, Buffer<Stretch>& stretches) const;
  /// Appends where boxes may have an overlap with `probe` that changed; returns how many. Cells well inside both its places hold none.
  std::size_t find_changes(const Probe& probe, Buffer<Stretch>& stretches) const;

  std::size_t bytes() const;

 private:
  double crowding() const;
  void choose_levels();
  void count_cells();
  void sort();
  FloatBox hull(std::size_t staged) const;
  std::size_t collect(const CellLevel& level, CellRange columns, CellRange rows, CellRange inner_columns, CellRange inner_rows, Buffer<Stretch>& stretches) const;

  Region world_;
  Projection projection_;
  bool is_moving_ = false, is_exact_ = true;
  SizeLevels sizes_;
  std::vector<CellLevel> levels_;
  // As staged.
  Buffer<FloatBox> staged_before_, staged_now_;
  Buffer<std::uint32_t> staged_ids_, cells_;
  // In the order of the cells.
  Buffer<std::uint32_t> starts_;  // of each cell, and the end
  Buffer<std::uint32_t> ids_;
  BoxStore before_, now_;
};

/// The smallest box that holds both.
inline FloatBox hull_of(const FloatBox& a, const FloatBox& b) {
  return {std::min(a.low_x, b.low_x), std::min(a.low_y, b.low_y), std::max(a.high_x, b.high_x), std::max(a.high_y, b.high_y)};
}

inline float longer_side(const FloatBox& box) { return std::max(box.high_x - box.low_x, box.high_y - box.low_y); }

inline void BoxIndex::stage(std::uint32_t id, const Region& region) {
  const std::size_t i = staged_ids_.size();
  const FloatBox box = projection_(region);
  if (is_exact_) is_exact_ = projection_.is_exact(region, box);
  sizes_.count(longer_side(box));
  staged_ids_.resize(i + 1);
  staged_now_.resize(i + 1);
  staged_ids_[i] = id;
  staged_now_[i] = box;
}

inline void BoxIndex::stage(std::uint32_t id, const Region& before, const Region& now) {
  const std::size_t i = staged_ids_.size();
  const bool is_newcomer = before.low_x > before.high_x;
  const FloatBox then = is_newcomer ? float_nowhere : projection_(before), today = projection_(now);
  if (is_exact_) is_exact_ = projection_.is_exact(now, today) && (is_newcomer || projection_.is_exact(before, then));
  sizes_.count(longer_side(hull_of(then, today)));
  staged_ids_.resize(i + 1);
  staged_before_.resize(i + 1);
  staged_now_.resize(i + 1);
  staged_ids_[i] = id;
  staged_before_[i] = then;
  staged_now_[i] = today;
}

}  // namespace rink::im
