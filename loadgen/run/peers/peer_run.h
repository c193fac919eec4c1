// Runs one cell of the mode peer-to-peer in this process under a virtual clock: a peer for each
// player, and the same network, keys, traces and evaluation as with a server.
#pragma once

#include <filesystem>
#include <optional>

#include "loadgen/experiment/experiment.h"
#include "loadgen/measure/run_record.h"
#include "loadgen/run/cell_runner.h"

namespace rink::loadgen {

/// As run_virtual_cell, with which it shares what it writes: NAME.peers.json and NAME.bots.json,
/// and evidence in NAME.server.jsonl and NAME.bots.jsonl. Throws ExperimentError.
std::optional<RunRecord> run_virtual_peers(const RunnerSettings& settings,
                                           const Experiment& experiment, const Cell& cell,
                                           const std::filesystem::path& key_log);

}  // namespace rink::loadgen
