// Events of a window as plain data, from a real window or from a script.
#pragma once

#include "game/view/settings.h"

namespace rink::view {

struct WindowEvent {
  enum class Kind : unsigned char {
    key,
    text,
    mouse_move,
    mouse_button,
    scroll,
    close,
    focus_lost,
    pointer,  ///< a script's, on the table
    stick,    ///< a gamepad's
    gamepad   ///< one is there, or is gone
  };
  Kind kind = Kind::key;
  KeyCode key = 0;
  bool is_down = false;     ///< of key and mouse_button; of gamepad: it is there
  unsigned character = 0;   ///< of text: Unicode
  double x = 0.0, y = 0.0;  ///< of mouse_move: pixels from the upper left; of scroll: y; of
                            ///< pointer: the place on the field [m]; of stick: -1 to 1, right and
                            ///< up on the screen
};

/// The size of a window: pixels, and pixels per point of the desktop's scale.
struct WindowSize {
  int width = 1280, height = 720;
  double scale = 1.0;
  friend bool operator==(const WindowSize&, const WindowSize&) = default;
};

}  // namespace rink::view
