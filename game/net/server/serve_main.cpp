// rink serve: the server federate and, beside it, the RTI with its filter, on a real-time or
// synchronous tick.
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "game/control/game.h"
#include "game/control/key_log.h"
#include "game/control/match_records.h"
#include "game/model/scene_file.h"
#include "game/net/address.h"
#include "game/net/evidence.h"
#include "game/net/exit_status.h"
#include "game/net/flags.h"
#include "game/net/fom_file.h"
#include "game/net/gate.h"
#include "game/net/interrupt.h"
#include "game/net/scene_choice.h"
#include "game/net/server/serve_game.h"
#include "game/net/server/serve_options.h"
#include "game/net/server/serve_report.h"
#include "game/net/server/serve_requirements.h"
#include "game/net/server/serve_status.h"
#include "game/net/server/serving.h"
#include "game/net/speak_as.h"
#include "game/replication/names.h"
#include "game/replication/trajectory_codec.h"
#include "game/version/version.h"
#include "rti/federation_execution.h"
#include "rti/federation_file.h"
#include "rti/second_core.h"
#include "rti/transport/socket_transport.h"
#include "rti/transport/staggered_transport.h"
#include "rti/wire/message.h"

namespace {

using namespace rink;
using Json = nlohmann::ordered_json;

/// The due instant in stamps from before the start, when nothing is due yet.
constexpr double not_started_s = 0.0;

/// The clock of every process of this machine that the stamps refer to [s].
double now_s() {
  return 1e-9 * static_cast<double>(std::chrono::duration_cast<std::chrono::nanoseconds>(
                                        std::chrono::steady_clock::now().time_since_epoch())
                                        .count());
}

/// What the run cost, summed over the measured ticks.
struct Costs {
  std::uint64_t ticks = 0, ticks_on_time = 0;
  double physics_s = 0.0, filter_s = 0.0, send_s = 0.0, send_max_s = 0.0;
  double from_s = 0.0,
         span_s = 0.0;  ///< the measured span: when it began on the clock, and its length
  bool has_ended = false;
  game::ServingCounts begin, end;
};

/// The server process: the clients' transport, the wall clock, and the loop that ticks.
class ServerProcess {
 public:
  ServerProcess(const game::ServeOptions& options, const rti::Fom& fom,
                const game::ServedGame& played, const std::string& federation)
      : options_(options),
        begin_s_(played.begun ? played.begun->now() : 0.0),
        sockets_(options.transport),
        serving_(fom, played.scene,
                 {.federation = federation,
                  .policy = options.policy,
                  .threshold = options.threshold,
                  .sweep_ticks = options.sweep_ticks,
                  .tick_s = 1.0 / options.rate_hz,
                  .is_synchronous = options.pace == "synchronous",
                  .is_time_managed = options.is_time_managed,
                  .replay = played.replay,
                  .hosting = hosting_of(options),
                  .key_limit_per_s = options.key_limit_per_s,
                  .always_relevant = game::relevant_kinds_of(played.scene, options.always),
                  .begun = played.begun ? &*played.begun : nullptr},
                 game::federation_of(options, played.scene, federation,
                                     options.has_second_core ? &second_core_.emplace() : nullptr),
                 now_s, [this] { return simulated_now(); }),
        staggered_(sockets_.get(), options.spread / options.rate_hz, now_s),
        gate_(staggered_,
              {.key_file = options.key_file,
               .federation = federation,
               .rate_limit = {options.rate_limit_bytes_per_s, options.frame_limit_per_s}},
              now_s),
        server_(serving_.server()),
        records_(options.record) {
    serving_.host().add(gate_.transport());
    if (!options.evidence.empty())
      serving_.collect_evidence({.seed = options.seed,
                                 .clients = options.clients,
                                 .from_s = begin_s_ + options.warm_up_s,
                                 .until_s = begin_s_ + options.duration_s},
                                options.rate_hz);
  }

  /// Says at once if matches cannot be recorded; they can be played all the same.
  void try_records();
  std::uint16_t listen() { return sockets_.listen(options_.address, options_.port); }

  /// Waits for the players and the start barrier; false if they did not all come in time.
  bool start();
  void run();
  /// Lets the clients take their leave.
  void end();

  const game::Server& server() const { return server_; }
  /// Whom the federation file lists and who has not come, as a clause of a complaint; empty if
  /// none.
  std::string missing() const;
  Json report() const;
  /// What the run was and what its filter decided, if `--evidence` asked for it.
  std::optional<game::ServerEvidence> evidence(const game::ServedGame& played) const;
  /// What the connections carried from first to last.
  rti::TransportCounters totals() const { return sockets_.totals(); }

