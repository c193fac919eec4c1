// What several nodes that share a simulation cost and gain beside one server.
#pragma once

#include <span>
#include <string>

#include "loadgen/measure/run_record.h"

namespace rink::loadgen {

/// True if runs differ in the number of nodes.
bool has_several_nodes(std::span<const RunRecord> runs);

/// For a terminal: a row for each cell, and for each number of nodes a sentence that holds it
/// against the least number, by seeds; empty unless runs differ in it.
std::string nodes_table(std::span<const RunRecord> runs);

}  // namespace rink::loadgen
