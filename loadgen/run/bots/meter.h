// Measurements of a crowd of bots within the measured span, and the traffic of its connections.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "loadgen/run/bots/probe.h"

namespace rink::loadgen {

/// The traffic of a crowd's connections, summed.
struct CrowdTraffic {
  std::uint64_t bytes_sent = 0, bytes_received = 0, segments_sent = 0, kernel_bytes_sent = 0,
                kernel_bytes_received = 0, updates_received = 0;
  std::uint64_t acknowledgements_sent = 0, kernel_segments_sent = 0;
  friend bool operator==(const CrowdTraffic&, const CrowdTraffic&) = default;
};

/// The traffic up to an instant: the sum, and each bot's received bytes.
struct CarriedSoFar {
  CrowdTraffic traffic;
  std::vector<std::uint64_t> received_by_bot;
};

class Meter {
 public:
  /// Of the simulated span from `from_s` to `until_s` [s].
  Meter(double from_s, double until_s) {
    measurements_.from_s = from_s;
    measurements_.until_s = until_s;
  }

  Measurements& measurements() { return measurements_; }
  const Measurements& measurements() const { return measurements_; }

  /// The span begins at `now_s` on the clock, once (asserted).
  void begin(double now_s, const CarriedSoFar& carried);
  /// The span ends; it must have begun and not ended (asserted).
  void end(double now_s, const CarriedSoFar& carried);
  bool has_begun() const { return begin_s_.has_value(); }
  bool has_ended() const { return has_ended_; }
  bool is_measuring() const { return has_begun() && !has_ended_; }

  /// The traffic within the span, once it has ended, and its length on the clock [s].
  const CrowdTraffic& traffic() const { return within_; }
  double measured_s() const { return measured_s_; }
  /// Payload received by each bot within the span.
  const std::vector<std::uint64_t>& received_by_bot() const { return received_by_bot_; }

 private:
  Measurements measurements_;
  std::optional<double> begin_s_;
  CrowdTraffic at_begin_, within_;
  std::vector<std::uint64_t> received_by_bot_;  ///< up to the span's begin, then within it
  double measured_s_ = 0.0;
  bool has_ended_ = false;
};

}  // namespace rink::loadgen
