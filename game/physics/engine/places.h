// Where bodies are listed, and which of them are too wide for one cell.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "game/physics/body.h"
#include "game/physics/grid/cell_grid.h"
#include "game/physics/grid/size_classes.h"
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
  /// The largest half extent of any body that stands in one cell [m].
  Real reach() const { return reach_; }
  /// Whether the grid was made for so many bodies, of which one reaches so far.
  bool fits(std::uint32_t count, Real reach) const {
    return count <= capacity_ && (reach <= reach_ || grid_.wide().count() < wide_max_);
  }
  /// From the next rebuild() on it is.
  void fit(std::uint32_t count, Real reach) {
    assert(reach >= 0.0);
    reach_ = std::max(reach_, reach);
    capacity_ = std::max(64u, 2 * count);
  }
  /// Cells for `count` bodies, none of them listed; no body is wide.
  void rebuild(std::uint32_t count) {
    wide_max_ = 0;
    grid_.rebuild(field_.length, field_.width, static_cast<double>(2.0 * reach_), count,
                  cell_size_);
  }
  /// The same where `sizes` tell which bodies should be wide. Twice as many may be, before the
  /// cells are made anew.
  void rebuild(std::uint32_t count, const SizeClasses& sizes) {
    const SizeClasses::Choice choice =
        sizes.choose(field_.length * field_.width, [&](double reach) {
          return cell_side({field_.length, field_.width, count, cell_size_}, 2.0 * reach);
        });
    reach_ = choice.reach;
    rebuild(count);
    wide_max_ = 2 * choice.wide_count;
  }

  /// Bodies 0 to `count` - 1 can be listed.
  void resize(std::uint32_t count) { grid_.resize(count); }
  void insert(std::uint32_t body, const RealVector& position) {
    grid_.insert(body, static_cast<double>(position.x()), static_cast<double>(position.y()));
  }
  /// Its own box reaches so far from there.
  void insert(std::uint32_t body, const RealVector& position, const RealVector& extent) {
    if (extent.maxCoeff() <= reach_) return insert(body, position);
    grid_.insert_wide(body, {.x = static_cast<double>(position.x()),
                             .y = static_cast<double>(position.y()),
                             .half_width = static_cast<double>(extent.x()),
                             .half_height = static_cast<double>(extent.y())});
  }
  void remove(std::uint32_t body) { grid_.remove(body); }
  [[gnu::always_inline]] void move(std::uint32_t body, CellGrid::Direction direction) {
    grid_.move(body, direction);
  }

 private:
  Field field_;
  double cell_size_;
  CellGrid grid_;
  Real reach_ = 0.0;
  std::uint32_t capacity_ = 0, wide_max_ = 0;
};

}  // namespace rink::physics::inline RINK_PRECISION
