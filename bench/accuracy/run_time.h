// How long a run took: processor time of the process, which counts only where real time agrees.
#pragma once

#include <cmath>

#include "bench/clock.h"

namespace rink::accuracy {

struct RunTime {
  double processor_s = 0.0, real_s = 0.0;

  /// The two times differ by at most a tenth of the real time: no other process had the core, and
  /// no second thread of this one did part of the work.
  bool counts() const { return std::abs(processor_s - real_s) <= 0.1 * real_s; }
};

/// From when it is made.
class Stopwatch {
 public:
  RunTime passed() const { return {processor() - processor_s_, real() - real_s_}; }

 private:
  static double processor() { return bench::seconds_of(CLOCK_PROCESS_CPUTIME_ID); }
  static double real() { return bench::seconds_of(CLOCK_MONOTONIC); }

  double real_s_ = real(), processor_s_ = processor();
};

}  // namespace rink::accuracy
