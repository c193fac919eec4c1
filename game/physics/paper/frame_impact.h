// What an impact does to two bodies of a stepped engine.
#pragma once

#include "game/physics/body.h"
#include "game/physics/paper/frame_body.h"

namespace rink::physics::paper {

/// A part of the field, for an impact on it.
FrameBody immovable(MaterialId material);

/// Impulse and momentum along `normal`, the unit vector from `other` to `body`, both at their last
/// states; with spin and friction where `spec` has them.
void strike(FrameBody& body, FrameBody& other, const Vector2& normal, const WorldSpec& spec);

}  // namespace rink::physics::paper
