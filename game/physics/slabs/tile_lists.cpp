// One look at everybody's next event and cell.
#include "game/physics/slabs/tile_lists.h"
#include "im/basics/sorted_set.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace rink::physics::inline RINK_PRECISION {

void TileLists::list_due(const Tiling& tiling, Real end, Workers* workers) {
  const std::span<const std::uint32_t> all = events_.windows()->listed();
  const std::size_t count = parts_.size();
  assert(workers == nullptr || workers->count() == count);
  auto list_part = [&](std::uint32_t worker) {
    const std::size_t first = all.size() * worker / count, last = all.size() * (worker + 1) / count;
    Part& part = parts_[worker];
    find_due(part, all.subspan(first, last - first), end);
    begin(part, tiling);
    add(part, tiling, part.due);
  };
  if (workers != nullptr) run_on(*workers, list_part);
  else
    for (std::uint32_t worker = 0; worker < count; ++worker) list_part(worker);
  wide_.clear();
  for (const Part& part : parts_) wide_.insert(wide_.end(), part.wide.begin(), part.wide.end());
  list_wide(tiling, end);
}

void TileLists::add_wide(std::span<const std::uint32_t> bodies) {
  wide_.insert(wide_.end(), bodies.begin(), bodies.end());
  make_sorted_set(wide_);
}

void TileLists::list_wide(const Tiling& tiling, Real end) {
  wide_by_tile_.resize(std::max<std::size_t>(wide_by_tile_.size(), tiling.count()));
  for (auto& list : wide_by_tile_) list.clear();
  const EventOrder* entries = events_.windows()->entries();
  for (const std::uint32_t body : wide_) {
    if (!(entries[body].time <= end)) continue;
    tiling.visit_with(cells_of(grid_, body),
                      [&](std::uint32_t tile) { wide_by_tile_[tile].push_back(body); });
  }
}

void TileLists::list(const Tiling& tiling, std::span<const std::uint32_t> bodies, Real end) {
  for (Part& part : parts_) begin(part, tiling);
  Part& own = parts_.front();
  const EventOrder* entries = events_.windows()->entries();
  own.joined.clear();
  for (const std::uint32_t body : bodies)
    if (entries[body].time <= end) own.joined.push_back(body);
  add(own, tiling, own.joined);
  list_wide(tiling, end);
}

void TileLists::find_due(Part& part, std::span<const std::uint32_t> bodies, Real end) const {
  part.due.clear(), part.wide.clear();
  const EventOrder* entries = events_.windows()->entries();
  for (const std::uint32_t body : bodies)
    if (entries[body].time <= end)
      (grid_.is_in_one_cell(body) ? part.due : part.wide).push_back(body);
}

void TileLists::begin(Part& part, const Tiling& tiling) const {
  part.by_tile.resize(std::max<std::size_t>(part.by_tile.size(), tiling.count()));
  for (auto& list : part.by_tile) list.clear();
  part.count = 0;
}

void TileLists::add(Part& part, const Tiling& tiling, std::span<const std::uint32_t> bodies) const {
  part.count += bodies.size();
  for (const std::uint32_t body : bodies) {
    assert(grid_.is_in_one_cell(body));
    const CellGrid::Place place = grid_.place(body);
    part.by_tile[tiling.tile_of(place.column, place.row)].push_back(body);
  }
}

std::span<const std::uint32_t> TileLists::in(std::uint32_t tile, std::uint32_t worker) {
  if (parts_.size() == 1) return parts_.front().by_tile[tile];
  std::vector<std::uint32_t>& joined = parts_[worker].joined;
  joined.clear();
  for (const Part& part : parts_)
    joined.insert(joined.end(), part.by_tile[tile].begin(), part.by_tile[tile].end());
  return joined;
}

std::size_t TileLists::count() const {
  std::size_t sum = 0;
  for (const Part& part : parts_) sum += part.count;
  return sum;
}

void TileLists::add_due_to(std::vector<std::uint32_t>& bodies) const {
  for (const Part& part : parts_) bodies.insert(bodies.end(), part.due.begin(), part.due.end());
  bodies.insert(bodies.end(), wide_.begin(), wide_.end());
}

}  // namespace rink::physics::inline RINK_PRECISION
