// A discrete-event loop: the clock moves to the next due event, an arrival, a key or a tick.
#include "loadgen/run/virtual_run.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "game/control/game_state.h"
#include "game/model/report_fields.h"
#include "game/model/scene_file.h"
#include "game/net/fom_file.h"
#include "game/net/server/serve_report.h"
#include "game/net/server/serving.h"
#include "game/players/player.h"
#include "game/players/player_kinds.h"
#include "game/replication/trajectory_codec.h"
#include "loadgen/experiment/parameter.h"
#include "loadgen/measure/judge_run.h"
#include "loadgen/measure/results.h"
#include "loadgen/measure/tables/discovery_table.h"
#include "loadgen/measure/truth/truth.h"
#include "loadgen/mobility/trace_play.h"
#include "loadgen/mobility/trace_scene.h"
#include "loadgen/run/bots/bot_crowd.h"
#include "loadgen/run/bots/bots_report.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/virtual_parts.h"
#include "rti/transport/modelled/virtual_network.h"
#include "rti/transport/socket_transport.h"
#include "rti/transport/staged/ledger_stage.h"

namespace rink::loadgen {
namespace {

using Json = nlohmann::ordered_json;

/// The game to play. `state_file` is read only if the game does not begin with the scene.
struct PlannedGame {
  const game::Scene& scene;
  const std::vector<game::InputEvent>& keys;
  const std::filesystem::path& state_file;
  game::SharedPlay* trace;  ///< what moves the bats; null: the keys
};

class VirtualRun {
 public:
  VirtualRun(const RunnerSettings& settings, const Experiment& experiment, const Cell& cell,
             const rti::Fom& fom, const PlannedGame& game);

  void run();
  Json server_report() const;
  Json bots_report() const;
  /// The traces of server and bots; only if the run is compared with truth.
  game::ServerTrace server_trace() const;
  game::BotsTrace bots_trace() const { return crowd_.trace().value(); }
  /// The traffic of all connections from first to last; call it after `end`.
  void end(Json& server_report);

 private:
  rti::FederationSettings federation_settings(const PlannedGame& game) const;
  game::ServerSettings server_settings(const PlannedGame& game) const;
  static BotCrowdSettings crowd_settings(const Experiment& experiment, const Cell& cell);

  double now_s() const { return network_.now_s(); }
  double simulated_now() const {
    return experiment_.start_s +
           (start_ns_ == 0 ? 0.0 : 1e-9 * static_cast<double>(network_.now_ns() - start_ns_));
  }
  std::int64_t next_instant_ns() const;
  void advance_until(std::int64_t until_ns);
  template <class Condition>
  void await(const std::string& what, Condition is_met);
  void show_trace();
  void start();
  void play();
  game::ServingCounts counts() const;

