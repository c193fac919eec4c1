// A token bucket: a rate limit that allows bursts of one second's worth.
#pragma once

#include <algorithm>
#include <cassert>

namespace rink::rti {

/// Fills at `rate` per second up to a second's worth and starts full (Turner 1986). A rate of 0
/// limits nothing.
class TokenBucket {
 public:
  TokenBucket(double rate, double now_s) : rate_(rate), level_(rate), filled_s_(now_s) {}
  /// False if there is not enough for `count` at `now_s`, which never decreases; then nothing is
  /// taken.
  bool take(double count, double now_s) {
    assert(count >= 0.0);
    if (rate_ <= 0.0) return true;
    assert(now_s >= filled_s_);
    level_ = std::min(rate_, level_ + rate_ * (now_s - filled_s_));
    filled_s_ = now_s;
    if (count > level_) return false;
    level_ -= count;
    assert(0.0 <= level_ && level_ <= rate_);
    return true;
  }

 private:
  double rate_, level_, filled_s_;
};

}  // namespace rink::rti
