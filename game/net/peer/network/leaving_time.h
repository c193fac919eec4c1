// How long an interrupted peer may still play, to hand over its bodies.
#pragma once

#include <algorithm>
#include <cassert>
#include <optional>

namespace rink::game {

/// An interrupted peer has three seconds and three of its longest windows. Before the first window
/// there is nothing to hand over.
class LeavingTime {
 public:
  /// Call it before each window.
  void note_window(double now_s) {
    assert(!window_begin_s_ || now_s >= *window_begin_s_);
    if (window_begin_s_) longest_window_s_ = std::max(longest_window_s_, now_s - *window_begin_s_);
    window_begin_s_ = now_s;
  }
  /// The user wants an end; only the first time counts.
  void interrupt(double now_s) {
    if (!interrupted_s_) interrupted_s_ = now_s;
  }
  /// `window_s` is the agreed length of a window, which its play may exceed.
  bool is_left(double now_s, double window_s) const {
    assert(interrupted_s_ && "nobody has to leave yet");
    return window_begin_s_ && now_s <= *interrupted_s_ + seconds_max +
                                           windows_max * std::max(window_s, longest_window_s_);
  }

 private:
  static constexpr double seconds_max = 3.0, windows_max = 3.0;
  std::optional<double> interrupted_s_, window_begin_s_;
  double longest_window_s_ = 0.0;
};

}  // namespace rink::game
