// With what the processes of a cell are started, and where they and their files are.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "loadgen/experiment/experiment.h"
#include "loadgen/run/run_ending.h"

namespace rink::loadgen {

/// The places of the two programs and of their files, and the time limits.
struct RunnerSettings {
  std::filesystem::path serve, bots, peer,
      dds;  ///< the executables rink-serve, rink-bots, rink-peer and rink-dds
  std::filesystem::path directory;  ///< an existing folder for the processes' own reports
  std::vector<int> server_processors,
      bots_processors;      ///< the processors that each is pinned to; empty: not pinned
  bool wants_truth = true;  ///< evidence is taken, and the run judged by a re-simulation
  bool keeps_traces_of_curves = false;  ///< of the hundreds of runs that are points of curves too
  bool keeps_traces = true;             ///< in files; in virtual time the same seed reproduces them
  double listen_limit_s =
      30.0;  ///< from the server's start to its line `listening on ADDRESS:PORT`
  double join_limit_s =
      20.0;  ///< beyond warm-up and duration, for joining, ending and writing reports
  /// Events of the physics per simulated second at which a run in virtual time ends as invalid.
  /// Nobody waits for its ticks, so these may take a minute, but scenes exist in which they never
  /// end (docs/physics.md, "Limits").
  std::uint64_t virtual_events_per_s = 100'000'000;
  std::chrono::milliseconds stop_grace{1000};  ///< from SIGTERM to SIGKILL
  const std::atomic<bool>* is_interrupted =
      nullptr;  ///< looked at every 20 ms; ends the cell when true

  void heed_interrupt() const {
    if (is_interrupted && is_interrupted->load()) throw Interrupted{};
  }
};

/// Pins the server to the first of `processors` and the bots to all others; with fewer than two
/// neither is pinned.
void pin_apart(RunnerSettings& settings, const std::vector<int>& processors);

/// A text that reads back as the same number.
inline std::string decimal(double number) {
  std::ostringstream text;
  text.precision(17);
  text << number;
  return text.str();
}

/// The arguments that start the server of `cell`. To the programs `--duration` is the whole run,
/// warm-up included. `key_log` may be empty.
std::vector<std::string> serve_arguments(const Experiment& experiment, const Cell& cell,
                                         const std::filesystem::path& key_log,
                                         const std::filesystem::path& report);
/// The same for rink dds, of a cell of that mode; its bots find the server by `domain`.
std::vector<std::string> dds_serve_arguments(const Experiment& experiment, const Cell& cell,
                                             const std::filesystem::path& key_log,
                                             const std::filesystem::path& report);
std::vector<std::string> dds_bots_arguments(const Experiment& experiment, const Cell& cell,
                                            const std::filesystem::path& key_log,
                                            const std::string& domain,
                                            const std::filesystem::path& report);
/// The arguments that start the bots of `cell` against the server at `address` (ADDRESS:PORT).
std::vector<std::string> bots_arguments(const Experiment& experiment, const Cell& cell,
                                        const std::filesystem::path& key_log,
                                        const std::string& address,
                                        const std::filesystem::path& report);

}  // namespace rink::loadgen
