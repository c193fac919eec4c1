// rink-dds: the game over Cyclone DDS with partitions as its filter, as a server or as its bots.
#include <cstdio>
#include <exception>
#include <string>

#include "game/apps/command.h"
#include "game/model/scene_file.h"
#include "game/net/exit_status.h"
#include "game/net/interrupt.h"
#include "game/net/limits.h"
#include "game/version/version.h"
#include "loadgen/dds/dds_engine.h"
#include "loadgen/dds/domain.h"

namespace {

using namespace rink;
using game::ExitStatus;

struct Options {
  std::string role;
  loadgen::DdsServeOptions serve;
  loadgen::DdsBotsOptions bots;
  std::string report, trace, keys;
  std::optional<std::uint32_t> domain;
  std::uint64_t seed = 1;
  double duration_s = 10.0, warm_up_s = 0.0, patience_s = 30.0;
};

void add_options(game::Flags& flags, Options& options) {
  using game::number_from, game::whole_number_from;
  constexpr std::uint32_t domain_max = 99;
  flags.footer(
      "Example: rink dds serve --clients 4 --domain 7 & rink dds bots --domain 7 --count 4\n\n"
      "Exit status: 0 done, 1 failed, 2 bad flag or file, 10 domain in "
      "use, 16 the server left, 17 the others did not come, 130 interrupted.");
  flags.option("role", options.role, "serve or bots")
      .check(game::one_of({"serve", "bots"}))
      .is_required();
  flags
      .option("--domain", options.domain,
              "of DDS, on the loopback interface alone; a server without it takes one that is free")
      .check(whole_number_from(0, domain_max));
  flags.option("--scene", options.serve.scene, "serve: preset or file").shows_default();
  flags
      .option("--scheme", options.serve.scheme,
              "serve: grid, a partition per cell, or none, one for all")
      .check(game::one_of({"none", "grid"}))
      .shows_default();
  flags.option("--cell-size", options.serve.cell_size, "serve: side of a cell [m]; 0: chosen")
      .check(number_from(0.0, 1e6))
      .shows_default();
  flags.option("--bats", options.serve.bats, "serve: bats of a scene scaled at its density; 0: its")
      .check(whole_number_from(0, 1'000'000));
  flags.option("--bat-count", options.serve.bat_count, "serve: bats on the same field; 0: its")
      .check(whole_number_from(0, 1'000'000));
  flags.option("--puck-count", options.serve.puck_count, "serve: pucks likewise; 0: its")
      .check(whole_number_from(0, 1'000'000));
  flags.option("--clients", options.serve.clients, "serve: bots to wait for")
      .check(whole_number_from(1, 10'000))
      .shows_default();
  flags.option("--rate", options.serve.rate_hz, "serve: ticks a second")
      .check(number_from(1.0, 1000.0))
      .shows_default();
  flags.option("--from-state", options.serve.from_state, "serve: saved game to begin from")
      .check(game::existing_file());
  flags.option("--count", options.bots.count, "bots: how many, of the first bats")
      .check(whole_number_from(1, 10'000))
      .shows_default();
  flags.option("--view", options.bots.view_fraction, "bots: area of a view / the field's")
      .check(number_from(1e-9, 1e6))
      .shows_default();
  flags.option("--view-area", options.bots.view_area, "bots: that area [m^2]; 0: by --view")
      .check(number_from(0.0, game::view_area_max))
      .shows_default();
  flags
      .option("--view-margin", options.bots.view_margin,
              "bots: by which the cells read reach beyond the view [m]")
      .check(number_from(0.0, game::view_margin_max))
      .shows_default();
  flags
      .flag("--extrapolate,!--no-extrapolate", options.bots.extrapolates,
            "bots: whether entities are shown moved on by their velocity")
      .shows_default();
  flags.option("--start", options.bots.start_s, "bots: simulated seconds of the saved game")
      .check(number_from(0.0, game::seconds_max))
      .shows_default();
  flags.option("--keys", options.keys, "key log that moves the bats; the bots write its keys")
      .check(game::existing_file());
  flags.option("--seed", options.seed, "of the scene and of what is watched").shows_default();
  flags.option("--duration", options.duration_s, "simulated seconds to play")
      .check(number_from(0.001, game::seconds_max))
      .shows_default();
  flags.option("--warm-up", options.warm_up_s, "simulated seconds before anything is measured")
      .check(number_from(0.0, game::seconds_max))
      .shows_default();
  flags.option("--patience", options.patience_s, "seconds to wait for the others")
      .check(number_from(0.001, game::seconds_max))
      .shows_default();
  flags.option("--evidence", options.trace, "file for evidence (docs/metrics.md)");
  flags.option("--report", options.report, "file for the measurements, as JSON");
}

ExitStatus ended(const loadgen::DdsEnding& ending) {
  if (game::is_interrupted) return ExitStatus::interrupted;
  if (ending.error.empty()) return ExitStatus::ok;
  game::complain(ending.error);
  return ending.is_alone ? ExitStatus::nobody_came : ExitStatus::connection_lost;
}

void require_something_to_measure(const Options& options) {
  if (options.warm_up_s >= options.duration_s)
    throw game::FlagError("--warm-up", "is not less than --duration: nothing would be measured");
}

ExitStatus serve(Options& options) {
  require_something_to_measure(options);
  loadgen::DdsServeOptions& serve = options.serve;
  serve.domain = options.domain, serve.keys = options.keys, serve.seed = options.seed;
  serve.report = options.report, serve.trace = options.trace;
  serve.duration_s = options.duration_s, serve.warm_up_s = options.warm_up_s;
  serve.patience_s = options.patience_s;
  return ended(loadgen::serve_by_dds(serve, game::now_s, [](std::uint32_t domain) {
    std::printf("listening on %u\n", domain);
    std::fflush(stdout);
  }));
}

ExitStatus play(Options& options) {
  require_something_to_measure(options);
  loadgen::DdsBotsOptions& bots = options.bots;
  if (!options.domain) throw game::FlagError("--domain", "is missing: that of the server");
  bots.domain = *options.domain, bots.plan = options.keys, bots.seed = options.seed;
  bots.report = options.report, bots.trace = options.trace;
  bots.duration_s = options.duration_s, bots.warm_up_s = options.warm_up_s;
  bots.patience_s = options.patience_s;
  return ended(loadgen::play_by_dds(bots, game::now_s));
}

int status_of(const std::exception& error) {
  if (dynamic_cast<const loadgen::DomainInUse*>(&error) != nullptr)
    return static_cast<int>(ExitStatus::address_in_use);
  if (dynamic_cast<const game::SceneError*>(&error) != nullptr)
    return static_cast<int>(ExitStatus::bad_input);
  return static_cast<int>(ExitStatus::failed);
}

}  // namespace

int main(int count, char** words) {
  game::speak_as("rink-dds");
  Options options;
  game::Flags flags(
      "A game over Cyclone DDS, another engine of distribution than Rink's RTI: a server writes "
      "all "
      "bodies at each tick, by the partition of their cell, and bots read those around them.",
      "rink dds");
  flags.version(game::version_line("rink-dds"));
  add_options(flags, options);
  return game::run_command(
      flags, count, words,
      {.run =
           [&] {
             return static_cast<int>(options.role == "serve" ? serve(options) : play(options));
           },
       .status_of = status_of});
}
