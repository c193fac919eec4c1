// How long the other side of a connection has been silent.
#pragma once

#include <algorithm>
#include <cassert>

#include "rti/types.h"

namespace rink::rti {

/// Follows its owner's clock; a word between two advances counts as of the later. However late the
/// owner advances it, the time since then counts as `lost_after_s` at most: nobody has listened
/// meanwhile. Where not all that has come was read, it counts nothing for a while: what was said
/// may wait in the sockets.
class Silence {
 public:
  void broken() { is_broken_ = true; }  ///< by a word of the other side
  /// `passed_s` [s] have passed since the last advance, or since the connection was made.
  /// `is_behind`: some of what has come may wait unread.
  void advance(double passed_s, bool is_behind, double lost_after_s) {
    assert(passed_s >= 0.0);
    if (is_broken_) lasted_s_ = excused_s_ = 0.0;
    else if (is_behind && excused_s_ < Timeouts::excuse_max * lost_after_s) excused_s_ += passed_s;
    else lasted_s_ += std::min(passed_s, lost_after_s);
    is_broken_ = false;
  }
  double lasted_s() const { return lasted_s_; }  ///< [s], without what is excused

 private:
  double lasted_s_ = 0.0, excused_s_ = 0.0;
  bool is_broken_ = false;
};

}  // namespace rink::rti
