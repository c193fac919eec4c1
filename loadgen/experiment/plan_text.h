// Describes what an experiment would run, for --dry-run.
#pragma once

#include <cstddef>
#include <string>

#include "loadgen/experiment/experiment.h"

namespace rink::loadgen {

/// About how long one cell takes [s]: the play itself, and a second for start, joining and reports;
/// in virtual time that is unknown before the first has run.
double expected_cell_s(const Experiment& experiment);
/// The expected time of one of its cells [s].
double expected_cell_s(const Experiment& experiment, const Cell& cell);

/// The cells in order with the time at which each starts, the total, and the files and limits that
/// are needed. `open_files_max` is what the system allows.
std::string plan_text(const Experiment& experiment, std::size_t open_files_needed,
                      std::size_t open_files_max);

}  // namespace rink::loadgen
