// What is asked of a world that holds some of the bodies of a larger one, by their numbers there.
#pragma once

#include <cstdint>

#include "game/physics/body.h"
#include "game/physics/body_slots.h"
#include "game/physics/counters.h"
#include "game/physics/flight/motion.h"
#include "game/physics/real.h"
#include "game/physics/world.h"

namespace rink::physics::inline RINK_PRECISION {

/// The questions of World. A body that is not there is one that was removed.
class PartWorld {
 public:
  /// Both must outlive it.
  PartWorld(const World& inside, const BodySlots& slots) : inside_(inside), slots_(slots) {}

  /// The world itself, and what it calls the body, until the next one is put there.
  const World& inside() const { return inside_; }
  BodyId inside(BodyId body) const { return {slots_.slot_of(body.index)}; }

  const WorldSpec& spec() const { return inside_.spec(); }
  const Counters& counters() const { return inside_.counters(); }
  Real now() const { return inside_.now(); }
  /// Of the larger world.
  std::uint32_t body_count() const { return slots_.body_count(); }
  RealVector position(BodyId body) const { return inside_.position(inside(body)); }
  RealVector velocity(BodyId body) const { return inside_.velocity(inside(body)); }
  Motion motion(BodyId body) const { return inside_.motion(inside(body)); }
  BodyKind kind(BodyId body) const { return inside_.kind(inside(body)); }
  Real radius(BodyId body) const { return inside_.radius(inside(body)); }
  RealVector half_extent(BodyId body) const { return inside_.half_extent(inside(body)); }
  RealVector thrust(BodyId body) const { return inside_.thrust(inside(body)); }
  bool is_in_play(BodyId body) const { return inside_.is_in_play(inside(body)); }
  bool is_removed(BodyId body) const { return inside_.is_removed(inside(body)); }
  bool is_resting(BodyId body) const { return inside_.is_resting(inside(body)); }
  bool is_held(BodyId body) const { return inside_.is_held(inside(body)); }
  /// Of a disc, where those that are there leave room.
  bool is_free(const Vector2& centre, double radius) const {
    return inside_.is_free(centre, radius);
  }

 private:
  const World& inside_;
  const BodySlots& slots_;
};

}  // namespace rink::physics::inline RINK_PRECISION
