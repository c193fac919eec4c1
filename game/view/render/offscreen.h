// A context of OpenGL 3.3 without a window or a display: for tests, benchmarks and screenshots.
#pragma once

#include <string>

#include "game/view/render/gl_objects.h"

namespace rink::view {

/// Mesa's surfaceless platform through EGL; current on this thread until it is destroyed.
class OffscreenContext {
 public:
  /// Throws GraphicsError that names what is missing.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

/// The name of the renderer: "llvmpipe (LLVM 15.0.6, 256 bits)".
std::string graphics_name();

}  // namespace rink::view
