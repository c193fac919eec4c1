// How long the RTI and this federate have been silent.
#pragma once

#include <algorithm>
#include <cassert>

#include "rti/types.h"

namespace rink::rti {

/// Follows the caller's clock; an event between two advances counts as of the later. However late
/// the caller advances it, the time since then counts as `lost_after_s` at most: nobody has looked
/// meanwhile whether the RTI was silent. Where not all that has come was read, it counts nothing
/// for a while.
class LinkWatch {
 public:
  explicit LinkWatch(const Timeouts& timeouts) : timeouts_(timeouts) {}

  double now() const { return now_; }  ///< as the clock was last advanced [s]
  void received() { has_received_ = true; }
  void sent() { has_sent_ = true; }
  /// `is_sending`: bytes wait to be sent. `is_behind`: bytes may wait to be read.
  void advance(double now, bool is_sending, bool is_behind) {
    if (!has_clock_) now_ = last_sent_ = now;
    const double passed_s = now - now_;
    if (has_received_ || !has_clock_) silent_s_ = excused_s_ = 0.0;
    else if (is_behind && excused_s_ < Timeouts::excuse_max * timeouts_.lost_after_s)
      excused_s_ += passed_s;
    else silent_s_ += std::min(passed_s, timeouts_.lost_after_s);
    now_ = now;
    has_clock_ = true;
    if (has_sent_ || is_sending) last_sent_ = now;
    has_received_ = has_sent_ = false;
  }
  bool is_rti_lost() const { return silent_s_ > timeouts_.lost_after_s; }
  bool is_heartbeat_due() const { return now_ - last_sent_ >= timeouts_.heartbeat_s; }
  void beat() { last_sent_ = now_; }

 private:
  Timeouts timeouts_;
  double now_ = 0.0, last_sent_ = 0.0;
  double silent_s_ = 0.0;   ///< for how long nothing has been received
  double excused_s_ = 0.0;  ///< for how long that was no wonder
  bool has_clock_ = false, has_received_ = false, has_sent_ = false;
};

}  // namespace rink::rti
