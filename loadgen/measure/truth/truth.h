// Computes a run's quality afterwards: plays the game again, exactly, and holds what server and
// bots said against it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "game/net/server_trace.h"
#include "game/net/trace_lines.h"
#include "loadgen/measure/run_record.h"
#include "loadgen/measure/truth/bots_trace.h"
#include "loadgen/measure/truth/discovery.h"
#include "loadgen/measure/truth/relevance.h"

namespace rink::loadgen {

/// All figures but fairness and control bytes, which are counts of the reports. Definitions:
/// docs/metrics.md. Throws game::TraceError if the game played again does not end in the
/// server's state (DifferentGame), or if the evidence contradicts itself; game::SceneError if the
/// scene cannot be read. To who asks, `discoveries` too: none if the bots' evidence is incomplete.
TruthFigures truth_of(const game::ServerTrace& server, const BotsTrace& bots,
                      const RelevanceArea& area, Discoveries* discoveries = nullptr,
                      Entries entries = Entries::found);

/// Writes where everything was whenever `truth_of` looks (loadgen/measure/truth/trace.h), for
/// programs that judge again. Throws what `truth_of` does, and std::runtime_error if `file` cannot
/// be written.
void write_trace(const std::string& file, const game::ServerTrace& server, const BotsTrace& bots,
                 const RelevanceArea& area);

/// What `experiment` calls relevant in `cell`, which plays `scene`.
RelevanceArea relevance_of(const Experiment& experiment, const Cell& cell,
                           const game::Scene& scene);

/// Reads both files and fills `record.truth` and `record.tick_us`. Evidence that is missing,
/// truncated or altered leaves the figures absent and says why in `record.truth.trouble`; a game
/// that ends elsewhere when it is played again makes the run invalid. What was discovered when goes
/// to `discovery_file` (loadgen/measure/discovery_table.h), if there is one; throws OutputError if
/// that cannot be written, and nothing else.
void add_truth(RunRecord& record, const Experiment& experiment, const std::string& server_file,
               const std::string& bots_file, const std::filesystem::path& discovery_file = {});
/// The same of evidence that is in memory, which should be `rounded` so that files say the same.
/// Entries are passed over.
void add_truth(RunRecord& record, const Experiment& experiment, const game::ServerTrace& server,
               const BotsTrace& bots);
}  // namespace rink::loadgen
