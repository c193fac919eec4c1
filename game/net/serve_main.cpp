// rink serve: the server federate and, beside it, the RTI with its filter, on a real-time or synchronous tick.
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "game/control/key_log.h"
#include "game/model/scene_file.h"
#include "game/net/exit_status.h"
#include "game/net/flags.h"
#include "game/net/fom_file.h"
#include "game/net/serve_options.h"
#include "game/net/server.h"
#include "rti/federation_execution.h"
#include "rti/federation_file.h"
#include "rti/message.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/in_process.h"
#include "rti/transport/tcp.h"

namespace {

using namespace rink;
using Json = nlohmann::ordered_json;

volatile std::sig_atomic_t is_interrupted = 0;

/// The due instant in stamps from before the start, when nothing is due yet.
constexpr double not_started_s = 0.0;

/// A federate registers at most `object_block` objects; the rest is for bats that come back.
constexpr std::size_t body_max = rti::object_block / 2;

/// The clock of every process of this machine that the stamps refer to [s].
double now_s() { return 1e-9 * static_cast<double>(std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count()); }

std::chrono::nanoseconds nanoseconds(double seconds) { return std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9)); }

/// What the run cost, summed over the measured ticks.
struct Costs {
  std::uint64_t ticks = 0, ticks_on_time = 0;
  double physics_s = 0.0, filter_s = 0.0, send_s = 0.0, span_s = 0.0;
  rti::FederationCounters begin, end;          ///< of the RTI, the server's own federate included
  rti::TransportCounters tcp_begin, tcp_end;   ///< of the clients' connections
};

/// Adds the time since it was made or last read to a sum.
class Stopwatch {
 public:
  void add_to(double& sum) {
    const double now = now_s();
    sum += now - since_;
    since_ = now;
  }

 private:
  double since_ = now_s();
};

/// The whole server process: game, RTI, transports, and the loop that ticks them.
class Serving {
 public:
  Serving(const game::ServeOptions& options, const rti::Fom& fom, const game::Scene& scene, const std::string& federation, std::optional<std::vector<game::InputEvent>> replay)
      : options_(options),
        execution_(fom, federation_settings(options, scene, federation)),
        host_(execution_),
        server_(fom, scene, {.federation = federation, .policy = options.policy, .replay = std::move(replay)}, [this] { return simulated_now(); }),
        link_(server_.ambassador(), endpoint_, (hub_.listen("rti"), endpoint_.connect("rti"))) {
    execution_.advance_clock(now_s());  // before anybody connects: silence counts from then on
    links_.add(link_);
    host_.add(hub_);
    host_.add(tcp_);
  }

  std::uint16_t listen() { return tcp_.listen(options_.address, options_.port); }

  /// Waits for the players and the start barrier; false if they did not all come in time.
  bool start();
  void run();
  /// Lets the clients take their leave.
  void end();

  const game::Server& server() const { return server_; }
  Json report() const;
  /// Adds what the connections carried from first to last, as counted here and by the kernel.
  void add_totals(Json& report) const;

 private:
  static rti::FederationSettings federation_settings(const game::ServeOptions& options, const game::Scene& scene, const std::string& federation);
  double simulated_now() const { return start_s_ == 0.0 ? 0.0 : (options_.pace == "synchronous" ? server_.game().now() : std::max(0.0, now_s() - start_s_)); }
  void exchange_until(double until_s);
  void exchange(double longest_wait_s);
  void await_turns();
  void send_tick(double simulated_s, double due_s, Costs& costs);
  void tick(std::uint64_t number);

  game::ServeOptions options_;
  rti::InProcessNetwork network_;
  rti::InProcessEndpoint hub_{network_}, endpoint_{network_};
  rti::TcpTransport tcp_;
  rti::FederationExecution execution_;
  rti::FederationHost host_;
  game::Server server_;
  rti::FederateLink link_;
  rti::FederateLinks links_;
  double start_s_ = 0.0;
  Costs costs_;
};

rti::FederationSettings Serving::federation_settings(const game::ServeOptions& options, const game::Scene& scene, const std::string& federation) {
  rti::FederationSettings settings;
  settings.federation = federation;
  settings.filter = options.scheme;
  settings.filter_settings = {.world = {0.0, 0.0, scene.world.field.length, scene.world.field.width}, .cell_size = options.cell_size};
  return settings;
}

/// Takes in and hands on what came, for at most `longest_wait_s`. Interactions go on at once, not with the tick, so that keys are stamped when they arrive.
void Serving::exchange(double longest_wait_s) {
  host_.poll(nanoseconds(std::max(0.0, longest_wait_s)));
  host_.flush();
  endpoint_.poll({}, links_);
  link_.flush(now_s());
}

void Serving::exchange_until(double until_s) {
  do exchange(std::min(0.25, until_s - now_s()));
  while (now_s() < until_s && !is_interrupted);
}

/// However long the players think, silence is noticed and the RTI is heard to live.
void Serving::await_turns() {
  while (!is_interrupted && server_.trouble().empty() && !server_.all_turns_done()) {
    exchange(0.25);
    host_.advance_clock(now_s());
  }
}