  const RunnerSettings& settings_;
  const Experiment& experiment_;
  const Cell& cell_;
  const bool is_traced_;
  std::string state_file_;           ///< empty: the game begins with the scene
  std::vector<std::uint8_t> state_;  ///< its content
  rti::NetworkModel model_;
  rti::VirtualNetwork network_;
  rti::VirtualEndpoint server_end_{network_}, bots_end_{network_};
  struct {
    rti::StagedTransport transport;
    rti::LedgerStage* ledger = nullptr;  ///< null unless the report says where the bytes go
  } clients_{rti::StagedTransport(server_end_)};
  game::Serving serving_;
  game::Server& server_;
  BotCrowd crowd_;
  std::int64_t start_ns_ = 0, measured_from_ns_ = 0, measured_until_ns_ = 0;
  std::uint64_t ticks_ = 0;
  game::ServingCounts begin_, end_;
};

namespace {

/// The saved game in `file`; refused here, where its name is known, if it is none of the scene.
std::vector<std::uint8_t> state_in(const std::string& file, const game::Scene& scene) {
  std::vector<std::uint8_t> state = game::read_game_state(file);
  game::game_in_state(state, scene, file);
  return state;
}

}  // namespace

rti::FederationSettings VirtualRun::federation_settings(const PlannedGame& game) const {
  rti::FederationSettings settings =
      game::federation_settings(game.scene, cell_.scheme, cell_.parameters.cell_size);
  settings.update_rate =
      game::update_rate_of(cell_.parameters.output_rate_hz, cell_.parameters.tick_rate_hz);
  return settings;
}

game::ServerSettings VirtualRun::server_settings(const PlannedGame& game) const {
  game::ServerSettings settings{.policy = cell_.policy,
                                .threshold = cell_.parameters.threshold,
                                .sweep_ticks = cell_.parameters.sweep_ticks,
                                .tick_s = 1.0 / cell_.parameters.tick_rate_hz,
                                .replay = {},
                                .events_per_s = settings_.virtual_events_per_s};
  if (experiment_.keys == KeySource::replay && !game.trace) settings.replay = game.keys;
  settings.shared = game.trace;
  settings.always_relevant = game::relevant_kinds_of(game.scene, experiment_.always);
  settings.state = state_;
  return settings;
}

BotCrowdSettings VirtualRun::crowd_settings(const Experiment& experiment, const Cell& cell) {
  BotCrowdSettings settings;
  settings.count = cell.clients;
  settings.view_fraction = cell.parameters.view_fraction;
  settings.view_area = experiment.view_area;
  settings.view_margin = cell.parameters.view_margin;
  settings.declares_regions = has_regions(cell);
  settings.extrapolates = cell.parameters.extrapolates;
  settings.start_s = experiment.start_s;
  settings.warm_up_s = experiment.measured_from_s();
  settings.duration_s = experiment.end_s();
  if (experiment.keys == KeySource::live && experiment.players != "random" &&
      game::is_player_kind(experiment.players))
    settings.players = {.kind = experiment.players,
                        .rules = game::rules_of(game::load_scene(experiment.scene), 0),
                        .seed = cell.seed};
  return settings;
}

VirtualRun::VirtualRun(const RunnerSettings& settings, const Experiment& experiment,
                       const Cell& cell, const rti::Fom& fom, const PlannedGame& game)
    : settings_(settings),
      experiment_(experiment),
      cell_(cell),
      is_traced_(game.trace != nullptr),
      state_file_(experiment.start_s > 0.0 ? game.state_file.string() : ""),
      state_(state_file_.empty() ? std::vector<std::uint8_t>() : state_in(state_file_, game.scene)),
      model_(network_conditions(experiment, cell)),
      network_(model_),
      serving_(fom, game.scene, server_settings(game), federation_settings(game),
               {[this] { return now_s(); }, [this] { return simulated_now(); }}),
      server_(serving_.server()),
      crowd_(fom, bots_end_, crowd_settings(experiment, cell), game.keys,
             [this] { return now_s(); }) {
  if (settings.wants_truth) {
    serving_.collect_trace({.seed = cell.seed,
                            .clients = cell.clients,
                            .from_s = experiment.measured_from_s(),
                            .until_s = experiment.end_s()},
                           cell.parameters.tick_rate_hz);
    crowd_.collect_trace(cell.seed);
  }
  if (experiment.network_carries_datagrams) network_.carry_datagrams();
  server_end_.listen(server_name);
  if (experiment.counts_fields) clients_.ledger = &game::add_ledger(clients_.transport, fom);
  serving_.host().add(clients_.transport);
}

std::int64_t VirtualRun::next_instant_ns() const {
  const std::optional<std::int64_t> arrival_ns = network_.next_arrival_ns();
  const std::optional<double> due_s = crowd_.next_due_s();
  std::int64_t next_ns = arrival_ns.value_or(INT64_MAX);
  if (due_s) next_ns = std::min(next_ns, std::max(network_.now_ns(), not_before(*due_s)));
  return next_ns;
}

/// Handles all events up to and at `until_ns`.
void VirtualRun::advance_until(std::int64_t until_ns) {
  for (std::int64_t next_ns = next_instant_ns(); next_ns <= until_ns; next_ns = next_instant_ns()) {
    network_.advance_to(next_ns);
    if (server_end_.has_arrivals()) serving_.exchange(0.0);
    crowd_.run_once();
  }
  network_.advance_to(until_ns);
}

/// Publishes every tick's time, as the server does before the start, until `is_met`. Every step
/// takes a delay or a tick, and there are few.
template <class Condition>
void VirtualRun::await(const std::string& what, Condition is_met) {
  constexpr std::int64_t steps_max = 64;
  const std::int64_t step_ns = nanoseconds(1.0 / cell_.parameters.tick_rate_hz);
  const std::int64_t limit_ns =
      network_.now_ns() + steps_max * (step_ns + settling_ns(experiment_) +
                                       (experiment_.network_is_modelled ? second_ns : 0));
  game::TickCosts uncounted;
  while (!is_met()) {
    settings_.heed_interrupt();
    if (!server_.error().empty()) throw Failure{"the server: " + server_.error()};
    if (crowd_.bots().lost_count() > 0) throw Failure{"the bots: " + crowd_.bots().first_error()};
    if (network_.now_ns() > limit_ns) throw Failure{"waited in vain for " + what};
    advance_until(network_.now_ns() + step_ns);
    serving_.exchange(0.0);
    if (server_.is_joined()) serving_.send(experiment_.start_s, 0.0, uncounted);
    serving_.host().advance_clock(now_s());
    crowd_.run_once();
  }
}

/// Before anybody looks: all agents have an object, and those who are away are hidden.
void VirtualRun::show_trace() {
  await("the server", [this] {
    if (!server_.is_joined()) return false;
    const auto is_published = [this](const game::Entity& entity) {
      return static_cast<bool>(server_.publisher().object(entity.id));
    };
    return std::ranges::all_of(server_.game().entities(), is_published);
  });
  server_.simulate(0.0);
}

void VirtualRun::start() {
  if (is_traced_) show_trace();
  crowd_.connect([this](std::uint32_t) { return bots_end_.connect(server_name); });
  await("the players",
        [this] { return server_.is_joined() && server_.seats().player_count() == cell_.clients; });
  server_.call_to_start();
  await("the start barrier", [this] { return server_.is_started(); });
  start_ns_ = (network_.now_ns() / second_ns + 1) *
              second_ns;  // a whole second: sums with it are rounded least
  for (rti::Partition cut : experiment_.network.partitions) {
    cut.from_ns += start_ns_;
    cut.until_ns += start_ns_;
    model_.add(cut);
  }
}

void VirtualRun::play() {
  const double rate_hz = cell_.parameters.tick_rate_hz,
               played_s = experiment_.warm_up_s + experiment_.duration_s;
  const auto last = static_cast<std::uint64_t>(std::floor(played_s * rate_hz + 1e-9));
  if (is_traced_) crowd_.start(1e-9 * static_cast<double>(start_ns_));
  for (std::uint64_t number = 0; number <= last; ++number) {
    settings_.heed_interrupt();
    const double simulated_s = static_cast<double>(number) / rate_hz;
    advance_until(start_ns_ + nanoseconds(simulated_s));
    if (ticks_ == 0 && simulated_s >= experiment_.warm_up_s) {
      begin_ = counts();
      measured_from_ns_ = network_.now_ns();
    }
    if (number ==
        last) {  // it closes the span and is not in it: n ticks, and the n periods that they begin
      end_ = counts();
      measured_until_ns_ = network_.now_ns();
    }
    serving_.tick(experiment_.start_s + simulated_s, now_s());
    if (const auto complaint = server_.budget().take_complaint())
      throw Failure{"the server: " + *complaint};
    crowd_.run_once();
    if (simulated_s >= experiment_.warm_up_s && number < last) ++ticks_;
  }
  advance_until(start_ns_ + nanoseconds(played_s) + 4 * settling_ns(experiment_) +
                1);  // the last answers
}

game::ServingCounts VirtualRun::counts() const {
  game::ServingCounts counts = counts_of(serving_, rti::with_datagrams(server_end_.totals()));
  if (clients_.ledger != nullptr) counts.fields = clients_.ledger->rows();
  return counts;
}

void VirtualRun::run() {
  start();
  play();
}

Json VirtualRun::server_report() const {
  const std::string why = !server_.error().empty() ? server_.error()
                          : ticks_ == 0            ? "no tick was measured"
                                                   : "";
  Json report{{game::report::mode, cell_.mode},
              {game::report::scheme, cell_.scheme},
              {game::report::policy, cell_.policy},
              {game::report::threshold, cell_.parameters.threshold},
              {game::report::clients, cell_.clients},
              {game::report::seed, cell_.seed},
              {game::report::tick_rate_hz, cell_.parameters.tick_rate_hz},
              {game::report::output_rate_hz, cell_.parameters.output_rate_hz},
              {game::report::ticks, ticks_},
              {game::report::ticks_on_time_fraction, nullptr},
              {game::report::physics_us_per_tick, nullptr},
              {game::report::filter_us_per_tick, nullptr},
              {game::report::send_us_per_tick, nullptr},
              {game::report::server_rss_bytes, nullptr},
              {game::report::measured_s,
               1e-9 * static_cast<double>(measured_until_ns_ - measured_from_ns_)},
              {game::report::valid, why.empty()},
              {game::report::why_invalid, why}};
  report.update(counted_report(serving_, begin_, end_));
  if (experiment_.network_is_modelled) {
    const rti::NetworkCounters& counted = model_.counters();
    report["network"] = {{"segments", counted.segments}, {"datagrams", counted.datagrams},
                         {"lost", counted.lost},         {"cut", counted.cut},
                         {"dropped", counted.dropped},   {"retransmitted", counted.retransmitted},
                         {"held", counted.held},         {"duplicated", counted.duplicated}};
  }
  return report;
}

Json VirtualRun::bots_report() const {
  const Measurements& measured = crowd_.meter().measurements();
  std::string why;
  if (crowd_.bots().lost_count() > 0)
    why = std::to_string(crowd_.bots().lost_count()) + " of " + std::to_string(cell_.clients) +
          " bots were lost: " + crowd_.bots().first_error();
  else if (!crowd_.is_over()) why = "the game did not end";
  else if (measured.keys_sent < measured.keys_due)
    why = std::to_string(measured.keys_due - measured.keys_sent) + " planned keys were not sent";
  Json report = loadgen::bots_report(crowd_, why);
  report[game::report::kernel_bytes_received.key] = report[game::report::kernel_bytes_sent.key] =
      nullptr;
  return report;
}

game::ServerTrace VirtualRun::server_trace() const {
  game::ServerTrace server = serving_.trace().value();
  server.choice = choice_of(experiment_, cell_);
  server.state_file = state_file_;
  server.state = state_;
  server.scheme = cell_.scheme;
  server.policy = cell_.policy;
  return server;
}

void VirtualRun::end(Json& server_report) {
  crowd_.resign();
  advance_until(network_.now_ns() + 2 * settling_ns(experiment_));
  game::add_totals(server_report, rti::with_datagrams(server_end_.totals()));
}

void run(const RunnerSettings& settings, const Experiment& experiment, const Cell& cell,
         const std::filesystem::path& key_log, RunRecord& record) {
  const rti::Fom fom = game::load_rink_fom(game::fom_file());
  PlayedScene played = played_scene(choice_of(experiment, cell));
  std::optional<TracePlay> trace;
  if (played.trace) trace.emplace(*std::move(played.trace));
  VirtualRun run(settings, experiment, cell, fom,
                 {.scene = played.scene,
                  .keys = keys_in(key_log, played.scene),
                  .state_file = state_file_of(key_log),
                  .trace = trace ? &*trace : nullptr});
  run.run();
  Json server = run.server_report();
  const Json bots = run.bots_report();
  const game::ServerTrace server_trace =
      settings.wants_truth ? run.server_trace() : game::ServerTrace();
  const game::BotsTrace bots_trace = settings.wants_truth ? run.bots_trace() : game::BotsTrace();
  run.end(server);
  write_json(settings.directory / (name_of(cell) + ".server.json"), server);
  write_json(settings.directory / (name_of(cell) + ".bots.json"), bots);
  judge(record, server, bots);
  if (!settings.wants_truth) return;
  if (experiment.is_of_curves) add_truth(record, experiment, server_trace, rounded(bots_trace));
  if (!settings.keeps_traces) return;
  const std::string server_file = settings.directory / (name_of(cell) + ".server.jsonl"),
                    bots_file = settings.directory / (name_of(cell) + ".bots.jsonl");
  game::write_trace(server_file, server_trace);
  write_trace(bots_file, bots_trace);
  if (!experiment.is_of_curves)
    add_truth(record, experiment, server_file, bots_file, discovery_file(settings.directory, cell));
}

}  // namespace

std::optional<RunRecord> run_virtual_cell(const RunnerSettings& settings,
                                          const Experiment& experiment, const Cell& cell,
                                          const std::filesystem::path& key_log) {
  return recorded(experiment, cell,
                  [&](RunRecord& record) { run(settings, experiment, cell, key_log, record); });
}

}  // namespace rink::loadgen
