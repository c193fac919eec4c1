// Tells who was silent for too long, by a clock that is looked at again and again.
#pragma once

#include <algorithm>
#include <cassert>

namespace rink::game {

/// A peer that was itself stopped must not take that for the others' silence: it has not read their
/// messages yet. So the wait begins anew after each gap between two looks that is longer than
/// `gap_max_s`.
class Patience {
 public:
  Patience(double patience_s, double gap_max_s, double now_s)
      : patience_s_(patience_s), gap_max_s_(gap_max_s), begin_s_(now_s), now_s_(now_s) {
    assert(patience_s >= 0.0 && gap_max_s >= 0.0);
  }
  void look(double now_s) {
    assert(now_s >= now_s_ && "clocks do not go back");
    if (now_s - now_s_ > gap_max_s_) begin_s_ = now_s;
    now_s_ = now_s;
  }
  /// At the last look, for who was last heard at `heard_s`.
  bool is_over(double heard_s) const { return now_s_ > std::max(begin_s_, heard_s) + patience_s_; }
  /// For who was never heard.
  bool is_over() const { return is_over(begin_s_); }
  double patience_s() const { return patience_s_; }

 private:
  double patience_s_, gap_max_s_, begin_s_, now_s_;
};

}  // namespace rink::game
