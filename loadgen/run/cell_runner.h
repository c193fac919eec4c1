// Runs one cell: a server and its bots as two processes on loopback, from start to reports; or
// several nodes, each with bots of its own.
#pragma once

#include <filesystem>
#include <optional>

#include "loadgen/experiment/experiment.h"
#include "loadgen/measure/run_record.h"
#include "loadgen/run/process_arguments.h"

namespace rink::loadgen {

/// Runs `cell` and returns its record; every failure, also of starting a program, makes it invalid
/// and is its reason. Nothing if it was interrupted. All processes have ended when this returns.
std::optional<RunRecord> run_cell(const RunnerSettings& settings, const Experiment& experiment,
                                  const Cell& cell, const std::filesystem::path& key_log);

/// The results of a cell's processes, before the figures of truth.
struct ProcessRun {
  RunRecord record;
  bool has_reports = false;  ///< false: the run failed, for the reason in `record`, or it is of
                             ///< several nodes, which have no evidence for figures of truth
};
/// The two halves of `run_cell`: the processes, beside which nothing else may run, and the figures
/// of truth, which take one processor a third of a second and may be computed several at once.
/// Throws OutputError if the delays of discovery cannot be written.
std::optional<ProcessRun> run_processes(const RunnerSettings& settings,
                                        const Experiment& experiment, const Cell& cell,
                                        const std::filesystem::path& key_log);
RunRecord judged(const RunnerSettings& settings, const Experiment& experiment, ProcessRun run);

}  // namespace rink::loadgen
