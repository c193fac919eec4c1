// Boxes of closed-form paths, and the bound on what an impact can add to them.
#include "game/replication/region_sweep.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace rink::game {
namespace {

/// The instant after motion.time at which the velocity along `axis` is zero on the way from one
/// direction to the other; infinity if there is none.
double turning_instant(const physics::Motion& motion, int axis) {
  // v e + a s = v - s (g v - a) vanishes at s = v/(g v - a); s = (1 - exp(-g t))/g
  // (docs/physics.md, "Motion").
  const double v = motion.velocity[axis], a = motion.acceleration[axis], g = motion.drag[axis];
  const double never = std::numeric_limits<double>::infinity(), denominator = g * v - a;
  if (v * a >= 0.0 || denominator == 0.0)
    return never;  // no thrust against the velocity: drag alone never turns a body
  const double s = v / denominator;
  if (s <= 0.0 || g * s >= 1.0) return never;
  return motion.time + (g == 0.0 ? s : -std::log1p(-g * s) / g);
}

/// The speed on the present path is at most that at its start, or the terminal speed of its
/// acceleration against drag.
double speed_bound(const physics::Motion& motion, double ahead_s) {
  assert(ahead_s >= 0.0);
  physics::Vector2 reach;
  for (int axis = 0; axis < 2; ++axis) {
    const double terminal =
        motion.drag[axis] > 0.0
            ? std::abs(motion.acceleration[axis]) / motion.drag[axis]
            : std::abs(motion.velocity[axis]) + std::abs(motion.acceleration[axis]) * ahead_s;
    reach[axis] = std::max(std::abs(motion.velocity[axis]), terminal);
  }
  return reach.norm();
}

}  // namespace

im::Region path_box(const physics::Motion& motion, double from, double until) {
  assert(from <= until);
  const physics::Vector2 first = motion.at(from).position, last = motion.at(until).position;
  std::array<double, 2> low{std::min(first.x(), last.x()), std::min(first.y(), last.y())},
      high{std::max(first.x(), last.x()), std::max(first.y(), last.y())};
  for (int axis = 0; axis < 2; ++axis) {
    const double turning = turning_instant(motion, axis);
    if (!(turning > from && turning < until)) continue;
    const double extreme = motion.at(turning).position[axis];
    low[static_cast<std::size_t>(axis)] = std::min(low[static_cast<std::size_t>(axis)], extreme);
    high[static_cast<std::size_t>(axis)] = std::max(high[static_cast<std::size_t>(axis)], extreme);
  }
  assert(low[0] <= high[0] && low[1] <= high[1]);
  return {low[0], low[1], high[0], high[1]};
}

void RegionSweep::look_at(const physics::World& world, const physics::Movers& movers) {
  if (!is_on()) return;
  speeds_.resize(world.body_count(), 0.0);
  for (const physics::BodyId body : movers.changed())
    speeds_[body.index] =
        world.is_in_play(body) ? speed_bound(world.motion(body), tick_s_ * ticks_) : 0.0;
  fastest_ = 0.0;
  for (const physics::BodyId body : movers.moving())
    fastest_ = std::max(fastest_, speeds_[body.index]);
}

bool RegionSweep::still_holds(const physics::World& world, physics::BodyId body,
                              const Swept& swept) const {
  return swept.version == world.motion_version(body) && world.now() + tick_s_ <= swept.until_s;
}

im::Region RegionSweep::region(const physics::World& world, physics::BodyId body,
                               Swept& swept) const {
  const double now = world.now();
  swept.version = world.motion_version(body);
  const physics::Vector2 half_extent = world.half_extent(body);
  const bool can_move = world.kind(body) != physics::BodyKind::post && world.is_in_play(body);
  if (!can_move) {
    swept.until_s = std::numeric_limits<double>::infinity();
    return bounding_box(world.position(body), half_extent);
  }
  swept.until_s = now + tick_s_ * (ticks_ + 1e-6);  // plus a millionth of a tick, so that rounding
                                                    // does not cut off the last one
  const im::Region path = path_box(world.motion(body), now, swept.until_s);
  const double own = body.index < speeds_.size() ? speeds_[body.index] : fastest_,
               growth = 2.0 * (own + fastest_) * tick_s_;
  assert(is_on() && growth >= 0.0);
  return {path.low_x - half_extent.x() - growth, path.low_y - half_extent.y() - growth,
          path.high_x + half_extent.x() + growth, path.high_y + half_extent.y() + growth};
}

}  // namespace rink::game
