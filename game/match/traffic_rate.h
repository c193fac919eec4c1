// The present rate of a connection's traffic.
#pragma once

#include <cassert>
#include <cstdint>

namespace rink::game {

/// Computes a rate once a second from a count that only rises.
class TrafficRate {
 public:
  /// Bytes per second, as of the last whole second; `bytes` have come by `now_s` [s].
  double measure(std::uint64_t bytes, double now_s) {
    assert(bytes >= counted_bytes_);
    if (now_s - counted_s_ < 1.0) return bytes_per_s_;
    bytes_per_s_ = counted_s_ == 0.0
                       ? 0.0
                       : static_cast<double>(bytes - counted_bytes_) / (now_s - counted_s_);
    counted_s_ = now_s;
    counted_bytes_ = bytes;
    return bytes_per_s_;
  }

 private:
  double counted_s_ = 0.0, bytes_per_s_ = 0.0;
  std::uint64_t counted_bytes_ = 0;
};

}  // namespace rink::game
