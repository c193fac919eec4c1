// Blocks of cells that bodies enter and leave.
#include "game/physics/grid/wide_bodies.h"

#include <cmath>
#include <limits>

namespace rink::physics {

namespace {

struct Span {
  std::uint32_t low, high;
};

/// Cells along an axis for what reaches `half` to both sides, and one more: in their middle the
/// centre is half a side away from where it leaves them.
Span span_around(double centre, double half, double side, std::uint32_t count) {
  const double cells = 1.0 + std::ceil(2.0 * half / side + 1.0 / 64.0);
  if (cells >= count) return {0, count - 1};
  const double low = std::clamp(std::floor(centre / side - 0.5 * cells + 0.5), 0.0, count - cells);
  return {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(low + cells) - 1};
}

}  // namespace

CellBlock moved(CellBlock block, CellLists::Direction direction) {
  const std::uint32_t step = (direction & 1) != 0 ? 1 : 0u - 1;
  if (direction <= CellLists::right) block.column_low += step, block.column_high += step;
  else block.row_low += step, block.row_high += step;
  return block;
}

void WideBodies::restart(double side, std::uint32_t columns, std::uint32_t rows) {
  assert(side > 0.0);
  side_ = side, columns_ = columns, rows_ = rows, count_ = 0;
  wides_.clear(), free_.clear();
}

std::uint32_t WideBodies::add(const Wide& wide, double x, double y) {
  if (wides_.empty()) slots_.restart(columns_, rows_);
  if (free_.empty()) {
    assert(wides_.size() < slot_max);
    free_.push_back(static_cast<std::uint32_t>(wides_.size()));
    wides_.push_back({});
  }
  const std::uint32_t slot = free_.back();
  free_.pop_back();
  ++count_;
  const Span across = span_around(x, wide.half_width, side_, columns_),
             along = span_around(y, wide.half_height, side_, rows_);
  wides_[slot] = wide;
  wides_[slot].block = {across.low, along.low, across.high, along.high};
  enter(slot, wides_[slot].block);
  return slot;
}

void WideBodies::remove(std::uint32_t slot) {
  leave(slot, wides_[slot].block);
  wides_[slot].body = nobody;
  free_.push_back(slot);
  --count_;
}

void WideBodies::move(std::uint32_t slot, CellLists::Direction direction) {
  CellBlock& block = wides_[slot].block;
  const CellBlock to = moved(block, direction);
  assert(to.column_high < columns_ && to.row_high < rows_);
  leave(slot, block.beyond(to));
  enter(slot, to.beyond(block));
  block = to;
}

bool WideBodies::has_room_beyond(std::uint32_t slot, CellLists::Direction direction) const {
  const CellBlock& block = wides_[slot].block;
  const CellBlock strip = moved(block, direction).beyond(block);
  for (std::uint32_t row = strip.row_low; row <= strip.row_high; ++row)
    for (std::uint32_t column = strip.column_low; column <= strip.column_high; ++column)
      if (!slots_.has_room(slots_.at(column, row))) return false;
  return true;
}

std::array<double, 4> WideBodies::edges(std::uint32_t slot) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto& [body, block, half_width, half_height] = wides_[slot];
  return {
      block.column_low == 0 ? -infinity : block.column_low * side_ + half_width,
      block.column_high + 1 == columns_ ? infinity : (block.column_high + 1) * side_ - half_width,
      block.row_low == 0 ? -infinity : block.row_low * side_ + half_height,
      block.row_high + 1 == rows_ ? infinity : (block.row_high + 1) * side_ - half_height};
}

void WideBodies::enter(std::uint32_t slot, const CellBlock& cells) {
  for (std::uint32_t row = cells.row_low; row <= cells.row_high; ++row)
    for (std::uint32_t column = cells.column_low; column <= cells.column_high; ++column)
      slots_.add(slots_.at(column, row), slot);
}

void WideBodies::leave(std::uint32_t slot, const CellBlock& cells) {
  for (std::uint32_t row = cells.row_low; row <= cells.row_high; ++row)
    for (std::uint32_t column = cells.column_low; column <= cells.column_high; ++column)
      slots_.remove(slots_.at(column, row), slot);
}

}  // namespace rink::physics
