// rink simulate: physics and rules alone, no network and no clock but the one that times it.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <exception>
#include <fstream>
#include <iostream>

#include "game/apps/command.h"
#include "game/apps/simulate_report.h"
#include "game/control/game.h"
#include "game/control/key_log_file.h"
#include "game/control/playing.h"
#include "game/control/simulate_progress.h"
#include "game/model/listed.h"
#include "game/model/scene_file.h"
#include "game/model/system_reason.h"
#include "game/net/interrupt.h"
#include "game/physics/overrun.h"
#include "game/players/player_kinds.h"
#include "game/process/thread_team.h"
#include "game/version/version.h"

namespace {

using namespace rink;

constexpr int bad_input = 2, over_budget = 3, interrupted = 130;
constexpr double frames_max = 1e12;
constexpr double until_max = 1e9;  // s, as in scenes
constexpr std::uint64_t budget_max = 1'000'000'000'000;

struct Options {
  std::string scene, keys, states, events, summary, record;
  std::vector<std::string> players;
  double until = 0.0;
  std::optional<std::uint64_t> seed, events_per_s;
  std::optional<std::uint32_t> bats, threads, games;
  physics::SimulatorChoice engine;
  bool has_integrator = false, has_dt = false;
};

/// The first interrupt ends the run between two strides, with the results so far. A stride may take
/// very long, so the second one ends the process at once.
void hear_first_interrupt() {
  std::signal(SIGINT, [](int number) {
    game::is_interrupted = true;
    std::signal(number, SIG_DFL);
  });
}

game::Scene scene_of(const Options& options) {
  game::Scene scene = game::load_scene(options.scene);
  if (options.seed) scene = game::with_seed(std::move(scene), *options.seed);
  if (options.bats) scene = game::scaled_to_bats(std::move(scene), *options.bats);
  scene.world.accounts_energy = true;
  if (scene.network_grid > 0.0 && options.engine.engine != "exact")
    throw game::SceneError("the scene " + scene.name + " has a network_grid, which the engine " +
                           options.engine.engine + " knows nothing of: expected --engine exact");
  if (scene.rules.possession_s > 0.0 && options.engine.engine != "exact")
    throw game::SceneError("the scene " + scene.name +
                           " has possession_s, a rule that the engine " + options.engine.engine +
                           " cannot keep: expected --engine exact, or a scene without, as paper");
  return scene;
}

std::vector<game::InputEvent> submit_keys(game::Game& game, const game::Scene& scene,
                                          const std::string& file) {
  if (file.empty()) return {};
  const game::KeyLog log = game::read_key_log(std::filesystem::path(file));
  game::require_fit(log, scene, file);
  for (const game::InputEvent& event : log.events) game.submit(event);
  return log.events;
}

/// After each attempt to write, before anything else sets errno.
void require_written(bool is_written, const std::string& what) {
  if (!is_written)
    throw game::SceneError(what + ": cannot be written to its end: " + game::system_reason(errno));
}

/// Opened before the simulation, so that a long run does not end in a path that cannot be written.
std::ofstream opened(const std::string& file) {
  std::ofstream stream;
  if (file.empty()) return stream;
  errno = 0;
  stream.open(file);
  if (!stream) throw game::SceneError(file + ": cannot be written: " + game::system_reason(errno));
  return stream;
}

void close(std::ofstream& stream, const std::string& file) {
  if (file.empty()) return;
  stream.close();
  require_written(stream.good(), file);
}

/// What happened in the last stride; a disk that is full ends the run there, not after it.
template <class Played>
void write_events(const Played& played, const Options& options, std::ofstream& events) {
  if (options.events.empty()) return;
  errno = 0;
  game::write_events(events, played.events());
  require_written(events.good(), options.events);
}

/// The files of results, all of which are opened before the first step.
struct Outputs {
  explicit Outputs(const Options& options)
      : states(opened(options.states)),
        events(opened(options.events)),
        summary(opened(options.summary)),
        record(opened(options.record)) {}
  std::ofstream states, events, summary, record;
};

/// Advances in strides of about a tenth of a second, so that progress is shown and events are
/// written as they come. The strides do not affect the game. `played` is a Game or a Playing,
/// `game` the game itself; it ends early if `budget` is exceeded or it is interrupted. Returns how
/// long it took [s].
template <class Played>
double play(Played& played, const game::Game& game, const Options& options,
            std::optional<physics::EventBudget>& budget, std::ofstream& events) {
  constexpr double stride_least_s = 0.05, stride_most_s = 0.2;
  const double start_s = game::now_s();
  const auto passed_s = [&] { return game::now_s() - start_s; };
  game::SimulateProgress progress(std::cerr, isatty(STDERR_FILENO) != 0, options.until);
  if (!options.events.empty()) played.record_events(true), game::write_events_heading(events);
  double stride = std::clamp(options.until / 1024.0, 1e-9, 0.01), before_s = 0.0;
  do {
    const double next = std::min(options.until, game.now() + stride);
    if (budget) played.advance(next, *budget);
    else played.advance(next);
    write_events(played, options, events);
    const double after_s = passed_s();
    if (after_s - before_s < stride_least_s) stride *= 2.0;
    if (after_s - before_s > stride_most_s) stride = std::max(stride / 2.0, 1e-9 * options.until);
    before_s = after_s;
    progress.reached(game.now(), game.simulator().counters().events(), after_s);
  } while (game.now() < options.until && !game.is_cut_short() && !game::is_interrupted);
  progress.clear();
  return passed_s();
}

void write_results(const Options& options, const game::Game& game, double wall_s,
                   const std::optional<physics::EventBudget>& budget, Outputs& outputs) {
  errno = 0;
  if (!options.states.empty()) game::write_states(outputs.states, game);
  const bool are_states_written = outputs.states.flush().good();
  const int states_error = errno;
  errno = 0;
  (options.summary.empty() ? std::cout : outputs.summary)
      << game::summary_of(game, options.engine, wall_s, budget) << '\n';
  require_written(std::cout.flush().good(), "the standard output");
  errno = states_error;
  require_written(are_states_written, options.states);
  errno = 0;
  close(outputs.events, options.events);
  close(outputs.summary, options.summary);
}

/// Writes all that a replay on the exact engine needs, and, if that engine played, the hash to
/// compare.
void write_record(const Options& options, const game::Scene& scene, const game::Game& game,
                  std::vector<game::InputEvent> events, std::ofstream& record) {
  if (options.record.empty()) return;
  game::KeyLog log = game::key_log_for(scene);
  log.scene_text = game::scene_text(options.scene);
  log.until = game.now();
  if (options.engine.engine == "exact" && !game.is_cut_short()) log.hash = game.hash();
  std::erase_if(events, [&](const game::InputEvent& event) { return event.time > game.now(); });
  log.events = std::move(events);
  errno = 0;
  game::write_key_log(record, log);
  close(record, options.record);
}

int status_after(const game::Game& game, const Options& options,
                 const std::optional<physics::EventBudget>& budget) {
  if (!game.is_cut_short()) {
    if (game.now() >= options.until) return 0;
    game::complain("interrupted: the results are those of ", game.now(), " s");
    return interrupted;
  }
  game::complain("stopped by --budget: ",
                 physics::text_of(physics::overrun_of(game.world(), *budget)));
  return over_budget;
}

void require_room_for(std::uint32_t threads, const game::Scene& scene) {
  const auto objection = game::objection_to_threads(threads, count_of(scene.bodies));
  if (objection) throw game::SceneError("--threads: " + *objection);
}

/// Instead of one game: how many goals come in a minute, over many.
int measure_goals(const Options& options) {
  if (options.until == 0.0 || options.engine.engine != "exact")
    throw game::SceneError("--games: expected --until above 0 and --engine exact");
  if (!options.states.empty() || !options.events.empty() || options.events_per_s || options.threads)
    throw game::SceneError("--games: --states, --events, --budget and --threads are of one game");
  const game::Scene scene = scene_of(options);
  const game::GoalRatePlan plan{.players = options.players,
                                .games = *options.games,
                                .seconds = options.until,
                                .seed = scene.seed,
                                .is_interrupted = [] { return game::is_interrupted.load(); }};
  hear_first_interrupt();
  std::ofstream summary = opened(options.summary);
  const game::GoalRate rate = game::goal_rate(scene, plan);
  errno = 0;
  (options.summary.empty() ? std::cout : summary) << game::summary_of(scene, plan, rate) << '\n';
  require_written(std::cout.flush().good(), "the standard output");
  close(summary, options.summary);
  if (rate.games == plan.games) return 0;
  game::complain("interrupted: the results are those of ", rate.games, " games");
  return interrupted;
}

int simulate(const Options& options) {
  if (options.games) return measure_goals(options);
  game::Scene scene = scene_of(options);
  const std::uint32_t threads = options.threads.value_or(1);
  require_room_for(threads, scene);
  game::ThreadTeam team(threads);
  scene.world.slabs = physics::SlabPlan{.workers = &team};
  Outputs outputs(options);
  std::optional<physics::EventBudget> budget;
  if (options.events_per_s) budget.emplace(*options.events_per_s);
  hear_first_interrupt();
  if (options.players.empty()) {
    game::Game game(scene, options.engine);
    const std::vector<game::InputEvent> keys = submit_keys(game, scene, options.keys);
    const double wall_s = play(game, game, options, budget, outputs.events);
    write_results(options, game, wall_s, budget, outputs);
    write_record(options, scene, game, keys, outputs.record);
    return status_after(game, options, budget);
  }
  game::Playing playing(scene, options.players, scene.seed, options.until, options.engine);
  const double wall_s = play(playing, playing.game(), options, budget, outputs.events);
  write_results(options, playing.game(), wall_s, budget, outputs);
  write_record(options, scene, playing.game(), playing.keys(), outputs.record);
  return status_after(playing.game(), options, budget);
}

/// Throws if the chosen engine has a fault.
void require_engine(const Options& options) {
  if (const auto objection = physics::objection(options.engine)) throw game::SceneError(*objection);
  if (options.engine.engine == "exact" && (options.has_integrator || options.has_dt))
    throw game::SceneError(
        std::string(options.has_dt ? "--dt" : "--integrator") +
        " is for the engines paper and naive: the exact engine has neither frames nor integrators");
  if (options.engine.engine != "exact" && options.events_per_s)
    throw game::SceneError(
        "--budget is for the exact engine: what the others cost is set by --dt, not by events");
  if (options.engine.engine != "exact" && options.threads)
    throw game::SceneError("--threads is for the exact engine: the others play by one thread");
  const double frames = options.until / options.engine.dt;
  if (options.engine.engine != "exact" && frames > frames_max)
    throw game::SceneError(
        "--until " + std::to_string(options.until) +
        " would take more than 1e12 frames of --dt: expected longer frames or less time");
}

std::string allowed_players() { return "random, nobody, " + game::listed(game::player_kinds()); }

}  // namespace