bool Serving::start() {
  const double give_up_s = now_s() + options_.patience_s;
  Costs uncounted;
  while (!is_interrupted && (!server_.is_joined() || server_.player_count() < options_.clients)) {
    if (now_s() > give_up_s) return false;
    exchange(0.02);
    if (server_.is_joined()) send_tick(0.0, not_started_s, uncounted);
    host_.advance_clock(now_s());
  }
  server_.call_to_start();
  while (!is_interrupted && !server_.is_started()) {
    if (now_s() > give_up_s) return false;
    exchange(0.005);
    send_tick(0.0, not_started_s, uncounted);
  }
  return true;
}

/// Publishes, matches and flushes: what leaves the server in one tick, one write per destination.
void Serving::send_tick(double simulated_s, double due_s, Costs& costs) {
  Stopwatch watch;
  server_.publish({.time = simulated_s, .tag = static_cast<std::uint64_t>(due_s * 1e9)});
  link_.flush(now_s());
  host_.poll({});
  watch.add_to(costs.send_s);
  host_.match();
  watch.add_to(costs.filter_s);
  host_.flush();
  watch.add_to(costs.send_s);
}

void Serving::tick(std::uint64_t number) {
  const double period_s = 1.0 / options_.rate_hz, simulated_s = static_cast<double>(number) * period_s;
  const double due_s = options_.pace == "synchronous" ? now_s() : start_s_ + simulated_s;
  Costs uncounted;
  const bool is_counted = simulated_s >= options_.warm_up_s;
  Costs& costs = is_counted ? costs_ : uncounted;
  Stopwatch watch;
  server_.simulate(simulated_s);
  watch.add_to(costs.physics_s);
  send_tick(simulated_s, due_s, costs);
  ++costs.ticks;
  if (now_s() <= due_s + period_s) ++costs.ticks_on_time;
  host_.advance_clock(now_s());
}

void Serving::run() {
  constexpr double lead_s = 0.1;  // so that the first tick is not late
  start_s_ = now_s() + lead_s;
  const std::uint64_t last = options_.duration_s > 0.0 ? static_cast<std::uint64_t>(std::floor(options_.duration_s * options_.rate_hz + 1e-9)) : ~0ull;
  bool is_measuring = false;
  double measured_from_s = start_s_;
  for (std::uint64_t number = 0; number <= last && !is_interrupted && server_.trouble().empty(); ++number) {
    const double simulated_s = static_cast<double>(number) / options_.rate_hz;
    if (options_.pace == "synchronous")
      await_turns();
    else
      exchange_until(start_s_ + simulated_s);
    if (is_interrupted || !server_.trouble().empty()) break;
    if (!is_measuring && simulated_s >= options_.warm_up_s) {
      is_measuring = true;
      measured_from_s = now_s();
      costs_.begin = execution_.counters();
      costs_.tcp_begin = tcp_.totals();
    }
    tick(number);
  }
  costs_.span_s = is_measuring ? now_s() - measured_from_s : 0.0;
  costs_.end = execution_.counters();
  costs_.tcp_end = tcp_.totals();
}

void Serving::end() {
  const double give_up_s = now_s() + (is_interrupted ? 0.0 : 2.0);
  while (server_.player_count() > 0 && now_s() < give_up_s) exchange(0.01);
}

Json Serving::report() const {
  const double ticks = std::max<double>(1.0, static_cast<double>(costs_.ticks));
  const rti::FederationCounters& begin = costs_.begin;
  const rti::FederationCounters& end = costs_.end;
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(server_.game().hash()));
  std::uint64_t dropped = 0;
  for (const std::uint64_t count : end.drops) dropped += count;
  std::string why_invalid = server_.trouble();
  if (is_interrupted) why_invalid = "interrupted";
  if (why_invalid.empty() && costs_.ticks == 0) why_invalid = "no tick was measured";
  return {{"mode", "client-server"},
          {"scheme", options_.scheme},
          {"policy", options_.policy},
          {"clients", options_.clients},
          {"entities", server_.game().entities().size()},
          {"seed", options_.seed},
          {"tick_rate_hz", options_.rate_hz},
          {"ticks", costs_.ticks},
          {"ticks_on_time_fraction", static_cast<double>(costs_.ticks_on_time) / ticks},
          {"physics_us_per_tick", 1e6 * costs_.physics_s / ticks},
          {"filter_us_per_tick", 1e6 * costs_.filter_s / ticks},
          {"send_us_per_tick", 1e6 * costs_.send_s / ticks},
          {"server_rss_bytes", game::resident_bytes()},
          {"state_hash", hash},
          {"measured_s", costs_.span_s},
          {"bytes_sent", costs_.tcp_end.bytes_sent - costs_.tcp_begin.bytes_sent},
          {"bytes_received", costs_.tcp_end.bytes_received - costs_.tcp_begin.bytes_received},
          {"writes_sent", costs_.tcp_end.writes - costs_.tcp_begin.writes},
          {"segments_sent", costs_.tcp_end.segments_sent - costs_.tcp_begin.segments_sent},
          {"messages_sent", end.updates_sent - begin.updates_sent + end.interactions_sent - begin.interactions_sent},
          {"scope_entries", end.scope_entries - begin.scope_entries},
          {"scope_exits", end.scope_exits - begin.scope_exits},
          {"lost_federates", server_.counters().federates_lost},
          {"dropped_connections", dropped + host_.closed_by_full_queue()},
          {"keys_received", server_.counters().keys_received},
          {"keys_applied", server_.counters().keys_applied},
          {"keys_refused", server_.counters().keys_refused},
          {"valid", why_invalid.empty()},
          {"why_invalid", why_invalid}};
}

