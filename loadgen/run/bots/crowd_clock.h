// The simulated time of a crowd of bots: by the clock since the first tick, or by the server's
// turns.
#pragma once

#include <algorithm>
#include <cassert>
#include <optional>

namespace rink::loadgen {

/// Reads no clock: `now_s` [s] is the one that the server's stamps use.
class CrowdClock {
 public:
  /// The clock showed `origin_s` at simulated time 0.
  void start(double origin_s) { origin_s_ = origin_s; }
  bool has_started() const { return origin_s_.has_value(); }
  /// A server that waits for turns has reached `simulated_s` [s]: simulated time follows turns from
  /// now on, not the clock.
  void take_turn(double simulated_s) {
    is_synchronous_ = true;
    turn_s_ = std::max(turn_s_, simulated_s);
  }
  bool is_synchronous() const { return is_synchronous_; }
  /// True if keys and decisions come due by the clock.
  bool runs() const { return has_started() && !is_synchronous_; }

  /// The instant on the clock of simulated `simulated_s`; it must have started (asserted).
  double due_s(double simulated_s) const {
    assert(has_started());
    return *origin_s_ + simulated_s;
  }
  /// Simulated time at `now_s`; it must have started (asserted).
  double simulated_s(double now_s) const {
    assert(has_started());
    return is_synchronous_ ? turn_s_ : now_s - *origin_s_;
  }
  bool has_come(double simulated_s, double now_s) const {
    return is_synchronous_ ? turn_s_ >= simulated_s : now_s >= due_s(simulated_s);
  }

 private:
  std::optional<double> origin_s_;
  bool is_synchronous_ = false;
  double turn_s_ = 0.0;
};

}  // namespace rink::loadgen
