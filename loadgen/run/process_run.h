// Helpers of runs that wait for processes: a clock, limits, and numbers as arguments.
#pragma once

#include <chrono>
#include <sstream>
#include <string>

#include "loadgen/run/run_ending.h"

namespace rink::loadgen {

using Clock = std::chrono::steady_clock;

inline constexpr std::chrono::milliseconds look_interval{20};
inline constexpr double survivor_limit_s = 3.0;  ///< how long others may go on after one has failed

inline Clock::time_point after(double seconds) {
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// A text that reads back as the same number.
inline std::string decimal(double number) {
  std::ostringstream text;
  text.precision(17);
  text << number;
  return text.str();
}

}  // namespace rink::loadgen
