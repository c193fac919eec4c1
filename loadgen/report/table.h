// The comparison as text for a terminal.
#pragma once

#include <span>
#include <string>

#include "loadgen/measure/summary.h"

namespace rink::loadgen {

/// The rows in at most 120 columns, a block per mode, a group of lines per game, and below them a
/// summary: the savings by filter and policy alone and together, whether the games agreed and which
/// runs did not count. `is_coloured` adds ANSI emphasis to the least bytes of each group.
std::string table_of(std::span<const RunRecord> runs, bool is_coloured,
                     const Baseline& baseline = {});

}  // namespace rink::loadgen
