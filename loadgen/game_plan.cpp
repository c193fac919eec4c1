// Reads the scene to learn how many bats play, and writes their plan as a key log.
#include "loadgen/game_plan.h"

#include <algorithm>
#include <utility>

#include "game/control/key_log.h"
#include "game/model/scene_file.h"
#include "loadgen/plan.h"
#include "loadgen/results.h"

namespace rink::loadgen {
namespace {

/// The scene as the server of `cell` will make it from its arguments.
game::Scene scene_of(const Experiment& experiment, const Cell& cell) {
  game::Scene scene = game::load_scene(experiment.scene);
  if (experiment.population == Population::per_client) scene = game::scaled_to_bats(std::move(scene), cell.clients);
  return cell.seed > 0 ? game::with_seed(std::move(scene), cell.seed) : scene;
}

void expect_bats_for_all(const Experiment& experiment, std::size_t bat_count) {
  const std::uint32_t most = *std::max_element(experiment.clients.begin(), experiment.clients.end());
  if (experiment.population == Population::per_client || most <= bat_count) return;
  throw ExperimentError("experiment " + experiment.name + ": clients = " + std::to_string(most) + ": scene " + experiment.scene + " has " +
                        std::to_string(bat_count) + " bats; allowed is at most as many clients, or population = \"per_client\"");
}

}  // namespace

void write_game_plan(const Experiment& experiment, const Cell& cell, const std::filesystem::path& file) {
  game::KeyLog log;
  try {
    const game::Scene scene = scene_of(experiment, cell);
    expect_bats_for_all(experiment, scene.bodies.bats.size());
    log = game::key_log_for(scene);
    log.events = random_plan(cell.seed, static_cast<std::uint32_t>(scene.bodies.bats.size()), experiment.warm_up_s + experiment.duration_s);
  } catch (const game::SceneError& error) {
    throw ExperimentError(error.what());
  }
  try {
    game::write_key_log(file, log);
  } catch (const game::SceneError& error) {
    throw OutputError(error.what());
  }
}

}  // namespace rink::loadgen
