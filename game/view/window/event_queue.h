// Events of a window, held back until a frame can see them: menus look at keys once a frame, so a
// tap that begins and ends between two frames would be lost.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "game/view/window/window_event.h"

namespace rink::view {

/// Events keep their order and none is lost: one without a place in this frame comes in a later
/// one.
class EventQueue {
 public:
  void push(const WindowEvent& event) { waiting_.push_back(event); }
  void begin_frame();

  /// How many events a frame may see.
  enum class Pace : unsigned char {
    play,    ///< all events, but only one change of each key and of the mouse's button
    menu,    ///< also only one press, since each acts on the choices of earlier ones, and no
             ///< movement after a click
    opening  ///< no press: the screen is not ready
  };
  /// The next event of this frame, if `pace` allows one.
  std::optional<WindowEvent> take(Pace pace);

 private:
  bool may_come(const WindowEvent& event, Pace pace) const;

  std::deque<WindowEvent> waiting_;
  std::vector<KeyCode> changed_;  ///< in this frame
  bool has_clicked_ = false, has_pressed_ = false;
};

}  // namespace rink::view