int main(int count, char** words) {
  Options options;
  game::speak_as("rink simulate");
  game::Flags flags(
      "Advances a scene without a network, exactly or in frames, and writes the results.",
      "rink simulate");
  flags.version(game::version_line("rink-simulate"));
  flags
      .option("scene", options.scene,
              "a scene file (docs/scenes.md) or the name of a preset, such as match or crowd")
      .is_required();
  flags.option("--until", options.until, "simulated time at which to stop [s]")
      .is_required()
      .check([](const std::string& text) -> std::string {
        const std::optional<double> until = game::number_in(text);
        if (!until || !std::isfinite(*until) || *until < 0.0)
          return text +
                 ": expected a finite time of 0 s or more, since time runs neither backwards nor "
                 "for "
                 "ever";
        if (*until > until_max)
          return text +
                 ": expected at most 1e9 s, since beyond that a clock in doubles no longer "
                 "separates "
                 "impacts";
        return {};
      });
  const game::Flag keys =
      flags.option("--keys", options.keys,
                   "a recorded key log to play (default: the scene's scripted keys only)");
  flags
      .option("--players", options.players,
              "kinds of the bats' players, in turn, separated by commas: " + allowed_players() +
                  "; seeded like the scene (default: none)")
      .delimiter(',')
      .excludes(keys)
      .check([](const std::string& name) {
        return name == game::Playing::nobody || game::is_player_kind(name)
                   ? std::string()
                   : name + ": expected one of " + allowed_players();
      });
  const game::Flag players = flags.find("--players");
  const game::Flag record = flags.option(
      "--record", options.record,
      "write the game to this key log: scene, keys and final hash; rink replay, --keys "
      "and rink serve --keys play it again");
  flags
      .option("--games", options.games,
              "play so many games instead of one, each of --until seconds, without an end by goals "
              "and from a start of its own, and print how many goals come in a minute")
      .check(game::whole_number_from(1, 1'000'000))
      .needs(players)
      .excludes(record);
  flags.option("--seed", options.seed,
               "seed of the scene's populations (default: the scene's own)");
  flags
      .option(
          "--bats", options.bats,
          "scale the crowd to so many bats at constant density, at most 100000 (default: as it is)")
      .check(game::whole_number_from(0, 100'000));
  flags
      .option("--engine", options.engine.engine,
              "engine that moves the bodies: " + game::listed(physics::engine_names()) +
                  " (docs/physics.md, docs/paper-engine.md)")
      .shows_default();
  flags
      .option(
          "--integrator", options.engine.integrator,
          "integrator of the engines paper and naive: " + game::listed(physics::integrator_names()))
      .shows_default();
  flags.option("--dt", options.engine.dt, "length of a frame of the engines paper and naive [s]")
      .shows_default();
  flags
      .option("--budget", options.events_per_s,
              "stop where more events than this come in a simulated second, and say which bodies "
              "have them and why (default: no limit)")
      .check(game::whole_number_from(1, budget_max));
  flags
      .option("--threads", options.threads,
              "threads that play parts of a field of free pucks at once, with the same results "
              "(docs/physics.md; default: 1)")
      .check(game::whole_number_from(1, game::ThreadTeam::count_max));
  flags.option("--states", options.states,
               "write every entity's final state to this CSV file: kind,id,x,y,vx,vy");
  flags.option("--events", options.events,
               "write every event to this CSV file: time,kind,body,other");
  flags.option("--summary", options.summary,
               "write counts, energies, momentum, overlap and hash to this JSON file (default: "
               "standard output)");
  flags.footer(
      "Example: rink simulate crowd --until 10 --states states.csv\nExample: rink simulate crowd "
      "--until 10 --engine paper --integrator rk4 --dt 0.004\nExample: rink simulate match "
      "--players chaser,random --until 120 --seed 3 --record match.keys\nExample: rink simulate "
      "match "
      "--players chaser-expert,nobody --until 60 --games 100\nExit status: 0 done, 2 "
      "bad scene, key log or flag, 3 stopped by --budget, 130 interrupted (with the results of "
      "the instant reached; a second interrupt ends at once).");
  return game::run_command(flags, count, words,
                           {.run =
                                [&] {
                                  options.has_integrator = flags.is_given("--integrator");
                                  options.has_dt = flags.is_given("--dt");
                                  require_engine(options);
                                  return simulate(options);
                                },
                            .status_of = [](const std::exception&) { return bad_input; },
                            .hears_interrupts = false});
}
