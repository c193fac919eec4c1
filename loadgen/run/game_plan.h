// Writes the key log of a cell's game: the keys of the experiment's players, for all bats of its
// scene.
#pragma once

#include <filesystem>

#include "game/net/scene_choice.h"
#include "loadgen/experiment/experiment.h"

namespace rink::loadgen {

/// The scene that the server of `cell` is started with.
game::SceneChoice choice_of(const Experiment& experiment, const Cell& cell);

/// The scene as the server of `cell` makes it from its arguments, or that of a trace. Throws
/// game::SceneError.
game::Scene scene_of(const Experiment& experiment, const Cell& cell);

/// The file of the saved game from which the runs of `key_log`'s game begin, beside the log.
std::filesystem::path state_file_of(const std::filesystem::path& key_log);

/// Writes the keys of `cell`'s game, all from the scene's beginning, to `file`,
/// and for one that starts warm the game that they make of the scene by start_s to
/// state_file_of(file): those of every bat of the scene if the population is fixed, one bat per
/// client otherwise. Random keys are drawn; players who decide play the game here, on its true
/// state; a recorded log is taken over; live players who decide leave an empty log, as do the
/// agents of a trace. The same experiment and cell give the same bytes. Throws ExperimentError if
/// the scene or a recorded log cannot be read or do not fit each other, if the scene has fewer bats
/// than the experiment's largest cell has clients, or if it is a trace and the experiment asks for
/// what traces have not; OutputError if `file` cannot be written.
void write_game_plan(const Experiment& experiment, const Cell& cell,
                     const std::filesystem::path& file);

}  // namespace rink::loadgen
