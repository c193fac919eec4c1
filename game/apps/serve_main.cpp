// rink serve: the server federate and, beside it, the RTI with its filter, on a real-time or
// synchronous tick.
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "game/apps/command.h"
#include "game/apps/serve_flags.h"
#include "game/apps/server_process.h"
#include "game/control/key_log_file.h"
#include "game/model/report_fields.h"
#include "game/net/address.h"
#include "game/net/exit_status.h"
#include "game/net/fom_file.h"
#include "game/net/interrupt.h"
#include "game/net/record_file.h"
#include "game/net/server/serve_requirements.h"
#include "game/net/server/serve_status.h"
#include "game/process/thread_team.h"
#include "game/replication/trajectory_codec.h"
#include "game/version/version.h"
#include "rti/federation_file.h"

namespace rink::game {
namespace {

using Json = nlohmann::ordered_json;

/// Queries a running server, once or repeatedly.
ExitStatus show_status(const ServeOptions& options) try {
  const auto [address, port] = address_and_port("--status", options.status);
  do {
    const StatusAnswer answer = ask_status({.address = address,
                                            .port = port,
                                            .transport = options.transport,
                                            .key_file = options.key_file},
                                           now_s);
    if (!answer.reports) {
      complain("--status: ", options.status, ": ", answer.error);
      return ExitStatus::no_server;
    }
    std::fputs(status_table(*answer.reports).c_str(), stdout);
    std::fflush(stdout);
    const double next_s = now_s() + options.every_s;
    while (options.every_s > 0.0 && !is_interrupted && now_s() < next_s)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  } while (options.every_s > 0.0 && !is_interrupted);
  return ExitStatus::ok;
} catch (const rti::TransportError& error) {
  complain("--status: ", error.what());
  return ExitStatus::no_server;
}

/// The game of the options, if there is room for it and enough bodies for the threads.
ServedGame game_of(const ServeOptions& options) {
  ServedGame played = served_game(options);
  require_room(options, played.scene);
  const auto objection = objection_to_threads(options.threads, count_of(played.scene.bodies));
  if (objection) throw std::runtime_error("--threads: " + *objection);
  return played;
}

ExitStatus serve(ServeOptions& options) {
  if (!options.status.empty()) return show_status(options);
  const rti::FederationFile file = follow_federation_file(options);
  const std::string& federation = file.federation;
  const rti::Fom fom = load_rink_fom(file.fom);
  ServedGame played = game_of(options);
  ThreadTeam team(options.threads);
  played.scene.world.slabs = physics::SlabPlan{.workers = &team};
  rti::ensure_file_limit(options.clients + 64u);
  ServerProcess process(options, fom, played, federation);
  const std::uint16_t port = process.listen();
  std::printf("listening on %s:%u\n", options.address.c_str(), static_cast<unsigned>(port));
  std::fflush(stdout);
  process.try_records();
  const bool is_complete = process.start();
  const std::uint32_t came = process.server().seats().player_count();  // before they leave
  const std::string missing = is_complete ? "" : process.missing();
  if (is_complete) process.run();
  Json report = process.report();
  // Trace and record come before the players leave, since the hash is of this instant.
  std::optional<ServerTrace> trace = process.trace(played);
  const KeyLog log = options.record.empty() || !options.hosted.empty()
                         ? KeyLog{}
                         : record_of(played, process.server());
  if (report[report::lost_federates.key] != 0 || report[report::dropped_connections.key] != 0)
    warn(report[report::lost_federates.key].get<std::uint64_t>(), " federates were lost, ",
         report[report::dropped_connections.key].get<std::uint64_t>(), " connections dropped");
  if (report[report::keys_over_limit.key] != 0)
    warn(report[report::keys_over_limit.key].get<std::uint64_t>(),
         " key changes above --key-limit were not felt");
  process.end();
  add_totals(report, process.totals());
  if (!options.report.empty()) write_file(options.report, report.dump(2));
  if (trace) write_trace(options.trace, *trace);
  if (!options.record.empty() && options.hosted.empty()) write_key_log(options.record, log);
  if (is_interrupted) return ExitStatus::interrupted;
  if (!process.server().error().empty()) {
    complain("the server's own federate left the federation: ", process.server().error());
    return ExitStatus::failed;
  }
  if (!is_complete) {
    if (came < options.clients)
      complain(came, " of ", options.clients, " players came within ", options.patience_s, " s",
               missing);
    else
      complain(came, " players came, but not all were ready to start within ", options.patience_s,
               " s");
    return ExitStatus::nobody_came;
  }
  return ExitStatus::ok;
}

int status_of(const std::exception& error) {
  return static_cast<int>(exit_status(error, {.bad_address = ExitStatus::address_in_use,
                                              .too_many_files = ExitStatus::too_few_files,
                                              .otherwise = ExitStatus::failed}));
}

}  // namespace
}  // namespace rink::game

int main(int count, char** words) {
  using namespace rink::game;
  speak_as("rink-serve");
  Flags flags;
  flags.version(version_line("rink-serve"));
  ServeOptions options;
  add_options(flags, options);
  return run_command(flags, count, words,
                     {.run =
                          [&] {
                            host_by_default(flags, options);
                            return static_cast<int>(serve(options));
                          },
                      .status_of = status_of});
}
