// The key log of a cell's game: a seeded plan for all bats of its scene.
#pragma once

#include <filesystem>

#include "loadgen/experiment.h"

namespace rink::loadgen {

/// Writes the keys of `cell`'s game, warm-up included, to `file`: those of every bat of the scene if the population is fixed, one bat per client otherwise.
/// Throws ExperimentError if the scene cannot be read or has fewer bats than the experiment's largest cell has clients, OutputError if `file` cannot be
/// written.
void write_game_plan(const Experiment& experiment, const Cell& cell, const std::filesystem::path& file);

}  // namespace rink::loadgen
