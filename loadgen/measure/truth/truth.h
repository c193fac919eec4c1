// Computes a run's quality afterwards: replays the game exactly, and compares the traces of server
// and bots with it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "game/net/bots_trace.h"
#include "game/net/server_trace.h"
#include "game/net/trace_lines.h"
#include "loadgen/measure/run_record.h"
#include "loadgen/measure/truth/discovery.h"
#include "loadgen/measure/truth/relevance.h"

namespace rink::loadgen {

/// All figures but fairness and control bytes, which are counts of the reports. Definitions:
/// docs/metrics.md. Throws game::TraceError if the game played again does not end in the
/// server's state (DifferentGame), or if the evidence contradicts itself; game::SceneError if the
/// scene cannot be read. Fills `discoveries` too unless it is null: empty if the bots' trace is
/// incomplete.
TruthFigures truth_of(const game::ServerTrace& server, const game::BotsTrace& bots,
                      const RelevanceArea& area, Discoveries* discoveries = nullptr,
                      Entries entries = Entries::found);

/// Writes all positions at each look of `truth_of` (loadgen/measure/truth/trace.h), for programs
/// that check the figures. Throws what `truth_of` does, and std::runtime_error if `file` cannot be
/// written.
void write_trace(const std::string& file, const game::ServerTrace& server,
                 const game::BotsTrace& bots, const RelevanceArea& area);

/// The definition of relevance of `experiment` in `cell`, which plays `scene`.
RelevanceArea relevance_of(const Experiment& experiment, const Cell& cell,
                           const game::Scene& scene);

/// Reads both files and fills `record.truth` and `record.tick_us`. A trace that is missing,
/// truncated or altered leaves the figures absent, with the reason in `record.truth.error`; a
/// replay that ends in another state makes the run invalid. The delays of discovery are written to
/// `discovery_file` (loadgen/measure/tables/discovery_table.h), if there is one; throws OutputError
/// if that cannot be written, and nothing else.
void add_truth(RunRecord& record, const Experiment& experiment, const std::string& server_file,
               const std::string& bots_file, const std::filesystem::path& discovery_file = {});
/// Adds figures from traces in memory, which should be `rounded` so that they equal those of files.
/// Late entries are not looked for.
void add_truth(RunRecord& record, const Experiment& experiment, const game::ServerTrace& server,
               const game::BotsTrace& bots);
}  // namespace rink::loadgen
