// rink simulate: physics and rules alone, no network and no clock but the one that times it.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "game/control/game.h"
#include "game/control/key_log.h"
#include "game/control/playing.h"
#include "game/model/scene_file.h"

namespace {

using namespace rink;
using Json = nlohmann::ordered_json;

constexpr int bad_input = 2;

struct Options {
  std::string scene, keys, states, summary, record;
  std::vector<std::string> players;
  double until = 0.0;
  std::optional<std::uint64_t> seed;
  std::optional<std::uint32_t> bats;
};

const char* kind_name(physics::BodyKind kind) { return kind == physics::BodyKind::puck ? "puck" : kind == physics::BodyKind::bat ? "bat" : "post"; }

game::Scene scene_of(const Options& options) {
  game::Scene scene = game::load_scene(options.scene);
  if (options.seed) scene = game::with_seed(std::move(scene), *options.seed);
  if (options.bats) scene = game::scaled_to_bats(std::move(scene), *options.bats);
  return scene;
}

void submit_keys(game::Game& game, const game::Scene& scene, const std::string& file) {
  if (file.empty()) return;
  const game::KeyLog log = game::read_key_log(std::filesystem::path(file));
  game::require_fit(log, scene, file);
  for (const game::InputEvent& event : log.events) game.submit(event);
}

/// Opened before the simulation, so that a long run does not end in a path that cannot be written.
std::ofstream opened(const std::string& file) {
  std::ofstream stream;
  if (file.empty()) return stream;
  stream.open(file);
  if (!stream) throw game::SceneError(file + ": cannot be written");
  return stream;
}

void close(std::ofstream& stream, const std::string& file) {
  if (file.empty()) return;
  stream.close();
  if (!stream) throw game::SceneError(file + ": cannot be written to its end");
}

void write_states(std::ostream& stream, const game::Game& game) {
  stream << "kind,id,x,y,vx,vy\n";
  stream.precision(17);
  for (const game::Entity& entity : game.entities()) {
    const game::Vector2 position = game.position(entity.id), velocity = game.velocity(entity.id);
    stream << kind_name(entity.kind) << ',' << entity.id.index << ',' << position.x() << ',' << position.y() << ',' << velocity.x() << ',' << velocity.y() << '\n';
  }
}

Json summary_of(const game::Game& game, double wall_s) {
  const physics::Counters counters = game.simulator().counters();
  const physics::Vector2 momentum = game.simulator().momentum();
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016" PRIx64, game.hash());
  return {{"time", game.now()},
          {"events", counters.events()},
          {"collisions", counters.impacts()},
          {"events_by_kind",
           {{"puck_puck", counters.disc_impacts},
            {"post", counters.post_impacts},
            {"wall", counters.wall_impacts},
            {"puck_bat", counters.bat_impacts},
            {"bat_bat", counters.bat_bat_impacts},
            {"goal", counters.goals},
            {"thrust", counters.thrust_changes},
            {"rest", counters.rests},
            {"release", counters.releases},
            {"hop", counters.hops},
            {"freeze", counters.freezes}}},
          {"kinetic_energy", game.simulator().kinetic_energy()},
          {"momentum_x", momentum.x()},
          {"momentum_y", momentum.y()},
          {"goals_left", game.score().left},
          {"goals_right", game.score().right},
          {"is_over", game.is_over()},
          {"hash", hash},
          {"wall_s", wall_s}};
}

/// `played` is a Game or a Playing.
template <class Played>
double advance_timed(Played& played, double until) {
  const auto start = std::chrono::steady_clock::now();
  played.advance(until);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void write_results(const Options& options, const game::Game& game, double wall_s, std::ofstream& states, std::ofstream& summary) {
  if (!options.states.empty()) write_states(states, game);
  (options.summary.empty() ? std::cout : summary) << summary_of(game, wall_s).dump(2) << '\n';
  close(states, options.states);
  close(summary, options.summary);
}

void simulate(const Options& options) {
  const game::Scene scene = scene_of(options);
  std::ofstream states = opened(options.states), summary = opened(options.summary), record = opened(options.record);
  if (options.players.empty()) {
    game::Game game(scene);
    submit_keys(game, scene, options.keys);
    write_results(options, game, advance_timed(game, options.until), states, summary);
    return;
  }
  game::Playing playing(scene, options.players, scene.seed, options.until);
  write_results(options, playing.game(), advance_timed(playing, options.until), states, summary);
  if (options.record.empty()) return;
  game::KeyLog log = game::key_log_for(scene);
  log.events = playing.events();
  game::write_key_log(record, log);
  close(record, options.record);
}

std::string allowed_players() {
  std::string names = "random";
  for (const std::string& name : game::player_kinds()) names += ", " + name;
  return names;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Advances a scene exactly, without a network, and writes what became of it.", "rink simulate");
  app.add_option("scene", options.scene, "a scene file (docs/scenes.md) or the name of a preset, such as match or crowd")->required();
  app.add_option("--until", options.until, "simulated time at which to stop [s]")->required()->check([](const std::string& text) -> std::string {
    double until = 0.0;
    if (!CLI::detail::lexical_cast(text, until) || !std::isfinite(until) || until < 0.0) return text + ": expected a finite time of 0 s or more, for time neither runs backwards nor for ever";
    return {};
  });
  CLI::Option* keys = app.add_option("--keys", options.keys, "a recorded key log to play (default: the scene's scripted keys only)");
  CLI::Option* players = app.add_option("--players", options.players, "who plays the bats, in turn, separated by commas: " + allowed_players() + "; seeded like the scene (default: nobody)")
                             ->delimiter(',')
                             ->excludes(keys)
                             ->check([](const std::string& name) { return game::is_player_kind(name) ? std::string() : name + ": expected one of " + allowed_players(); });
  app.add_option("--record", options.record, "write what the players pressed to this key log, which --keys and rink serve --keys play again")->needs(players);
  app.add_option("--seed", options.seed, "seed of the scene's populations (default: the scene's own)");
  app.add_option("--bats", options.bats, "scale the crowd to so many bats at constant density (default: as it is)");
  app.add_option("--states", options.states, "write every entity's final state to this CSV file: kind,id,x,y,vx,vy");
  app.add_option("--summary", options.summary, "write events, energy, momentum and hash to this JSON file (default: standard output)");
  app.footer("Example: rink simulate crowd --until 10 --states states.csv\nExample: rink simulate match --players chaser,random --until 120 --seed 3 --record match.keys\nExit status: 0 done, 2 bad scene, key log or flag.");
  try {
    app.parse(argc, argv);
    simulate(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : bad_input;
  } catch (const std::exception& error) {
    std::cerr << "rink simulate: " << error.what() << '\n';
    return bad_input;
  }
}
