// Decides which events wait for a later frame.
#include "game/view/window/event_queue.h"

#include <algorithm>
#include <cassert>

namespace rink::view {

void EventQueue::begin_frame() {
  changed_.clear();
  has_clicked_ = has_pressed_ = false;
}

bool EventQueue::may_come(const WindowEvent& event, Pace pace) const {
  using Kind = WindowEvent::Kind;
  if (event.kind == Kind::mouse_move || event.kind == Kind::scroll)
    return pace == Pace::play || !has_clicked_;
  if (event.kind != Kind::key && event.kind != Kind::mouse_button) return true;
  if (event.is_down && pace == Pace::opening) return false;
  if (event.is_down && pace == Pace::menu && has_pressed_) return false;
  return event.kind == Kind::key ? std::ranges::find(changed_, event.key) == changed_.end()
                                 : !has_clicked_;
}

std::optional<WindowEvent> EventQueue::take(Pace pace) {
  if (waiting_.empty() || !may_come(waiting_.front(), pace)) return std::nullopt;
  const WindowEvent event = waiting_.front();
  waiting_.pop_front();
  assert(event.kind != WindowEvent::Kind::key ||
         std::ranges::find(changed_, event.key) == changed_.end());
  if (event.kind == WindowEvent::Kind::key) changed_.push_back(event.key);
  else if (event.kind == WindowEvent::Kind::mouse_button) has_clicked_ = true;
  else return event;
  has_pressed_ = has_pressed_ || event.is_down;
  return event;
}

}  // namespace rink::view
