// Continues an earlier start of the same experiment that was cut short.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "loadgen/experiment/experiment.h"
#include "loadgen/measure/results.h"
#include "loadgen/run/run_journal.h"

namespace rink::loadgen {

/// An opened folder and the runs in it that are kept.
struct Continuation {
  ResultsDirectory results;
  std::vector<RunRecord> kept;
  std::string said;  ///< lines for the user: the kept runs, and harmless faults that were found
};

/// The newest of the folders that `free_directory` names in `parent`, or `report` if there is none.
std::filesystem::path latest_directory(const std::filesystem::path& parent);

/// Opens `path` to continue `experiment`; a folder without a journal is started afresh. `own` is
/// the expected head of the journal: runs of another experiment or commit are kept only if
/// `is_forced`. Throws OutputError if they may not be, or if the journal cannot be read.
Continuation continued_in(const std::filesystem::path& path, const Experiment& experiment,
                          const JournalHead& own, bool is_forced);

}  // namespace rink::loadgen
