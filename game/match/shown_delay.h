// The delay behind the own bat with which everything else is shown.
#pragma once

#include <algorithm>
#include <cassert>

#include "game/match/news_delay.h"

namespace rink::game {

/// Approaches the measured delay of updates without a jump in the shown time.
class ShownDelay {
 public:
  /// How much slower or faster than real time the others' time may run while the delay changes.
  static constexpr double time_bend = 0.5;

  /// As NewsDelay::received.
  void received(double shown_s, double since_s) { news_.received(shown_s, since_s); }
  /// Starts anew, without delay.
  void begin() { seconds_ = 0.0; }
  /// The measured delay [s], or `estimate` until there are enough updates.
  double measured_or(double estimate) const { return news_.delay().value_or(estimate); }
  /// Moves towards `wanted` [s], as far as `dt` [s] of real time allow.
  void move(double wanted, double dt) {
    assert(dt >= 0.0);
    seconds_ =
        std::clamp(wanted, std::max(0.0, seconds_ - time_bend * dt), seconds_ + time_bend * dt);
  }
  double seconds() const { return seconds_; }

 private:
  NewsDelay news_;
  double seconds_ = 0.0;
};

}  // namespace rink::game
