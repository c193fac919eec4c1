// Places and boxes to cells, and cells to runs.
#include "game/node/cells.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace rink::game {
namespace {

double count_along(double length, double side) { return std::max(1.0, std::ceil(length / side)); }

/// The number of the cell, the nearest one for a place outside.
std::uint32_t cell_at(double place, double side, std::uint32_t count) {
  const double cell = std::floor(place / side);
  return cell > 0.0 ? std::min(static_cast<std::uint32_t>(std::min(cell, 1e9)), count - 1) : 0u;
}

}  // namespace

bool Cells::fit(const physics::Field& field, double side) {
  return std::isfinite(side) && side > 0.0 &&
         count_along(field.length, side) * count_along(field.width, side) <= count_max;
}

Cells::Cells(const physics::Field& field, double side)
    : side_(side),
      columns_(static_cast<std::uint32_t>(count_along(field.length, side))),
      rows_(static_cast<std::uint32_t>(count_along(field.width, side))),
      is_marked_(std::size_t{columns_} * rows_) {
  assert(fit(field, side));
}

Cells Cells::all_of(const physics::Field& field) {
  Cells all(field, std::max(field.length, field.width));
  all.is_marked_.assign(all.is_marked_.size(), true);
  return all;
}

std::uint32_t Cells::column(double x) const { return cell_at(x, side_, columns_); }
std::uint32_t Cells::row(double y) const { return cell_at(y, side_, rows_); }

void Cells::mark(const im::Region& region) {
  assert(region.low_x <= region.high_x && region.low_y <= region.high_y);
  const std::uint32_t first = column(region.low_x), last = column(region.high_x);
  for (std::uint32_t r = row(region.low_y); r <= row(region.high_y); ++r)
    std::fill(is_marked_.begin() + static_cast<std::ptrdiff_t>(index(first, r)),
              is_marked_.begin() + static_cast<std::ptrdiff_t>(index(last, r)) + 1, true);
}

void Cells::mark_common(const Cells& a, const Cells& b) {
  assert(a.side_ == side_ && b.side_ == side_);
  assert(a.count() == count() && b.count() == count());
  for (std::size_t cell = 0; cell < count(); ++cell)
    if (a.is_marked_[cell] && b.is_marked_[cell]) is_marked_[cell] = true;
}

std::vector<std::uint32_t> Cells::runs() const {
  std::vector<std::uint32_t> runs{0};
  bool is_run_marked = false;
  for (const bool is_marked : is_marked_) {
    if (is_marked != is_run_marked) runs.push_back(0);
    is_run_marked = is_marked;
    ++runs.back();
  }
  return runs;
}

std::optional<Cells> Cells::of_runs(const physics::Field& field, double side,
                                    const std::vector<std::uint32_t>& runs) {
  if (!fit(field, side)) return std::nullopt;
  Cells cells(field, side);
  const std::uint64_t sum = std::accumulate(runs.begin(), runs.end(), std::uint64_t{0});
  if (sum != cells.count()) return std::nullopt;
  auto next = cells.is_marked_.begin();
  bool is_marked = false;
  for (const std::uint32_t run : runs) {
    next = std::fill_n(next, run, is_marked);
    is_marked = !is_marked;
  }
  return cells;
}

}  // namespace rink::game
