// One bot's measurements: the age of its updates when they come, and the time that its keys take to
// move its own bat.
#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include "loadgen/measure/statistics/histogram.h"

namespace rink::loadgen {

/// The histograms of all bots of a process, and the span of simulated time in which they count.
struct Measurements {
  double from_s = 0.0, until_s = 0.0;  ///< simulated time [s]; only events within are counted
  Histogram update_latency, input_latency, send_lateness;
  std::uint64_t keys_due = 0, keys_sent = 0, keys_unanswered = 0, late_sends = 0;

  bool is_counted(double simulated_s) const {
    return simulated_s >= from_s && simulated_s < until_s;
  }
  /// The fault of the key schedule, empty if it may have been kept: so many late keys refute, at
  /// the one-sided 1 % level of the exact binomial test, that each is late with a probability of at
  /// most 1 %. A fixed limit of 1 % would refuse one late key of 50, which occurs in 39 of 100 runs
  /// that are exactly at 1 %.
  std::string schedule_trouble() const;
};

/// Follows the keys of one bot from their due instant to the first update of its own bat that
/// includes their effect. Times in seconds on one clock.
class Probe {
 public:
  /// A send later than this is late: a third of a 30 Hz tick, and twenty times the wake-up error
  /// (p99) of a quiet virtual machine.
  static constexpr double late_s = 10e-3;

  explicit Probe(Measurements& measurements) : measurements_(measurements) {}

  /// A key due at `due_s` was sent at `sent_s`. `is_counted`: it falls into the measured span.
  void key_sent(double due_s, double sent_s, bool is_counted);
  /// Updates of a tick that was due at `due_s` were applied at `now_s`; called once for each tick.
  /// `is_counted`: the tick falls into the measured span.
  void news_applied(double due_s, double now_s, bool is_counted);
  /// At `now_s` the replica of the own bat shows the effect of the first `felt` keys.
  void keys_felt(double now_s, std::uint32_t felt);
  /// Keys sent and counted that never showed an effect.
  std::uint64_t unanswered() const;

 private:
  struct Waiting {
    double due_s;
    bool is_counted;
  };

  Measurements& measurements_;
  std::deque<Waiting> waiting_;
  std::uint32_t answered_ = 0;
};

}  // namespace rink::loadgen
