// Runs all cells of an experiment in order and keeps all measurements, even if it is interrupted.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "loadgen/measure/results.h"
#include "loadgen/run/cell_runner.h"
#include "loadgen/run/progress.h"

namespace rink::loadgen {

/// Writes the key log of `cell`'s game to `file`. Throws ExperimentError if the scene cannot serve
/// the cell, OutputError if the file cannot be written.
using KeyLogWriter = std::function<void(const Cell& cell, const std::filesystem::path& file)>;

/// The result of a campaign.
struct CampaignResult {
  std::vector<RunRecord>
      runs;  ///< in the order of cells_of(), those that were kept from before among them
  bool was_interrupted = false;
  std::string output_failure;  ///< why results could not be written, empty if they could; nothing
                               ///< runs after that
};

/// The cells to run, the programs, and the folder of the results.
struct Campaign {
  const Experiment& experiment;
  const RunnerSettings& settings;
  ResultsDirectory& results;
  KeyLogWriter write_key_log;
};

/// Runs, in their running_order(), every cell that is not among the `kept` runs of an earlier
/// start, appending each record to the results. The key log of a game is written once, to their
/// folder keys, and shared by all its cells. Throws ExperimentError, before the first cell runs.
CampaignResult run_campaign(const Campaign& campaign, Progress& progress,
                            std::vector<RunRecord> kept = {});

/// The `runs` of an earlier start that are cells of `experiment`, each once.
std::vector<RunRecord> runs_to_keep(const Experiment& experiment,
                                    const std::vector<RunRecord>& runs);

}  // namespace rink::loadgen
