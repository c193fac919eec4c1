// The kernel's clocks as seconds, for benchmarks that time what no benchmark library does.
#pragma once

#include <time.h>

namespace rink::bench {

/// Processor time of the calling thread [s], or what another `clock` says.
inline double seconds_of(clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace rink::bench
