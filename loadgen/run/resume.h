// Goes on where an earlier start of the same experiment was cut short.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "loadgen/experiment/experiment.h"
#include "loadgen/measure/results.h"
#include "loadgen/run/run_journal.h"

namespace rink::loadgen {

/// An opened folder and what is to be kept of what it holds.
struct Continuation {
  ResultsDirectory results;
  std::vector<RunRecord> kept;
  std::string said;  ///< lines for the user: what is kept, and what was found wrong but bearable
};

/// The newest of the folders that `free_directory` names in `parent`, or `report` if there is none.
std::filesystem::path latest_directory(const std::filesystem::path& parent);

/// Opens `path` to go on with `experiment`; a folder without a journal is started afresh. `own` is
/// what the journal's head has to say: runs of another experiment or commit are mixed in only if
/// `is_forced`. Throws OutputError if they may not be, or if the journal cannot be read.
Continuation continued_in(const std::filesystem::path& path, const Experiment& experiment,
                          const JournalHead& own, bool is_forced);

}  // namespace rink::loadgen
