// A report folder as an artefact: complete, checked by hashes, and repeated by `rink compare
// --from`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "loadgen/experiment/experiment.h"
#include "loadgen/measure/results.h"
#include "loadgen/measure/run_record.h"
#include "loadgen/run/run_journal.h"

namespace rink::loadgen {

/// A report folder that cannot be repeated; the message names the file and what is wrong with it.
class ReportFolderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes the experiment's inputs: experiment.toml, scene.toml and a recorded key log that it
/// names, if that lies below the experiment's folder. Throws OutputError.
void keep_inputs(const ResultsDirectory& results, const Experiment& experiment);

/// Writes manifest.json: the schema, the version, and length and hash (FNV-1a, 64 bits) of every
/// file below the folder but itself. Throws OutputError.
void write_manifest(const ResultsDirectory& results);

/// Throws ReportFolderError if the folder has no manifest, is of another schema or version, or
/// lacks a file of the manifest or has it altered.
void check_manifest(const std::filesystem::path& folder);

/// The experiment of a report folder, with the scene as it was then and the seeds of its runs.
/// Throws ReportFolderError, ExperimentError.
Experiment experiment_of_report(const std::filesystem::path& folder);

/// The runs of a report folder, and the commit of the program that made them. Throws
/// ReportFolderError, which names the line, if they cannot be read.
Journal journal_of_report(const std::filesystem::path& folder);

/// The comparison of repeated runs with the original ones.
struct Repetition {
  std::size_t virtual_runs = 0,
              virtual_same = 0;  ///< in virtual time, which must agree in every figure
  std::size_t games = 0,
              games_same =
                  0;  ///< runs by the clock with replayed keys, which must end in the same state
  double payload_apart =
      0.0;  ///< of runs by the clock: the greatest |again / before - 1| of payload
  std::size_t compared = 0,
              left_out = 0;  ///< runs that count on both sides; runs that only the earlier side has
  std::vector<std::string> differing;  ///< the run and its differing figures
  bool is_same() const { return differing.empty() && compared > 0; }
};

/// Compares runs of the same cells; cells of one side alone are ignored.
Repetition repetition_of(std::span<const RunRecord> before, std::span<const RunRecord> again);
std::string words_for(const Repetition& repetition, const std::filesystem::path& folder);
/// A warning that the folder's runs were made by another commit than this program's; empty if they
/// were not.
std::string commit_words(const Journal& journal, const std::filesystem::path& folder);

}  // namespace rink::loadgen
