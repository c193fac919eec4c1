// The comparison as text for a terminal.
#pragma once

#include <span>
#include <string>

#include "loadgen/summary.h"

namespace rink::loadgen {

/// The rows in at most 100 columns, a block per mode and policy, a group of lines per client count, and below them what all runs say together: whether the
/// games agreed and which runs did not count. `is_coloured` adds ANSI emphasis to the least bytes of each group.
std::string table_of(std::span<const RunRecord> runs, bool is_coloured);

}  // namespace rink::loadgen
