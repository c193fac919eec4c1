// rink bots: a crowd of headless clients in one process, pressing keys by a plan fixed before the
// run or by what they see of the game.

#include <ctime>
#include <nlohmann/json.hpp>
#include <string>

#include "game/apps/command.h"
#include "game/control/key_log_file.h"
#include "game/model/listed.h"
#include "game/model/report_fields.h"
#include "game/model/scene_file.h"
#include "game/net/address.h"
#include "game/net/exit_status.h"
#include "game/net/fom_file.h"
#include "game/net/gate.h"
#include "game/net/interrupt.h"
#include "game/net/limits.h"
#include "game/net/record_file.h"
#include "game/players/player.h"
#include "game/players/player_kinds.h"
#include "game/players/random_plan.h"
#include "game/process/process.h"
#include "game/replication/trajectory_codec.h"
#include "game/version/version.h"
#include "loadgen/run/bots/bot_crowd.h"
#include "loadgen/run/bots/bots_report.h"
#include "rti/federation_file.h"
#include "rti/transport/socket_transport.h"

namespace {

using namespace rink;
using game::existing_file, game::now_s, game::one_of;
using Json = nlohmann::ordered_json;

struct Options {
  std::string connect = "127.0.0.1:4711", federation = "rink", plan, report, trace,
              players = "random", scene = "crowd", transport = "tcp";
  std::string key_file, federation_file;
  bool declares_regions = true, extrapolates = true;
  std::uint32_t count = 1, first = 0, bundles = 1;
  std::uint64_t seed = 1;
  double view_fraction = 0.05, view_area = 0.0, view_margin = 0.3, start_s = 0.0, duration_s = 10.0,
         warm_up_s = 0.0, patience_s = 30.0;
};

/// The mean cost of recording one latency on this machine over 100,000 [ns].
double histogram_ns_per_record() {
  constexpr int count = 100'000;
  loadgen::Histogram histogram;
  const double begin_s = now_s();
  for (int i = 0; i < count; ++i) histogram.record(1e-6 * (i % 10'000 + 1));
  return histogram.count() == count ? 1e9 * (now_s() - begin_s) / count : 0.0;
}

/// The load of this process on the processors that it may use, within a span.
class ProcessorLoad {
 public:
  void look(bool is_within) {
    if (is_within && !begin_) begin_ = now();
    if (is_within) end_ = now();
  }
  std::optional<double> share() const {
    const double wall_s = begin_ ? end_.wall_s - begin_->wall_s : 0.0;
    if (!(wall_s > 0.0)) return std::nullopt;
    return (end_.cpu_s - begin_->cpu_s) / (wall_s * static_cast<double>(std::max<std::size_t>(
                                                        1, game::allowed_processors().size())));
  }

 private:
  struct Reading {
    double wall_s = 0.0, cpu_s = 0.0;
  };
  static Reading now() { return {now_s(), static_cast<double>(std::clock()) / CLOCKS_PER_SEC}; }
  std::optional<Reading> begin_;
  Reading end_;
};

void add_options(game::Flags& flags, Options& options) {
  flags.description(
      "Any number of headless clients in one process, each with its own connection, pressing keys "
      "by a plan fixed before the run or as they see fit.");
  flags.footer(std::string("Example: rink bots --connect 127.0.0.1:4711 --count 100 --seed 7 "
                           "--duration 30 --report bots.json\n\n") +
               game::exit_status_help);
  flags.name("rink bots");
  flags.option("--connect", options.connect, "server, as ADDRESS:PORT").shows_default();
  flags
      .option("--transport", options.transport, "tcp, udp, shm or bundle: the same as the server's")
      .check(one_of({rti::socket_transport_names.begin(), rti::socket_transport_names.end()}))
      .shows_default();
  flags
      .option("--bundle", options.bundles,
              "sockets that the bots share by turns, with --transport bundle, which it implies")
      .check(game::number_from(1, game::bats_max))
      .shows_default();
  flags.option("--key-file", options.key_file, "the server's key file, if it asks for one")
      .check(existing_file());
  flags.option("--federation", options.federation, "name of the federation execution to join")
      .shows_default();
  flags.option("--federation-file", options.federation_file,
               "the server's federation file instead of --connect and --federation; if it lists "
               "nodes, bots bear their names from the --first on");
  flags.option("--count", options.count, "bots")
      .check(game::number_from(1, game::bats_max))
      .shows_default();
  flags
      .option("--first", options.first,
              "the first bot's bat; the others take the following ones, or any free one where "
              "that is taken or absent")
      .check(game::number_from(0, game::bats_max))
      .shows_default();
  flags.option("--plan", options.plan, "key log to play; without it the plan is made from the seed")
      .check(existing_file());
  flags
      .option("--players", options.players,
              "kind of players: random, by the plan; or by what they see of the game, " +
                  game::listed(game::player_kinds()))
      .check(one_of([] {
        auto kinds = game::player_kinds();
        kinds.emplace_back("random");
        return kinds;
      }()))
      .shows_default();
  flags
      .option("--scene", options.scene,
              "the server's scene, of which players know the rules: goals, drag, acceleration")
      .shows_default();
  flags
      .option("--seed", options.seed,
              "seed of the plan, of players, and of the choice of watched bots")
      .shows_default();
  flags
      .option("--view", options.view_fraction,
              "area of a bot's interest as a fraction of the field's; 1 or more: everything")
      .check(game::number_from(1e-9, 1e6))
      .shows_default();
  flags
      .option("--view-area", options.view_area, "area of a bot's view [m^2] instead; 0: use --view")
      .check(game::number_from(0.0, game::view_area_max))
      .shows_default();
  flags
      .option("--view-margin", options.view_margin,
              "how far the declared region reaches beyond the view [m]; it is declared anew "
              "when the bat has moved by half of that")
      .check(game::number_from(0.0, game::view_margin_max))
      .shows_default();
  flags
      .flag("--regions,!--no-regions", options.declares_regions,
            "whether bots declare their views as regions, or subscribe to everything, which "
            "under the scheme none is equal and cheaper")
      .shows_default();
  flags
      .flag("--extrapolate,!--no-extrapolate", options.extrapolates,
            "whether entities updated by positions alone (periodic) are extrapolated from the "
            "last position by the velocity between the last two, or shown there")
      .shows_default();
  flags
      .option("--start", options.start_s,
              "simulated seconds of the saved game from which the server begins: keys up to "
              "then have been pressed, and --duration and --warm-up count from there")
      .check(game::number_from(0.0, game::seconds_max))
      .shows_default();
  flags.option("--duration", options.duration_s, "simulated seconds to play")
      .check(game::number_from(0.001, game::seconds_max))
      .shows_default();
  flags.option("--warm-up", options.warm_up_s, "simulated seconds before anything is measured")
      .check(game::number_from(0.0, game::seconds_max))
      .shows_default();
  flags.option("--patience", options.patience_s, "seconds to wait for the start")
      .check(game::number_from(0.001, game::seconds_max))
      .shows_default();
  flags.option("--evidence", options.trace,
               "file for the trace of some of the bots (docs/metrics.md), as JSON lines");
  flags.option("--report", options.report, "file for the measurements, as JSON");
}

std::vector<game::InputEvent> plan_of(const Options& options) {
  if (options.players != "random") return {};
  if (!options.plan.empty()) {
    const game::KeyLog plan = game::read_key_log(options.plan);
    game::require_keys_alone(plan, options.plan, "a crowd of bots");
    return plan.events;
  }
  return game::random_plan(options.seed, options.first + options.count,
                           options.start_s + options.duration_s);
}

loadgen::LivePlayers players_of(const Options& options) {
  if (options.players == "random") return {};
  return {.kind = options.players,
          .rules = game::rules_of(game::load_scene(options.scene), 0),
          .seed = options.seed};
}

std::string why_invalid(const Options& options, const loadgen::BotCrowd& crowd) {
  const loadgen::Measurements& measured = crowd.meter().measurements();
  if (game::is_interrupted) return "interrupted";
  if (crowd.bots().lost_count() > 0)
    return std::to_string(crowd.bots().lost_count()) + " of " + std::to_string(options.count) +
           " bots were lost: " + crowd.bots().first_error();
  if (!crowd.has_started()) return "the game did not start";
  if (measured.keys_sent < measured.keys_due)
    return std::to_string(measured.keys_due - measured.keys_sent) + " planned keys were not sent";
  return "";
}

game::ExitStatus status(const loadgen::BotCrowd& crowd, double patience_s) {
  if (game::is_interrupted) return game::ExitStatus::interrupted;
  const auto& bots = crowd.bots();
  if (bots.lost_count() > 0)
    game::complain(bots.lost_count(), " of ", bots.size(), " bots were lost: ", bots.first_error());
  else if (!crowd.has_started())
    game::complain("the game did not start within --patience, ", patience_s, " s");
  else return game::ExitStatus::ok;
  return bots.first_status();
}

/// The federation to join and its address, by the flags or the file.
rti::FederationFile federation_of(const Options& options) {
  if (options.federation_file.empty()) {
    const auto [address, port] = game::address_and_port("--connect", options.connect);
    return {.federation = options.federation,
            .fom = {game::fom_file()},
            .nodes = {{.name = "rti", .address = address, .port = port}}};
  }
  rti::FederationFile file = rti::load_federation_file(options.federation_file);
  if (file.is_listed && options.first + options.count > file.members().size())
    throw std::runtime_error("--count: " + std::to_string(options.count) + " bots from the " +
                             std::to_string(options.first) + "th node on, but '" +
                             options.federation_file + "' lists " +
                             std::to_string(file.members().size()));
  return file;
}

void bundle_where_asked(const game::Flags& flags, Options& options) {
  if (!flags.is_given("--bundle")) return;
  if (flags.is_given("--transport") && options.transport != "bundle")
    throw std::runtime_error("--bundle: bots share sockets with --transport bundle alone, not " +
                             options.transport);
  options.transport = "bundle";
}

/// Of a bundle, the number that bots share; else one for each, and a second for its datagrams.
std::uint32_t sockets_of(const Options& options) {
  if (options.transport == "bundle") return std::min(options.count, options.bundles);
  return (options.transport == "udp" ? 2u : 1u) * options.count;
}

loadgen::Crowd::Totals totals_of(const Options& options, const rti::SocketTransport& transport) {
  if (options.transport != "bundle") return nullptr;
  return [&transport] { return transport.totals(); };
}

game::ExitStatus play(const Options& options) {
  const rti::FederationFile file = federation_of(options);
  const auto& node = file.nodes.front();
  game::require_writable("--report", options.report);
  game::require_writable("--evidence", options.trace);
  const rti::Fom fom = game::load_rink_fom(file.fom);
  const std::vector<game::InputEvent> plan = plan_of(options);
  rti::ensure_file_limit(sockets_of(options) + 64u);
  rti::SocketTransport transport(options.transport, options.bundles);
  const loadgen::BotCrowdSettings settings{.federation = file.federation,
                                           .first = options.first,
                                           .count = options.count,
                                           .names = file.members(),
                                           .view_fraction = options.view_fraction,
                                           .view_area = options.view_area,
                                           .view_margin = options.view_margin,
                                           .declares_regions = options.declares_regions,
                                           .extrapolates = options.extrapolates,
                                           .start_s = options.start_s,
                                           .warm_up_s = options.start_s + options.warm_up_s,
                                           .duration_s = options.start_s + options.duration_s,
                                           .players = players_of(options),
                                           .totals = totals_of(options, transport)};
  rti::StagedTransport gate(transport.get());
  game::add_gate(
      gate,
      {.key_file = options.key_file, .role = rti::Role::federate, .federation = file.federation},
      now_s);
  loadgen::BotCrowd crowd(fom, gate, settings, plan, now_s);
  if (!options.trace.empty()) crowd.collect_trace(options.seed);
  const double histogram_ns = histogram_ns_per_record();
  crowd.connect([&](std::uint32_t) { return transport.connect(node.address, node.port); });
  const double give_up_s = now_s() + options.patience_s;
  ProcessorLoad load;
  while (!game::is_interrupted && !crowd.is_over() &&
         (crowd.has_started() || now_s() < give_up_s)) {
    crowd.run_once();
    load.look(crowd.meter().is_measuring());
  }
  for (const double until_s = now_s() + 0.1; !game::is_interrupted && now_s() < until_s;)
    crowd.run_once();  // the kernel's count lags by an acknowledgement
  Json written = loadgen::bots_report(crowd, why_invalid(options, crowd));
  written[game::report::cpu_share.key] = load.share() ? Json(*load.share()) : Json(nullptr);
  written[game::report::histogram_ns_per_record.key] = histogram_ns;
  const game::ExitStatus result = status(crowd, options.patience_s);
  crowd.resign();
  if (const auto trace = crowd.trace()) game::write_trace(options.trace, *trace);
  if (!options.report.empty()) {
    game::write_file(options.report, written.dump(2));
  } else if (crowd.has_started()) {
    std::printf("%s\n", written.dump(2).c_str());
  }
  return result;
}

int status_of(const std::exception& error) {
  return static_cast<int>(
      game::exit_status(error, {.bad_address = game::ExitStatus::no_server,
                                .too_many_files = game::ExitStatus::too_few_files,
                                .otherwise = game::ExitStatus::no_server}));
}

}  // namespace

int main(int count, char** words) {
  game::speak_as("rink-bots");
  game::Flags flags;
  flags.version(game::version_line("rink-bots"));
  Options options;
  add_options(flags, options);
  return game::run_command(flags, count, words,
                           {.run =
                                [&] {
                                  bundle_where_asked(flags, options);
                                  return static_cast<int>(play(options));
                                },
                            .status_of = status_of});
}
