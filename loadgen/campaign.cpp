// The loop over cells.
#include "loadgen/campaign.h"

#include <chrono>
#include <map>

namespace rink::loadgen {
namespace {

std::string game_of(const Experiment& experiment, const Cell& cell) {
  std::string game = "seed" + std::to_string(cell.seed);
  if (experiment.population == Population::per_client) game += "-" + std::to_string(cell.clients);
  return game;
}

/// Game name to key log, all written before the first cell starts, so that an impossible one is found before anything was waited for.
std::map<std::string, std::filesystem::path> write_key_logs(const Experiment& experiment, const ResultsDirectory& results, const KeyLogWriter& write) {
  std::map<std::string, std::filesystem::path> logs;
  const std::filesystem::path folder = results.subdirectory("keys");
  for (const Cell& cell : cells_of(experiment)) {
    const auto [log, is_new] = logs.try_emplace(game_of(experiment, cell), folder / (game_of(experiment, cell) + ".keys"));
    if (is_new) write(cell, log->second);
  }
  return logs;
}

}  // namespace

Outcome run_campaign(const Experiment& experiment, const RunnerSettings& settings, ResultsDirectory& results, const KeyLogWriter& write_key_log,
                     Progress& progress) {
  using Clock = std::chrono::steady_clock;
  Outcome outcome;
  try {
    const auto key_logs = write_key_logs(experiment, results, write_key_log);
    for (const Cell& cell : cells_of(experiment)) {
      progress.starts(cell);
      const auto start = Clock::now();
      const auto record = run_cell(settings, experiment, cell, key_logs.at(game_of(experiment, cell)));
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
