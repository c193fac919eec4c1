// All figures of all runs in one long table, an observation per line, for programs that compute
// statistics of their own.
#pragma once

#include <span>
#include <string>

#include "loadgen/measure/run_record.h"

namespace rink::loadgen {

/// CSV (RFC 4180), a line for each figure that a run has, in the order of `runs` and of
/// `figures()`: part, mode, scheme, policy, clients, pucks, bats, server_cores, every parameter,
/// seed, valid (true or false), figure, unit, value. Invalid runs are included; a figure that is
/// absent has no line.
std::string tidy_csv(std::span<const RunRecord> runs);

}  // namespace rink::loadgen
