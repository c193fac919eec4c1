// A body of a stepped engine.
#pragma once

#include <cstdint>

#include "game/physics/body.h"
#include "game/physics/paper/integrator.h"

namespace rink::physics::paper {

/// At its last state within the frame, and where the frame will leave it if nothing comes in
/// between.
struct FrameBody {
  Phase start, end;
  double start_time = 0.0;
  Vector2 chord{0.0, 0.0};  ///< velocity on the straight path from start to end
  Force force;
  Vector2 half_extent{0.0, 0.0};  ///< of a rectangle; 0 for discs
  double radius = 0.0;
  double mass = 1.0, inverse_mass = 1.0;
  double spin = 0.0;          ///< of a puck [rad/s]
  std::uint32_t version = 0;  ///< of the path
  std::uint32_t impacts = 0;  ///< within this frame
  BodyKind kind = BodyKind::puck;
  MaterialId material = 0;
  Half half = Half::both;
  bool is_in_play = true, is_removed = false;
  bool is_stopped = false;  ///< stays where it is until the next frame

  Vector2 extent() const { return half_extent + Vector2::Constant(radius); }
  bool can_move() const {
    return inverse_mass > 0.0 &&
           (start.velocity != Vector2(0.0, 0.0) || force.thrust != Vector2(0.0, 0.0));
  }
  /// Of its motion at `velocity` and of its spin [J]; a puck is a uniform disc.
  double energy(const Vector2& velocity) const {
    if (inverse_mass == 0.0) return 0.0;
    return mass * (0.5 * velocity.squaredNorm() + 0.25 * radius * radius * spin * spin);
  }
};

}  // namespace rink::physics::paper
