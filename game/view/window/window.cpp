// GLFW's window, its callbacks turned into a list.
#include "game/view/window/window.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "game/view/window/glfw.h"

namespace rink::view {
namespace {

constexpr const char* how_to_get_a_display =
    "\nrink play needs a display: run it on a desktop (X11, or Wayland with Xwayland; over ssh: "
    "ssh -X), or on a virtual one:\n"
    "  apt-get install -y --no-install-recommends xvfb xauth && xvfb-run ./rink play\n"
    "Without any, ./rink play --bot club --offscreen --screenshot match.png --at 1 draws a "
    "picture.";

std::string glfw_words() {
  const char* words = nullptr;
  glfwGetError(&words);
  return words != nullptr ? words : "no reason given";
}

std::vector<WindowEvent>& events_of(GLFWwindow* window) {
  return *static_cast<std::vector<WindowEvent>*>(glfwGetWindowUserPointer(window));
}

/// The monitor that shows the window's middle, or else the first.
GLFWmonitor* monitor_of(GLFWwindow* window) {
  int x = 0, y = 0, width = 0, height = 0, count = 0;
  glfwGetWindowPos(window, &x, &y);
  glfwGetWindowSize(window, &width, &height);
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  for (int i = 0; i < count; ++i) {
    int left = 0, top = 0;
    glfwGetMonitorPos(monitors[i], &left, &top);
    const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
    if (mode == nullptr) continue;
    const int across = x + width / 2 - left, down = y + height / 2 - top;
    if (across >= 0 && across < mode->width && down >= 0 && down < mode->height) return monitors[i];
  }
  return count > 0 ? monitors[0] : nullptr;
}

struct Stick {
  bool is_there = false;
  double right = 0.0, up = 0.0;  ///< -1 to 1
};

double within_rim(float value) {
  return std::isfinite(value) ? std::clamp(static_cast<double>(value), -1.0, 1.0) : 0.0;
}

/// The left stick of gamepad `number`, if it is there. A joystick that GLFW does not know as a
/// gamepad is used by its first two axes.
Stick stick_of(int number) {
  if (number < 0 || !glfwJoystickPresent(number)) return {};
  GLFWgamepadstate state;
  if (glfwJoystickIsGamepad(number) && glfwGetGamepadState(number, &state))
    return {true, within_rim(state.axes[GLFW_GAMEPAD_AXIS_LEFT_X]),
            -within_rim(state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y])};
  int count = 0;
  const float* axes = glfwGetJoystickAxes(number, &count);
  if (axes == nullptr || count < 2) return {};
  return {true, within_rim(axes[0]), -within_rim(axes[1])};
}

}  // namespace

Window::Window(const std::string& title, int width, int height, bool is_full_screen) {
  if (!glfwInit())
    throw NoDisplay("no window can be opened: " + glfw_words() + how_to_get_a_display);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string why = glfw_words();
    glfwTerminate();
    throw NoDisplay("no window with OpenGL 3.3 can be opened: " + why +
                    " (Debian's software driver: libgl1-mesa-dri)" + how_to_get_a_display);
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowSizeLimits(window_, 320, 240, GLFW_DONT_CARE, GLFW_DONT_CARE);
  listen();
  if (is_full_screen) set_full_screen(true);
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::listen() {
  using Kind = WindowEvent::Kind;
  glfwSetWindowUserPointer(window_, &events_);
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
    if (action != GLFW_REPEAT && key != GLFW_KEY_UNKNOWN)
      events_of(window).push_back({.kind = Kind::key, .key = key, .is_down = action == GLFW_PRESS});
  });
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned character) {
    events_of(window).push_back({.kind = Kind::text, .character = character});
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    int width = 0, height = 0, pixels_x = 0, pixels_y = 0;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &pixels_x, &pixels_y);
    if (width > 0 && height > 0)
      events_of(window).push_back(
          {.kind = Kind::mouse_move, .x = x * pixels_x / width, .y = y * pixels_y / height});
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
    if (button == GLFW_MOUSE_BUTTON_LEFT)
      events_of(window).push_back({.kind = Kind::mouse_button, .is_down = action == GLFW_PRESS});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double y) {
    events_of(window).push_back({.kind = Kind::scroll, .y = y});
  });
  glfwSetWindowCloseCallback(
      window_, [](GLFWwindow* window) { events_of(window).push_back({.kind = Kind::close}); });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int has_focus) {
    if (!has_focus) events_of(window).push_back({.kind = Kind::focus_lost});
  });
}

/// GLFW tells of gamepads only who asks: the first with a stick is used until it is gone.
void Window::listen_to_gamepad() {
  using Kind = WindowEvent::Kind;
  Stick stick = stick_of(gamepad_);
  if (!stick.is_there && gamepad_ >= 0) {
    gamepad_ = -1;
    events_.push_back({.kind = Kind::gamepad, .is_down = false});
  }
  for (int number = GLFW_JOYSTICK_1; gamepad_ < 0 && number <= GLFW_JOYSTICK_LAST; ++number) {
    stick = stick_of(number);
    if (!stick.is_there) continue;
    gamepad_ = number;
    stick_x_ = stick_y_ = 0.0;
    events_.push_back({.kind = Kind::gamepad, .is_down = true});
  }
  if (!stick.is_there || (stick.right == stick_x_ && stick.up == stick_y_)) return;
  stick_x_ = stick.right, stick_y_ = stick.up;
  events_.push_back({.kind = Kind::stick, .x = stick_x_, .y = stick_y_});
}

std::vector<WindowEvent> Window::events() {
  glfwPollEvents();
  listen_to_gamepad();
  return std::exchange(events_, {});
}

WindowSize Window::size() const {
  WindowSize size;
  glfwGetFramebufferSize(window_, &size.width, &size.height);
  float across = 1.0f, down = 1.0f;
  glfwGetWindowContentScale(window_, &across, &down);
  size.scale = static_cast<double>(down);
  return size;
}

WindowPoints Window::points() const {
  const WindowSize pixels = size();
  const auto points = [&](int count, int least, int most) {
    return std::clamp(static_cast<int>(std::lround(count / pixels.scale)), least, most);
  };
  return {points(pixels.width, window_least.width, window_most.width),
          points(pixels.height, window_least.height, window_most.height)};
}

bool Window::is_full_screen() const { return glfwGetWindowMonitor(window_) != nullptr; }

void Window::set_full_screen(bool is_wanted) {
  if (is_wanted == is_full_screen()) return;
  if (!is_wanted)
    return glfwSetWindowMonitor(window_, nullptr, x_, y_, width_, height_, GLFW_DONT_CARE);
  glfwGetWindowPos(window_, &x_, &y_);
  glfwGetWindowSize(window_, &width_, &height_);
  GLFWmonitor* monitor = monitor_of(window_);
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  if (mode != nullptr)
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::show() { glfwSwapBuffers(window_); }

}  // namespace rink::view
