// How long the RTI and this federate have been silent.
#pragma once

#include "rti/types.h"
#include "rti/wire/silence.h"

namespace rink::rti {

/// Follows the caller's clock; an event between two advances counts as of the later.
class LinkWatch {
 public:
  explicit LinkWatch(const Timeouts& timeouts) : timeouts_(timeouts) {}

  double now() const { return now_; }  ///< as the clock was last advanced [s]
  void received() { silence_.broken(); }
  void sent() { has_sent_ = true; }
  /// `is_sending`: bytes wait to be sent. `is_behind`: bytes may wait to be read.
  void advance(double now, bool is_sending, bool is_behind) {
    if (!has_clock_) now_ = last_sent_ = now;
    silence_.advance(now - now_, is_behind, timeouts_.lost_after_s);
    now_ = now;
    has_clock_ = true;
    if (has_sent_ || is_sending) last_sent_ = now;
    has_sent_ = false;
  }
  bool is_rti_lost() const { return silence_.lasted_s() > timeouts_.lost_after_s; }
  bool is_heartbeat_due() const { return now_ - last_sent_ >= timeouts_.heartbeat_s; }
  void beat() { last_sent_ = now_; }

 private:
  Timeouts timeouts_;
  double now_ = 0.0, last_sent_ = 0.0;
  Silence silence_;  ///< of the RTI
  bool has_clock_ = false, has_sent_ = false;
};

}  // namespace rink::rti
