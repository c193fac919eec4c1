// Where and how figures were taken, so that others can assess and repeat them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "loadgen/measure/statistics/histogram.h"

namespace rink::loadgen {

/// Facts as (name, text), in the order in which they are shown.
struct Provenance {
  std::vector<std::pair<std::string, std::string>> facts;
};

/// How late this machine wakes a sleeper: a thousand sleeps of 0.2 ms, taking about 0.3 s.
/// Latencies near its p99 are noise.
Histogram wake_up_lateness();

/// The program (commit, compiler, flags, libraries, command line), the machine (processor, cores,
/// governor, virtualisation, kernel, packages), the time, the load, and the timer's calibration.
Provenance provenance_of(const std::vector<std::string>& command_line, const Histogram& wake_ups);

/// The provenance of a run in virtual time: without time, load, calibration and the folder of the
/// results, so that a second run writes the same bytes.
Provenance reproducible_provenance_of(const std::vector<std::string>& command_line);

/// The facts as an object, in their order.
nlohmann::ordered_json to_json(const Provenance& provenance);

/// The facts as lines that begin with `# `, to stand before a table of comma-separated values.
std::string comment_lines(const Provenance& provenance);

}  // namespace rink::loadgen
