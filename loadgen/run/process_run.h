// Helpers of runs that wait for processes: a clock, limits, numbers as arguments, and what a
// process says and reports.
#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "game/process/process.h"
#include "loadgen/run/process_arguments.h"
#include "loadgen/run/run_ending.h"

namespace rink::loadgen {

using Clock = std::chrono::steady_clock;

inline constexpr std::chrono::milliseconds look_interval{20};
inline constexpr double survivor_limit_s = 3.0;  ///< how long others may go on after one has failed

inline Clock::time_point after(double seconds) {
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// `what`, and the last words of a process that failed.
std::string with_stderr_tail(const std::string& what, const game::Process& process);

/// What `process` prints after `beginning`; `who` names it if it ends before, or takes too long.
/// Throws Failure, and Interrupted.
std::string awaited_line(const RunnerSettings& settings, game::Process& process,
                         const std::string& beginning, const std::string& who);

/// The report that `who` has written. Throws Failure.
nlohmann::json report_at(const std::filesystem::path& path, const std::string& who);

}  // namespace rink::loadgen
