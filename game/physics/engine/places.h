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

/// A grid that fits the number of bodies, their size and where they are.
class Places {
 public:
  explicit Places(const WorldSpec& spec)
      : ground_{0.0, 0.0, spec.field.length, spec.field.width}, cell_size_(spec.cell_size) {
    rebuild(1);
  }
  Places(const Places&) = delete;
  Places& operator=(const Places&) = delete;

  const CellGrid& grid() const { return grid_; }
  /// The largest half extent of any body that stands in one cell [m].
  Real reach() const { return reach_; }
  /// Whether the grid was made for so many bodies, of which one reaches so far, and few lie beyond
  /// its ground.
  bool fits(std::uint32_t count, Real reach) const {
    constexpr std::uint32_t few = 64, one_in = 16;
    return count <= capacity_ && (reach <= reach_ || grid_.wide().count() < wide_max_) &&
           beyond_ <= few + count / one_in;
  }
  /// From the next rebuild() on it is.
  void fit(std::uint32_t count, Real reach) {
    assert(reach >= 0.0);
    reach_ = std::max(reach_, reach);
    capacity_ = std::max(64u, 2 * count);
  }
  /// From the next rebuild() on there are cells for this part of the field only, where all bodies
  /// are for now.
  void cover(const CellGrid::Ground& ground) { ground_ = ground; }
  /// Cells for `count` bodies, none of them listed; no body is wide.
  void rebuild(std::uint32_t count) {
    wide_max_ = 0, beyond_ = 0;
    grid_.rebuild(ground_, static_cast<double>(2.0 * reach_), count, cell_size_);
  }
  /// The same where `sizes` tell which bodies should be wide. Twice as many may be, before the
  /// cells are made anew.
  void rebuild(std::uint32_t count, const SizeClasses& sizes) {
    const SizeClasses::Choice choice =
        sizes.choose(ground_.length * ground_.width, [&](double reach) {
          return cell_side({ground_.length, ground_.width, count, cell_size_}, 2.0 * reach);
        });
    reach_ = choice.reach;
    rebuild(count);
    wide_max_ = 2 * choice.wide_count;
  }

  /// Bodies 0 to `count` - 1 can be listed.
  void resize(std::uint32_t count) { grid_.resize(count); }
  void insert(std::uint32_t body, const RealVector& position) {
    beyond_ += is_beyond(position);
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
  [[gnu::always_inline]] bool move_in_place(std::uint32_t body, CellGrid::Direction direction) {
    return grid_.move_in_place(body, direction);
  }

 private:
  bool is_beyond(const RealVector& position) const {
    const auto x = static_cast<double>(position.x()) - ground_.low_x,
               y = static_cast<double>(position.y()) - ground_.low_y;
    return x < 0.0 || y < 0.0 || x > ground_.length || y > ground_.width;
  }

  CellGrid::Ground ground_;
  double cell_size_;
  CellGrid grid_;
  Real reach_ = 0.0;
  std::uint32_t capacity_ = 0, wide_max_ = 0;
  std::uint32_t beyond_ = 0;  ///< bodies that were listed beyond the ground since rebuild()
};

}  // namespace rink::physics::inline RINK_PRECISION
