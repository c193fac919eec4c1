// How boldly windows are played by tiles, from what became of the last ones.
#pragma once

#include <algorithm>
#include <cstdint>

namespace rink::physics {

/// So that few windows have to be undone, and few events are put off; and where tiles are of no use
/// it costs little to find out.
class Pace {
 public:
  /// What became of a window: whether it was right and, then, whether it was worth it.
  void note(bool was_right, bool was_worth_it) {
    be_patient(was_right && was_worth_it);
    if (was_right) {
      share_ = std::min(1.0, share_ * longer);
      wider_ -= std::min(wider_, 1u);
    } else if (wider_ == 0) {
      wider_ = wider_windows;
    } else {
      share_ = std::max(least_share, share_ * shorter);
    }
  }
  /// Of one that was right, and undone because a budget had no room for it: that says nothing of
  /// how long windows may be.
  void note_no_room() { be_patient(false); }
  void note_in_order() { in_order_ -= std::min(in_order_, 1u); }

  /// Whether the next window should be played in order.
  bool is_patient() const { return in_order_ > 0; }
  /// Of the length that the plan says.
  double share() const { return share_; }
  /// Whether one more cell should be blocked around what is put off.
  bool blocks_wider() const { return wider_ > 0; }

 private:
  /// Where a window had to be undone, so many after it block a cell more around what is put off.
  /// Where one of these has to be undone, windows get shorter by that, and else longer; not below
  /// that part of what the plan says.
  static constexpr std::uint32_t wider_windows = 256, in_order_max = 64;
  static constexpr double shorter = 0.8, longer = 1.01, least_share = 0.125;

  void be_patient(bool was_good) {
    in_order_last_ = was_good ? 0 : std::min(in_order_max, 2 * in_order_last_ + 1);
    in_order_ = in_order_last_ / 2;
  }

  std::uint32_t wider_ = 0;  // windows that block a cell more: still
  double share_ = 1.0;
  std::uint32_t in_order_ = 0,
                in_order_last_ = 0;  // windows to be played in order: still, at first
};

}  // namespace rink::physics
