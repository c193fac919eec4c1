// Where bodies are listed, and how far the widest of them reaches.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "game/physics/body.h"
#include "game/physics/cell_grid.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// A grid that fits the number of bodies and their size.
class Places {
 public:
  explicit Places(const WorldSpec& spec) : field_(spec.field), cell_size_(spec.cell_size) {
    rebuild(1);
  }
  Places(const Places&) = delete;
  Places& operator=(const Places&) = delete;

  const CellGrid& grid() const { return grid_; }
  /// The largest half extent of any body [m].
  Real reach() const { return reach_; }
  /// Whether the grid was made for so many bodies, of which one reaches so far.
  bool fits(std::uint32_t count, Real reach) const { return count <= capacity_ && reach <= reach_; }
  /// From the next rebuild() on it is.
  void fit(std::uint32_t count, Real reach) {
    assert(reach >= 0.0);
    reach_ = std::max(reach_, reach);
    capacity_ = std::max(64u, 2 * count);
  }
  /// Cells for `count` bodies, none of them listed.
  void rebuild(std::uint32_t count) {
    grid_.rebuild(field_.length, field_.width, static_cast<double>(2.0 * reach_), count,
                  cell_size_);
  }

  /// Bodies 0 to `count` - 1 can be listed.
  void resize(std::uint32_t count) { grid_.resize(count); }
  void insert(std::uint32_t body, const RealVector& position) {
    grid_.insert(body, static_cast<double>(position.x()), static_cast<double>(position.y()));
  }
  void remove(std::uint32_t body) { grid_.remove(body); }
  void move(std::uint32_t body, CellGrid::Direction direction) { grid_.move(body, direction); }

 private:
  Field field_;
  double cell_size_;
  CellGrid grid_;
  Real reach_ = 0.0;
  std::uint32_t capacity_ = 0;
};

}  // namespace rink::physics::inline RINK_PRECISION
