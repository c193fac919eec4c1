// Bins boxes by counting sort and finds those whose overlap with a subscription changed.
#include "im/cell_index.h"

#include <algorithm>
#include <cmath>

namespace rink::im {
namespace {

/// Fewer boxes per cell test fewer pairs but visit more cells: the time is flat from 1 to 5 (docs/im.md), so the fewest tests that cost no time.
constexpr double boxes_per_cell = 1.5;
/// A box that reaches farther than this many cells is looked at by everyone.
constexpr double reach_max_cells = 1.0;
/// Bounds the rounding of the sums and differences around a cell's edge, relative to the coordinates in the world.
constexpr double rounding = 1e-14;

double middle(double low, double high) { return 0.5 * low + 0.5 * high; }

double farthest(const Motion& motion, double x, double y) {
  // `nowhere` falls out of each minimum and maximum by itself.
  const double low_x = std::min(motion.before.low_x, motion.now.low_x), high_x = std::max(motion.before.high_x, motion.now.high_x);
  const double low_y = std::min(motion.before.low_y, motion.now.low_y), high_y = std::max(motion.before.high_y, motion.now.high_y);
  return std::max(std::max(x - low_x, high_x - x), std::max(y - low_y, high_y - y));
}

}  // namespace

/// Never decreases with `coordinate`, rounding included: all that the index relies on.
std::int32_t CellIndex::Axis::cell(double coordinate) const {
  const double position = (coordinate - origin) * cells_per_metre;
  return static_cast<std::int32_t>(std::min(std::max(position, 0.0), static_cast<double>(last)));
}

void CellIndex::lay_out(std::size_t count) {
  const double width = std::max(world_.high_x - world_.low_x, 1e-300), height = std::max(world_.high_y - world_.low_y, 1e-300);
  const double cells = std::max(1.0, static_cast<double>(count) / boxes_per_cell);
  const double columns = std::clamp(std::round(std::sqrt(cells * (width / height))), 1.0, cells);
  const double rows = std::max(1.0, std::floor(cells / columns));
  x_ = {world_.low_x, columns / width, static_cast<std::int32_t>(columns) - 1};
  y_ = {world_.low_y, rows / height, static_cast<std::int32_t>(rows) - 1};
  oversized_ = (x_.last + 1) * (y_.last + 1);
  reach_limit_ = reach_max_cells * std::max(width / columns, height / rows);
}

/// The bin of `motion`; notes how far it reaches.
std::int32_t CellIndex::bin(const Motion& motion) {
  const double x = middle(motion.now.low_x, motion.now.high_x), y = middle(motion.now.low_y, motion.now.high_y);
  const double reach = farthest(motion, x, y);
  if (reach > reach_limit_) return oversized_;
  reach_ = std::max(reach_, reach);
  has_newcomers_ |= is_nowhere(motion.before);
  return y_.cell(y) * (x_.last + 1) + x_.cell(x);
}

void CellIndex::build(std::span<const std::uint32_t> entities, const RegionHistory& motions) {
  lay_out(entities.size());
  reach_ = 0.0;
  has_newcomers_ = false;
  bins_.resize(entities.size());
  entries_.resize(entities.size());
  starts_.assign(static_cast<std::size_t>(oversized_) + 2, 0);
  for (std::size_t i = 0; i < entities.size(); ++i) {
    bins_[i] = bin(motions[entities[i]]);
    ++starts_[static_cast<std::size_t>(bins_[i])];
  }
  std::uint32_t end = 0;
  for (std::uint32_t& start : starts_) start = end += start;
  for (std::size_t i = entities.size(); i-- > 0;) entries_[--starts_[static_cast<std::size_t>(bins_[i])]] = {motions[entities[i]], entities[i]};
  const double largest = std::max({std::abs(world_.low_x), std::abs(world_.low_y), std::abs(world_.high_x), std::abs(world_.high_y)});
  reach_ += rounding * (largest + reach_limit_);
}

/// Cells whose boxes may overlap [low, high], now or before.
CellIndex::Span CellIndex::touched(const Axis& axis, double low, double high) const {
  if (low > high) return {0, -1};
  return {axis.cell(low - reach_), axis.cell(high + reach_)};
}

/// Cells whose boxes lie within [low, high], now and before: past the cell of the one limit and short of that of the other.
CellIndex::Span CellIndex::certain(const Axis& axis, double low, double high) const {
  if (has_newcomers_ || !(low + reach_ <= high - reach_)) return {0, -1};
  return {axis.cell(low + reach_) + 1, axis.cell(high - reach_) - 1};
}

void CellIndex::scan(std::size_t first, std::size_t end, const Motion& subscription, std::vector<std::uint32_t>& changed) {
  looked_at_ += end - first;
  const Motion wanted = subscription;
  for (std::size_t i = first; i < end; ++i) {
    const Entry& entry = entries_[i];
    if (overlap(entry.motion.before, wanted.before) != overlap(entry.motion.now, wanted.now)) changed.push_back(entry.entity);
  }
}

std::uint64_t CellIndex::find_changes(const Motion& subscription, std::vector<std::uint32_t>& changed) {
  const Region &a = subscription.before, &b = subscription.now;
  const Span columns = touched(x_, std::min(a.low_x, b.low_x), std::max(a.high_x, b.high_x));
  const Span rows = touched(y_, std::min(a.low_y, b.low_y), std::max(a.high_y, b.high_y));
  const Span inner_columns = certain(x_, std::max(a.low_x, b.low_x), std::min(a.high_x, b.high_x));
  const Span inner_rows = certain(y_, std::max(a.low_y, b.low_y), std::min(a.high_y, b.high_y));
  const bool has_inner = inner_columns.first <= inner_columns.last;
  looked_at_ = 0;
  for (std::int32_t row = rows.first; row <= rows.last; ++row) {
    const std::uint32_t* starts = &starts_[static_cast<std::size_t>(row) * static_cast<std::size_t>(x_.last + 1)];
    if (has_inner && inner_rows.first <= row && row <= inner_rows.last) {
      scan(starts[columns.first], starts[inner_columns.first], subscription, changed);
      scan(starts[inner_columns.last + 1], starts[columns.last + 1], subscription, changed);
    } else {
      scan(starts[columns.first], starts[columns.last + 1], subscription, changed);
    }
  }
  scan(starts_[static_cast<std::size_t>(oversized_)], starts_[static_cast<std::size_t>(oversized_) + 1], subscription, changed);
  return looked_at_;
}

}  // namespace rink::im
