// The uniforms that shaders of everything on the table share.
#pragma once

#include "game/view/render/camera.h"
#include "game/view/render/canvas.h"
#include "game/view/render/picture.h"

namespace rink::view {

/// Uses `program` with the table, the eye, and the stage's `depth`, behind which drawings are
/// hidden.
void shade(const Program& program, const Table& table, const Sight& sight, const Canvas& canvas,
           GLuint depth);

/// The colour of the hall around the table, and no depth.
void clear_around();

}  // namespace rink::view
