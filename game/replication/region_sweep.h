// Update regions that reach ahead over an entity's places in the next ticks, so that a filter's
// decision still holds when it has aged.
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include "game/physics/movers.h"
#include "game/physics/world.h"
#include "im/filter.h"

namespace rink::game {

/// The bounding box of a body with its centre there.
inline im::Region bounding_box(const physics::Vector2& centre,
                               const physics::Vector2& half_extent) {
  assert(half_extent.x() >= 0.0 && half_extent.y() >= 0.0);
  return {centre.x() - half_extent.x(), centre.y() - half_extent.y(), centre.x() + half_extent.x(),
          centre.y() + half_extent.y()};
}

/// The box that holds the centre of a body on `motion` at every instant from `from` to `until` [s],
/// neither before motion.time.
im::Region path_box(const physics::Motion& motion, double from, double until);

/// Decides the reach of update regions. A region is the box of the entity's own path over the next
/// `ticks`, grown by what an impact within one tick can add: 2 (|v| + s) tick with v its own and s
/// the greatest speed on the rink, for a body of speed s, however heavy, gives another at most 2 s
/// and the grown region is replaced at the next tick (docs/im.md). Regions that still hold are not
/// set again, so a filter has less to do.
class RegionSweep {
 public:
  /// The origin of a region that was set.
  struct Swept {
    std::uint32_t version = 0;  ///< of the motion
    double until_s = -1.0;      ///< the region holds for decisions made up to here
  };

  RegionSweep() = default;
  RegionSweep(std::uint32_t ticks, double tick_s) : ticks_(ticks), tick_s_(tick_s) {
    assert(ticks == 0 || tick_s > 0.0);
  }

  bool is_on() const { return ticks_ > 0; }
  /// Call it first once a tick: finds a bound of the fastest body's speed from `movers`, which must
  /// be up to date for this tick.
  void look_at(const physics::World& world, const physics::Movers& movers);
  /// True if the region made for `body` covers the coming tick.
  bool still_holds(const physics::World& world, physics::BodyId body, const Swept& swept) const;
  /// A new region for `body` from world.now() on, noted in `swept`.
  im::Region region(const physics::World& world, physics::BodyId body, Swept& swept) const;
  /// The instant [s] until which `swept` holds while the motion does not change.
  double holds_until(const Swept& swept) const { return swept.until_s - tick_s_ * (1.0 + 1e-6); }

 private:
  std::uint32_t ticks_ = 0;
  double tick_s_ = 0.0;
  double fastest_ = 0.0;        ///< m/s, no body is faster until something hits it
  std::vector<double> speeds_;  ///< by body: bound of its speed on its present path [m/s]
};

}  // namespace rink::game
