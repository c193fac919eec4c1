// A window on the desktop with OpenGL 3.3 in it.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "game/view/settings.h"
#include "game/view/window/window_event.h"

struct GLFWwindow;

namespace rink::view {

/// There is no display for a window, or no OpenGL 3.3; what() names what is missing and how to get
/// it.
class NoDisplay : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// At most one exists at a time. Its OpenGL context is current as long as it exists.
class Window {
 public:
  /// Throws NoDisplay. `width` and `height` in points of the desktop.
  Window(const std::string& title, int width, int height, bool is_full_screen);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// The events since the last call.
  std::vector<WindowEvent> events();
  WindowSize size() const;
  /// Of the desktop; on a screen with finer pixels there are fewer than of these.
  WindowPoints points() const;
  bool is_full_screen() const;
  /// Switches to full screen on the monitor that shows most of it, or back to its place.
  void set_full_screen(bool is_wanted);
  /// Shows the drawing; waits for the screen if that is possible.
  void show();

 private:
  void listen();
  void listen_to_gamepad();
  GLFWwindow* window_ = nullptr;
  std::vector<WindowEvent> events_;
  int gamepad_ = -1;  ///< GLFW's number of the one that is used; none: -1
  double stick_x_ = 0.0, stick_y_ = 0.0;
  int x_ = 0, y_ = 0, width_ = 0, height_ = 0;  ///< before it filled the screen
};

}  // namespace rink::view