void Serving::add_totals(Json& report) const {
  const rti::TransportCounters total = tcp_.totals();
  report["total_bytes_sent"] = total.bytes_sent;
  report["total_bytes_received"] = total.bytes_received;
  report["kernel_bytes_sent"] = total.kernel_bytes_sent.value_or(0);
  report["kernel_bytes_received"] = total.kernel_bytes_received.value_or(0);
}

/// Throws if nobody could ever satisfy the options, or a file for the results could not be written when the run is over.
void require_room(const game::ServeOptions& options, const game::Scene& scene) {
  const game::Bodies& bodies = scene.bodies;
  if (options.clients > bodies.bats.size())
    throw std::runtime_error("--clients: " + std::to_string(options.clients) + " players, but scene '" + options.scene + "' has " + std::to_string(bodies.bats.size()) +
                             " bats; allowed is at most as many");
  const std::size_t body_count = bodies.bats.size() + bodies.pucks.size() + bodies.posts.size();
  if (body_count > body_max)
    throw std::runtime_error("scene '" + options.scene + "' has " + std::to_string(body_count) + " bodies; allowed is at most " + std::to_string(body_max));
  game::require_writable("--report", options.report);
  game::require_writable("--record", options.record);
}

game::ExitStatus serve(game::ServeOptions& options) {
  std::string federation = "rink", fom_path = game::fom_file();
  if (!options.federation_file.empty()) {
    const rti::FederationFile file = rti::load_federation_file(options.federation_file);
    federation = file.federation;
    fom_path = file.fom;
    options.address = file.nodes.front().address;
    options.port = file.nodes.front().port;
  }
  const rti::Fom fom = rti::Fom::load(fom_path);
  game::Scene scene = game::load_scene(options.scene);
  if (options.bats > 0) scene = game::scaled_to_bats(scene, options.bats);
  if (options.seed > 0) scene = game::with_seed(scene, options.seed);
  require_room(options, scene);
  std::optional<std::vector<game::InputEvent>> replay;
  if (!options.keys.empty()) {
    game::KeyLog log = game::read_key_log(options.keys);
    game::require_fit(log, scene, options.keys);
    replay = std::move(log.events);
  }

  rti::ensure_file_limit(options.clients + 64u);
  Serving serving(options, fom, scene, federation, std::move(replay));
  const std::uint16_t port = serving.listen();
  std::printf("listening on %s:%u\n", options.address.c_str(), static_cast<unsigned>(port));
  std::fflush(stdout);
  const bool is_complete = serving.start();
  if (is_complete) serving.run();
  Json report = serving.report();
  if (report["lost_federates"] != 0 || report["dropped_connections"] != 0)
    spdlog::warn("{} federates were lost, {} connections dropped", report["lost_federates"].get<std::uint64_t>(), report["dropped_connections"].get<std::uint64_t>());
  serving.end();
  serving.add_totals(report);
  if (!options.report.empty()) game::write_file(options.report, report.dump(2));
  if (!options.record.empty()) {
    game::KeyLog log = game::key_log_for(scene);
    log.scene = options.scene;
    log.events = serving.server().record();
    game::write_key_log(options.record, log);
  }
  if (is_interrupted) return game::ExitStatus::interrupted;
  if (!is_complete) {
    spdlog::error("{} of {} players came within {} s", serving.server().player_count(), options.clients, options.patience_s);
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
    if (error.kind() == Kind::in_use || error.kind() == Kind::no_such_address || error.kind() == Kind::no_permission) return game::ExitStatus::address_in_use;
    return error.kind() == Kind::too_many_files ? game::ExitStatus::too_few_files : game::ExitStatus::failed;
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return game::ExitStatus::bad_input;
  }
}

}  // namespace

int main(int count, char** values) {
  game::speak_as("rink-serve");
  CLI::App app;
  game::ServeOptions options;
  game::add_options(app, options);
  try {
    app.parse(count, values);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(game::ExitStatus::bad_input);
  }
  std::signal(SIGINT, [](int) { is_interrupted = 1; });
  std::signal(SIGTERM, [](int) { is_interrupted = 1; });
  std::signal(SIGPIPE, SIG_IGN);
  return static_cast<int>(serve_or_explain(options));
}
