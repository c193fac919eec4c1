// What a person did to the window, held back as long as a frame needs to see it: menus look at keys
// once a frame, so a tap that begins and ends between two frames would never have been.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "game/view/window/window_event.h"

namespace rink::view {

/// In order of arrival, and nothing is lost: what has no place in this frame comes in a later one.
class EventQueue {
 public:
  void push(const WindowEvent& event) { waiting_.push_back(event); }
  void begin_frame();

  /// How much of what was done a frame may see at once.
  enum class Pace : unsigned char {
    play,    ///< anything, but of each key and of the mouse's button one change
    menu,    ///< also only one press, for each acts on what those before it have chosen, and no
             ///< movement after a click
    opening  ///< no press: the screen is not ready
  };
  /// The next event of this frame, if `pace` lets one in.
  std::optional<WindowEvent> take(Pace pace);

 private:
  bool may_come(const WindowEvent& event, Pace pace) const;

  std::deque<WindowEvent> waiting_;
  std::vector<KeyCode> changed_;  ///< in this frame
  bool has_clicked_ = false, has_pressed_ = false;
};

}  // namespace rink::view
