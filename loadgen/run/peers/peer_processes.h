// Runs one cell of the mode peer-to-peer over sockets: a process of rink peer for each player, on
// loopback and in real time, from start to reports.
#pragma once

#include <filesystem>
#include <optional>

#include "loadgen/experiment/experiment.h"
#include "loadgen/measure/run_record.h"
#include "loadgen/run/cell_runner.h"

namespace rink::loadgen {

/// As run_cell, with the same keys, evidence and judgement. A peer that fails makes the run invalid
/// and is named.
std::optional<RunRecord> run_peer_processes(const RunnerSettings& settings,
                                            const Experiment& experiment, const Cell& cell,
                                            const std::filesystem::path& key_log);

}  // namespace rink::loadgen
