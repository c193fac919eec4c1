// Experiments read from files.
#pragma once

#include <filesystem>
#include <string_view>

#include "loadgen/experiment/experiment.h"

namespace rink::loadgen {

/// Reads `file`. Throws ExperimentError.
Experiment load_experiment(const std::filesystem::path& file, const Vocabulary& vocabulary);

/// Reads from `text`; `file` is named in errors, and a scene given as a path is relative to its
/// folder. Throws ExperimentError.
Experiment parse_experiment(std::string_view text, const std::filesystem::path& file,
                            const Vocabulary& vocabulary);

}  // namespace rink::loadgen
