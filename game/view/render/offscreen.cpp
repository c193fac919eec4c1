// Makes a context by EGL.
#include "game/view/render/offscreen.h"

#include <epoxy/egl.h>

#include <array>

#if defined(__SANITIZE_ADDRESS__)
#include <dlfcn.h>

/// Drivers stay loaded, so that the leak checker can name and suppress their leaks.
extern "C" int dlclose(void*) noexcept { return 0; }

extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:_dri.so\nleak:libEGL_mesa.so\nleak:libgallium\nleak:libLLVM\n";
}
#endif

namespace rink::view {

OffscreenContext::OffscreenContext() {
  const char* missing =
      "drawing without a display needs EGL with Mesa's surfaceless platform (Debian: libegl1 "
      "libegl-mesa0 libgl1-mesa-dri)";
  if (!epoxy_has_egl()) throw GraphicsError(missing);
  EGLDisplay display =
      eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr))
    throw GraphicsError(missing);
  display_ = display;
  eglBindAPI(EGL_OPENGL_API);
  const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                         3,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         3,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_NONE};
  context_ = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
  if (context_ == EGL_NO_CONTEXT ||
      !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
    eglTerminate(display);
    throw GraphicsError("the graphics driver has no OpenGL 3.3");
  }
}

OffscreenContext::~OffscreenContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

std::string graphics_name() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name != nullptr ? name : "unknown";
}

}  // namespace rink::view
