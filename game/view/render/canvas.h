// The target of a drawing.
#pragma once

#include "game/view/render/gl_objects.h"

namespace rink::view {

/// A rectangle of pixels to draw to, in a framebuffer (0: the window's own).
struct Canvas {
  GLuint framebuffer = 0;
  int x = 0, y = 0, width = 1280, height = 720;
  friend bool operator==(const Canvas&, const Canvas&) = default;
};

}  // namespace rink::view
