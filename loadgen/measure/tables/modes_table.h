// A table of modes side by side: bytes for each client by purpose, and the load of the busiest
// node.
#pragma once

#include <span>
#include <string>

#include "loadgen/measure/run_record.h"

namespace rink::loadgen {

bool has_several_modes(std::span<const RunRecord> runs);

/// A line per mode, scheme, policy and client count, means over valid runs; empty if all runs are
/// of one mode.
std::string modes_table(std::span<const RunRecord> runs);

}  // namespace rink::loadgen