 private:
  static std::optional<game::Hosting> hosting_of(const game::ServeOptions& options);
  double simulated_now() const {
    return start_s_ == 0.0
               ? begin_s_
               : (options_.pace == "synchronous" ? server_.game().now()
                                                 : begin_s_ + std::max(0.0, now_s() - start_s_));
  }
  void wait(double seconds);
  void exchange_until(double until_s);
  void await_turns();
  void tick(std::uint64_t number, bool is_counted);
  void end_span();
  void keep_records();
  void report_flood();

  game::ServeOptions options_;
  double begin_s_;  ///< simulated instant at which the game begins
  rti::SocketTransport sockets_;
  std::optional<rti::SecondCore> second_core_;
  game::Serving serving_;
  rti::StaggeredTransport staggered_;
  game::Gate gate_;
  game::Server& server_;
  game::MatchRecords records_;
  double start_s_ = 0.0;
  bool is_flood_reported_ = false;
  Costs costs_;
};

std::optional<game::Hosting> ServerProcess::hosting_of(const game::ServeOptions& options) {
  if (options.hosted.empty()) return std::nullopt;
  return game::Hosting{
      .times = {.countdown_s = options.countdown_s, .patience_s = options.absence_s},
      .scene_text = game::scene_text(options.scene)};
}

void ServerProcess::exchange_until(double until_s) {
  do serving_.exchange(std::min(0.25, until_s - now_s()));
  while (now_s() < until_s && !game::is_interrupted);
}

/// However long the players think, silence is noticed and the RTI is heard to live.
void ServerProcess::await_turns() {
  while (!game::is_interrupted && server_.trouble().empty() && !server_.may_step()) {
    serving_.exchange(0.25);
    serving_.host().advance_clock(now_s());
  }
}

/// The clock of the RTI goes on whatever the players do: frozen while they made their way to the
/// barrier, it let the server's own federate hear nothing for so long that it took the RTI for
/// dead, and its next update was refused with "join first". With datagrams, which nothing holds
/// back, crowds took that long.
void ServerProcess::wait(double seconds) {
  game::TickCosts uncounted;
  serving_.exchange(seconds);
  if (server_.is_joined() && server_.trouble().empty())
    serving_.send(begin_s_, not_started_s, uncounted);
  serving_.host().advance_clock(now_s());
}

bool ServerProcess::start() {
  const double give_up_s = now_s() + options_.patience_s;
  const auto may_wait = [&] {
    return !game::is_interrupted && server_.trouble().empty() && now_s() <= give_up_s;
  };
  const auto are_all_there = [&] {
    return server_.is_joined() && server_.player_count() >= options_.clients;
  };
  while (!are_all_there() && may_wait()) wait(0.02);
  if (!are_all_there()) return false;
  server_.call_to_start();
  while (!server_.is_started() && may_wait()) wait(0.005);
  return server_.is_started();
}

void ServerProcess::tick(std::uint64_t number, bool is_counted) {
  const double period_s = 1.0 / options_.rate_hz,
               elapsed_s = static_cast<double>(number) * period_s;
  const double simulated_s =
      options_.hosted.empty() ? begin_s_ + elapsed_s : server_.follow_match(elapsed_s);
  const double due_s = options_.pace == "synchronous" ? now_s() : start_s_ + elapsed_s;
  const game::TickCosts tick = serving_.tick(simulated_s, due_s);
  keep_records();
  report_flood();
  if (!is_counted) return;
  costs_.physics_s += tick.physics_s;
  costs_.filter_s += tick.filter_s;
  costs_.send_s += tick.send_s;
  costs_.send_max_s = std::max(costs_.send_max_s, tick.send_s);
  ++costs_.ticks;
  if (now_s() <= due_s + period_s) ++costs_.ticks_on_time;
}

void ServerProcess::run() {
  constexpr double lead_s = 0.1;  // so that the first tick is not late
  start_s_ = now_s() + lead_s;
  const std::uint64_t last =
      options_.duration_s > 0.0
          ? static_cast<std::uint64_t>(std::floor(options_.duration_s * options_.rate_hz + 1e-9))
          : ~0ull;
  bool is_measuring = false;
  for (std::uint64_t number = 0;
       number <= last && !game::is_interrupted && server_.trouble().empty(); ++number) {
    const double simulated_s = static_cast<double>(number) / options_.rate_hz;
    if (options_.pace == "synchronous") await_turns();
    else exchange_until(start_s_ + simulated_s);
    if (game::is_interrupted || !server_.trouble().empty()) break;
    if (!is_measuring && simulated_s >= options_.warm_up_s) {
      is_measuring = true;
      costs_.from_s = now_s();
      staggered_.forget_bursts();
      costs_.begin = counts_of(serving_, sockets_.totals());
    }
    // The last tick closes the span and is not in it: n ticks, and the n periods that they begin.
    if (is_measuring && number == last) end_span();
    tick(number, is_measuring && number < last);
  }
  if (is_measuring && !costs_.has_ended) end_span();
}

void ServerProcess::end_span() {
  costs_.has_ended = true;
  costs_.span_s = now_s() - costs_.from_s;
  costs_.end = counts_of(serving_, sockets_.totals());
}

std::string ServerProcess::missing() const {
  std::vector<std::string> absent = options_.members;
  for (const rti::FederateReport& each : serving_.execution().report().federates)
    std::erase(absent, each.name);
  std::string names;
  for (const std::string& each : absent) names += (names.empty() ? "; missing: " : ", ") + each;
  return names;
}

void ServerProcess::end() {
  const double give_up_s = now_s() + (game::is_interrupted ? 0.0 : 2.0);
  while (server_.player_count() > 0 && now_s() < give_up_s) serving_.exchange(0.01);
  if (options_.hosted.empty()) return;
  server_.finish_record();
  keep_records();
}

void ServerProcess::try_records() {
  if (options_.hosted.empty()) return;
  if (const auto trouble = records_.test())
    spdlog::error("{}; matches are played without a record", *trouble);
}

/// Once: who sends too much could fill the terminal as well.
void ServerProcess::report_flood() {
  const game::ServerCounters& counters = server_.counters();
  if (counters.keys_over_limit == 0 || std::exchange(is_flood_reported_, true)) return;
  spdlog::warn(
      "the player of {} sends more than {:g} key changes a second (--key-limit): what is more is "
      "not felt",
      game::bat_name(counters.player_over_limit), options_.key_limit_per_s);
}

/// Players are told on their screens if there is none.
void ServerProcess::keep_records() {
  for (const game::KeyLog& log : server_.take_finished()) {
    if (const auto trouble = records_.keep(log)) spdlog::error("{}; matches go on", *trouble);
    server_.set_unrecorded(records_.is_failing());
  }
}

std::optional<game::ServerEvidence> ServerProcess::evidence(const game::ServedGame& played) const {
  std::optional<game::ServerEvidence> evidence = serving_.evidence();
  if (!evidence) return std::nullopt;
  evidence->choice = played.choice;
  evidence->state_file = options_.from_state;
  evidence->state = played.state;
  evidence->scheme = options_.scheme;
  evidence->policy = options_.policy;
  return evidence;
}

Json ServerProcess::report() const {
  const double ticks = std::max<double>(1.0, static_cast<double>(costs_.ticks));
  std::string why_invalid = server_.trouble();
  if (game::is_interrupted) why_invalid = "interrupted";
  if (why_invalid.empty() && costs_.ticks == 0) why_invalid = "no tick was measured";
  Json report{{"mode", "client-server"},
              {"scheme", options_.scheme},
              {"policy", options_.policy},
              {"threshold", options_.threshold},
              {"clients", options_.clients},
              {"seed", options_.seed},
              {"tick_rate_hz", options_.rate_hz},
              {"pace", options_.pace},
              {"time_managed", options_.is_time_managed},
              {"ticks", costs_.ticks},
              {"ticks_on_time_fraction", static_cast<double>(costs_.ticks_on_time) / ticks},
              {"physics_us_per_tick", 1e6 * costs_.physics_s / ticks},
              {"filter_us_per_tick", 1e6 * costs_.filter_s / ticks},
              {"send_us_per_tick", 1e6 * costs_.send_s / ticks},
              {"send_us_max", 1e6 * costs_.send_max_s},
              {"spread", options_.spread},
              {"burst_bytes_max", staggered_.burst_bytes_max()},
              {"server_rss_bytes", game::resident_bytes()},
              {"evidence_bytes", serving_.evidence_bytes()},
              {"measured_s", costs_.span_s},
              {"valid", why_invalid.empty()},
              {"why_invalid", why_invalid}};
  report.update(counted_report(serving_, costs_.begin, costs_.end));
  return report;
}

/// Asks a running server, once or again and again.
game::ExitStatus show_status(const game::ServeOptions& options) try {
  const auto [address, port] = game::address_and_port("--status", options.status);
  do {
    const game::StatusAnswer answer = game::ask_status({.address = address,
                                                        .port = port,
                                                        .transport = options.transport,
                                                        .key_file = options.key_file},
                                                       now_s);
    if (!answer.reports) {
      spdlog::error("--status: {}: {}", options.status, answer.trouble);
      return game::ExitStatus::no_server;
    }
    std::fputs(game::status_table(*answer.reports).c_str(), stdout);
    std::fflush(stdout);
    const double next_s = now_s() + options.every_s;
    while (options.every_s > 0.0 && !game::is_interrupted && now_s() < next_s)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  } while (options.every_s > 0.0 && !game::is_interrupted);
  return game::ExitStatus::ok;
} catch (const rti::TransportError& error) {
  spdlog::error("--status: {}", error.what());
  return game::ExitStatus::no_server;
}

game::ExitStatus serve(game::ServeOptions& options) {
  if (!options.status.empty()) return show_status(options);
  const rti::FederationFile file = game::follow_federation_file(options);
  const std::string& federation = file.federation;
  const rti::Fom fom = game::load_rink_fom(file.fom);
  const game::ServedGame played = game::served_game(options);
  game::require_room(options, played.scene);

  rti::ensure_file_limit(options.clients + 64u);
  ServerProcess process(options, fom, played, federation);
  const std::uint16_t port = process.listen();
  std::printf("listening on %s:%u\n", options.address.c_str(), static_cast<unsigned>(port));
  std::fflush(stdout);
  process.try_records();
  const bool is_complete = process.start();
  const std::uint32_t came = process.server().player_count();  // before they leave
  const std::string missing = is_complete ? "" : process.missing();
  if (is_complete) process.run();
  Json report = process.report();
  // Both before the players leave, for the hash is of now.
  std::optional<game::ServerEvidence> evidence = process.evidence(played);
  const game::KeyLog log = options.record.empty() || !options.hosted.empty()
                               ? game::KeyLog{}
                               : game::record_of(played, process.server());
  if (report["lost_federates"] != 0 || report["dropped_connections"] != 0)
    spdlog::warn("{} federates were lost, {} connections dropped",
                 report["lost_federates"].get<std::uint64_t>(),
                 report["dropped_connections"].get<std::uint64_t>());
  if (report["keys_over_limit"] != 0)
    spdlog::warn("{} key changes above --key-limit were not felt",
                 report["keys_over_limit"].get<std::uint64_t>());
  process.end();
  game::add_totals(report, process.totals());
  if (!options.report.empty()) game::write_file(options.report, report.dump(2));
  if (evidence) game::write_evidence(options.evidence, *evidence);
  if (!options.record.empty() && options.hosted.empty()) game::write_key_log(options.record, log);
  if (game::is_interrupted) return game::ExitStatus::interrupted;
  if (!process.server().trouble().empty()) {
    spdlog::error("the server's own federate left the federation: {}", process.server().trouble());
    return game::ExitStatus::failed;
  }
  if (!is_complete) {
    if (came < options.clients)
      spdlog::error("{} of {} players came within {} s{}", came, options.clients,
                    options.patience_s, missing);
    else
      spdlog::error("{} players came, but not all were ready to start within {} s", came,
                    options.patience_s);
    return game::ExitStatus::nobody_came;
  }
  return game::ExitStatus::ok;
}

/// Runs `serve` and turns what it throws into one line and an exit status.
game::ExitStatus serve_or_explain(game::ServeOptions& options) {
  try {
    return serve(options);
  } catch (const rti::TransportError& error) {
    spdlog::error("{}", error.what());
    using Kind = rti::TransportError::Kind;
    if (error.kind() == Kind::in_use || error.kind() == Kind::no_such_address ||
        error.kind() == Kind::no_permission)
      return game::ExitStatus::address_in_use;
    return error.kind() == Kind::too_many_files ? game::ExitStatus::too_few_files
                                                : game::ExitStatus::failed;
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return game::ExitStatus::bad_input;
  }
}

}  // namespace

int main(int count, char** values) {
  game::speak_as("rink-serve");
  CLI::App app;
  app.set_version_flag("--version", game::version_line("rink-serve"));
  game::ServeOptions options;
  game::add_options(app, options);
  try {
    app.parse(count, values);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(game::ExitStatus::bad_input);
  }
  game::host_by_default(app, options);
  game::hear_interrupts();
  return static_cast<int>(serve_or_explain(options));
}
