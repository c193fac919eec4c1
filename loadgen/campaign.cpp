// The loop over cells.
#include "loadgen/campaign.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <utility>

#include "loadgen/peer_processes.h"
#include "loadgen/peer_run.h"
#include "loadgen/virtual_run.h"

namespace rink::loadgen {
namespace {

/// Game name to key log, all written before the first cell starts, so that an impossible one is found before anything was waited for.
std::map<std::string, std::filesystem::path> write_key_logs(const Experiment& experiment, const ResultsDirectory& results, const KeyLogWriter& write) {
  std::map<std::string, std::filesystem::path> logs;
  const std::filesystem::path folder = results.subdirectory("keys");
  for (const Cell& cell : cells_of(experiment)) {
    const auto [log, is_new] = logs.try_emplace(game_of(cell, experiment.population), folder / (game_of(cell, experiment.population) + ".keys"));
    if (is_new) write(cell, log->second);
  }
  return logs;
}

bool has_run_of(const Cell& cell, const std::vector<RunRecord>& runs) {
  return std::any_of(runs.begin(), runs.end(), [&cell](const RunRecord& run) { return run.cell == cell; });
}

}  // namespace

std::vector<RunRecord> runs_to_keep(const Experiment& experiment, const std::vector<RunRecord>& runs) {
  const std::vector<Cell> cells = cells_of(experiment);
  std::vector<RunRecord> kept;
  for (const RunRecord& run : runs) {
    if (std::find(cells.begin(), cells.end(), run.cell) != cells.end() && !has_run_of(run.cell, kept)) kept.push_back(run);
  }
  return kept;
}

Outcome run_campaign(const Experiment& experiment, const RunnerSettings& settings, ResultsDirectory& results, const KeyLogWriter& write_key_log,
                     Progress& progress, std::vector<RunRecord> kept) {
  using Clock = std::chrono::steady_clock;
  Outcome outcome;
  const std::vector<RunRecord> before = std::move(kept);
  outcome.runs = before;
  try {
    const auto key_logs = write_key_logs(experiment, results, write_key_log);
    for (const Cell& cell : cells_of(experiment)) {
      if (has_run_of(cell, before)) continue;
      progress.starts(cell);
      const auto start = Clock::now();
      const bool is_virtual = experiment.transport == TransportKind::virtual_time, has_peers = cell.mode == peer_mode;
      const auto run = has_peers ? (is_virtual ? run_virtual_peers : run_peer_processes) : is_virtual ? run_virtual_cell : run_cell;
      const auto record = run(settings, experiment, cell, key_logs.at(game_of(cell, experiment.population)));
      if (!record) {
        outcome.was_interrupted = true;
        break;
      }
      outcome.runs.push_back(*record);
      progress.finished(*record, std::chrono::duration<double>(Clock::now() - start).count());
      results.append(*record);
    }
  } catch (const OutputError& error) {
    outcome.output_failure = error.what();
  }
  progress.clear();
  return outcome;
}

}  // namespace rink::loadgen
