// Draws, plays or copies the keys of a game, and writes them as a key log.
#include "loadgen/run/game_plan.h"

#include <algorithm>
#include <utility>

#include "game/control/game.h"
#include "game/control/game_state.h"
#include "game/control/key_log_file.h"
#include "game/control/playing.h"
#include "game/net/server/serve_requirements.h"
#include "game/players/player_kinds.h"
#include "game/players/random_plan.h"
#include "game/replication/update_policy.h"
#include "loadgen/experiment/parameter.h"
#include "loadgen/measure/results.h"
#include "loadgen/mobility/trace_scene.h"
#include "rti/types.h"

namespace rink::loadgen {
namespace {

/// A game's key log is written for the first of its cells, so the largest cell counts.
void expect_bats_for_all(const Experiment& experiment, const Cell& first, std::size_t bat_count) {
  std::uint32_t most = first.clients;
  for (const Cell& cell : cells_of(experiment))
    if (cell.bats == first.bats) most = std::max(most, cell.clients);
  if (experiment.population == Population::per_client || most <= bat_count) return;
  throw ExperimentError(
      "experiment " + experiment.name + ": clients = " + std::to_string(most) + ": scene " +
      experiment.scene + " has " + std::to_string(bat_count) +
      " bats; allowed is at most as many clients, or population = \"per_client\"");
}

/// The RTI would refuse it, each cell anew and in words that don't name the scene. In virtual time
/// no bat comes back, so a server can use all regions of a federate.
void expect_bodies_for_a_server(const Experiment& experiment, std::size_t body_count) {
  const bool is_virtual = experiment.transport == TransportKind::virtual_time;
  const std::size_t most = is_virtual ? rti::region_max : game::served_bodies_max;
  if (body_count <= most ||
      std::ranges::all_of(experiment.modes, [](const auto& mode) { return mode == peer_mode; }))
    return;
  throw ExperimentError("experiment " + experiment.name + ": scene " + experiment.scene + " has " +
                        std::to_string(body_count) + " bodies; a server can publish at most " +
                        std::to_string(most) +
                        (is_virtual ? "" : ", in virtual time " + std::to_string(rti::region_max)));
}

/// Nodes would refuse it, each cell anew.
void expect_no_keys_among_nodes(const Experiment& experiment, const game::Scene& scene) {
  if (scene.keys.empty() || *std::ranges::max_element(experiment.nodes) == 1.0) return;
  throw ExperimentError("experiment " + experiment.name + ": nodes: scene " + experiment.scene +
                        " has scripted keys, and nodes play those of their clients; allowed is one "
                        "without, such as arena");
}

void expect_possession_to_be_kept(const Experiment& experiment, const game::Scene& scene) {
  if (scene.rules.possession_s == 0.0 ||
      (*std::ranges::max_element(experiment.nodes) == 1.0 &&
       std::ranges::count(experiment.modes, peer_mode) == 0 &&
       std::ranges::count(experiment.policies, game::exact_policy) == 0))
    return;
  throw ExperimentError("experiment " + experiment.name + ": scene " + experiment.scene +
                        " has [match] possession_s, which peers and nodes that divide a game and "
                        "clients of the policy exact do not compute");
}

/// Refuses what the agents of a trace cannot do, before cells run that would fail or be cut short.
void expect_what_traces_can(const Experiment& experiment, const Cell& of_game,
                            const PlayedScene& played) {
  const auto has = [](const auto& list, const auto& value) {
    return std::find(list.begin(), list.end(), value) != list.end();
  };
  const auto refuse = [&experiment](const std::string& what) {
    throw ExperimentError("experiment " + experiment.name + ": scene " + experiment.scene +
                          " is a trace: " + what);
  };
  if (experiment.transport != TransportKind::virtual_time)
    refuse("expected transport = \"virtual\", not " + std::string(to_string(experiment.transport)));
  if (has(experiment.modes, peer_mode))
    refuse(
        "its agents move by no law that peers share: expected modes = "
        "\"client-server\"");
  if (has(experiment.policies, game::exact_policy))
    refuse("no client can compute its agents: expected a policy other than exact");
  if (experiment.players != "random" || experiment.keys == KeySource::live)
    refuse("its agents press no keys: expected neither players nor keys");
  if (experiment.start_s > 0.0)
    refuse("expected start_s = 0; from_s of the population says where the run begins");
  if (experiment.relevance == Relevance::contact)
    refuse("its agents pass through each other: expected another relevance than contact");
  const double end_s = experiment.end_s();
  if (end_s > played.trace->end_s)
    refuse(
        "it goes on for " + shortest(played.trace->end_s) +
        " s from where the run begins; allowed are as many of warm_up_s and duration_s together, "
        "not " +
        shortest(end_s));
  std::uint32_t most = of_game.clients;  // in all cells of this game
  for (const Cell& cell : cells_of(experiment))
    if (game_of(cell, experiment.population) == game_of(of_game, experiment.population))
      most = std::max(most, cell.clients);
  if (const std::uint32_t staying = played.staying_until(end_s); most > staying)
    refuse("clients = " + std::to_string(most) + ", but of its " +
           std::to_string(played.trace->agents.size()) + " agents " + std::to_string(staying) +
           " are there for the whole run; allowed are as many clients");
}

/// Random players never look, so their keys need no game; players that look play it here, on its
/// true state. Live players that look will play by their replicas, so there is nothing to record. A
/// name of no kind of player is the path of a recorded log.
std::vector<game::InputEvent> keys_of(const Experiment& experiment, const Cell& cell,
                                      const game::Scene& scene) {
  const double until_s = experiment.end_s();
  if (experiment.players == "random")
    return game::random_plan(cell.seed, static_cast<std::uint32_t>(scene.bodies.bats.size()),
                             until_s);
  if (!game::is_player_kind(experiment.players)) {
    const game::KeyLog recorded = game::read_key_log(std::filesystem::path(experiment.players));
    game::require_fit(recorded, scene, experiment.players);
    game::require_keys_alone(recorded, experiment.players, "an experiment");
    return recorded.events;
  }
  if (experiment.keys == KeySource::live) return {};
  game::Playing playing(scene, {experiment.players}, cell.seed, until_s);
  playing.advance(until_s);
  return playing.keys();
}

/// The state of the game of `keys` at `instant_s`.
std::vector<std::uint8_t> state_at(double instant_s, const game::Scene& scene,
                                   const std::vector<game::InputEvent>& keys) {
  game::Game game(scene);
  for (const game::InputEvent& event : keys)
    if (event.time <= instant_s) game.submit(event);
  game.advance(instant_s);
  return game::GameState::save(game, scene);
}

}  // namespace

std::filesystem::path state_file_of(const std::filesystem::path& key_log) {
  return std::filesystem::path(key_log).replace_extension(".state");
}

game::SceneChoice choice_of(const Experiment& experiment, const Cell& cell) {
  return {.scene = experiment.scene,
          .bats = experiment.population == Population::per_client ? cell.clients : 0u,
          .bat_count = cell.bats,
          .puck_count = cell.pucks,
          .seed = cell.seed};
}

game::Scene scene_of(const Experiment& experiment, const Cell& cell) {
  return played_scene(choice_of(experiment, cell)).scene;
}

void write_game_plan(const Experiment& experiment, const Cell& cell,
                     const std::filesystem::path& file) {
  game::KeyLog log;
  game::Scene scene;
  try {
    PlayedScene played = played_scene(choice_of(experiment, cell));
    if (played.trace) expect_what_traces_can(experiment, cell, played);
    scene = std::move(played.scene);
    expect_bats_for_all(experiment, cell, scene.bodies.bats.size());
    expect_bodies_for_a_server(experiment, game::count_of(scene.bodies));
    expect_no_keys_among_nodes(experiment, scene);
    expect_possession_to_be_kept(experiment, scene);
    if (scene.world.field.goal_width > 0.0 &&
        std::find(experiment.modes.begin(), experiment.modes.end(), peer_mode) !=
            experiment.modes.end())
      throw ExperimentError(
          "experiment " + experiment.name + ": modes = " + peer_mode + ": scene " +
          experiment.scene +
          " has goals, which peers cannot share; allowed is one without, such as arena");
    log = game::key_log_for(scene);
    if (!played.trace) log.events = keys_of(experiment, cell, scene);
  } catch (const game::SceneError& error) {
    throw ExperimentError(error.what());
  }
  try {
    game::write_key_log(file, log);
    if (experiment.start_s > 0.0)
      game::write_game_state(state_file_of(file), state_at(experiment.start_s, scene, log.events));
  } catch (const game::SceneError& error) {
    throw OutputError(error.what());
  }
}

}  // namespace rink::loadgen
