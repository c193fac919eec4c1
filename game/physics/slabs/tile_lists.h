// Who has an event in which tile.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/engine/next_events.h"
#include "game/physics/grid/cell_grid.h"
#include "game/physics/real.h"
#include "game/physics/slabs/tiling.h"
#include "game/physics/workers.h"

namespace rink::physics::inline RINK_PRECISION {

/// The bodies of a pass by tile: each small one in that of its cell, each wide one, which has its
/// events in the last pass, in all where it stands. Each worker lists a part of them, and all do so
/// at once: to look at everybody's next event takes a thirtieth of the time of a window, and more
/// where another core has written it.
class TileLists {
 public:
  TileLists(const CellGrid& grid, NextEvents& events, std::uint32_t workers)
      : grid_(grid), events_(events), parts_(workers) {}

  /// Lists all whose next event comes by `end`, by `workers`, or by the caller if null.
  void list_due(const Tiling& tiling, Real end, Workers* workers);
  /// Those of `bodies`, by the caller.
  void list(const Tiling& tiling, std::span<const std::uint32_t> bodies, Real end);

  /// Those who are listed in `tile`; different workers may ask at once. Valid until `worker` asks
  /// again.
  std::span<const std::uint32_t> in(std::uint32_t tile, std::uint32_t worker);
  /// Who is wide, has an event and stands there.
  std::span<const std::uint32_t> wide_in(std::uint32_t tile) const { return wide_by_tile_[tile]; }
  /// Some who have been put off, as well; from the next list() on.
  void add_wide(std::span<const std::uint32_t> bodies);
  /// All of these.
  std::span<const std::uint32_t> wide() const { return wide_; }
  /// How many small ones are listed.
  std::size_t count() const;
  /// Adds to `bodies` all that list_due() has listed last.
  void add_due_to(std::vector<std::uint32_t>& bodies) const;

 private:
  /// A worker's part.
  struct alignas(64) Part {
    std::vector<std::vector<std::uint32_t>> by_tile;
    std::vector<std::uint32_t> due, wide, joined;
    std::size_t count = 0;
  };

  void list_wide(const Tiling& tiling, Real end);
  void begin(Part& part, const Tiling& tiling) const;
  void add(Part& part, const Tiling& tiling, std::span<const std::uint32_t> bodies) const;
  void find_due(Part& part, std::span<const std::uint32_t> bodies, Real end) const;

  const CellGrid& grid_;
  NextEvents& events_;
  std::vector<Part> parts_;
  std::vector<std::uint32_t> wide_;
  std::vector<std::vector<std::uint32_t>> wide_by_tile_;
};

}  // namespace rink::physics::inline RINK_PRECISION
