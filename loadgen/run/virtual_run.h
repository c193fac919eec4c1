// Runs one cell in this process under a virtual clock: server, network and bots of a real run, and
// time that only this loop advances.
#pragma once

#include <filesystem>
#include <optional>

#include "loadgen/experiment/experiment.h"
#include "loadgen/measure/run_record.h"
#include "loadgen/run/cell_runner.h"

namespace rink::loadgen {

/// Runs `cell` as `run_cell` does, over the experiment's modelled network instead of loopback and
/// with ticks at their exact instants; computing takes no time. Writes the same reports; what needs
/// a real clock, a process or a kernel is null in them. The same arguments give the same bytes.
/// Throws ExperimentError if the scene or the key log cannot be read. Nothing if it was
/// interrupted.
std::optional<RunRecord> run_virtual_cell(const RunnerSettings& settings,
                                          const Experiment& experiment, const Cell& cell,
                                          const std::filesystem::path& key_log);

}  // namespace rink::loadgen
