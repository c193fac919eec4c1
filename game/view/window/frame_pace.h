// How many pictures a second a window draws where the screen sets no pace.
#pragma once

#include <cassert>

namespace rink::view {

/// Limits the pictures drawn each second, and draws few behind a menu that nobody has touched for a
/// while. Knows no clock; real time [s] never falls.
class FramePace {
 public:
  static constexpr double limit_default = 120.0;  ///< pictures a second
  static constexpr double rests_after_s = 5.0, resting_period_s = 1.0;
  /// How often a resting menu listens for what ends its rest [s].
  static constexpr double listening_period_s = 0.03;

  explicit FramePace(double limit) : period_s_(1.0 / limit) { assert(limit > 0.0); }

  /// Somebody touched a key, the pointer or the window.
  void touched(double now_s) { touched_s_ = now_s; }
  bool rests(bool is_in_menu, double now_s) const {
    return is_in_menu && now_s >= touched_s_ + rests_after_s;
  }
  /// When the next picture is due after one that was begun at `begin_s`.
  double due_s(bool is_in_menu, double begin_s) const {
    return begin_s + (rests(is_in_menu, begin_s) ? resting_period_s : period_s_);
  }

 private:
  double period_s_;
  double touched_s_ = 0.0;
};

}  // namespace rink::view
