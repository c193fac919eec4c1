// rink serve: the server federate and, beside it, the RTI with its filter, on a real-time or
// synchronous tick.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <thread>

#include "game/apps/command.h"
#include "game/apps/rank_command.h"
#include "game/apps/serve_flags.h"
#include "game/apps/serve_rank.h"
#include "game/apps/server_process.h"
#include "game/control/key_log_file.h"
#include "game/model/report_fields.h"
#include "game/net/address.h"
#include "game/net/discovery/announcing.h"
#include "game/net/exit_status.h"
#include "game/net/fom_file.h"
#include "game/net/interrupt.h"
#include "game/net/peer/network/listening_place.h"
#include "game/net/peer/network/session_error.h"
#include "game/net/plugins.h"
#include "game/net/record_file.h"
#include "game/net/server/serve_requirements.h"
#include "game/net/server/serve_status.h"
#include "game/net/server/serving.h"
#include "game/node/node.h"
#include "game/node/rank_meeting.h"
#include "game/node/socket_meeting.h"
#include "game/process/thread_team.h"
#include "game/replication/filter_setup.h"
#include "game/replication/scheme_reach.h"
#include "game/replication/trajectory_codec.h"
#include "game/version/version.h"
#include "im/basics/hexadecimal.h"
#include "im/filter.h"
#include "rti/federation_file.h"

namespace rink::game {
namespace {

using Json = nlohmann::ordered_json;

/// Queries a running server, once or repeatedly.
ExitStatus show_status(const ServeOptions& options) try {
  const auto [address, port] = address_and_port("--status", options.status);
  const auto error = print_status({.address = address,
                                   .port = port,
                                   .transport = options.transport,
                                   .key_file = options.key_file},
                                  options.every_s, now_s);
  if (error) {
    complain("--status: ", options.status, ": ", *error);
    return ExitStatus::no_server;
  }
  return ExitStatus::ok;
} catch (const rti::TransportError& error) {
  complain("--status: ", error.what());
  return ExitStatus::no_server;
}

/// The game of the options, if there is room for it and enough bodies for the threads. A rank has
/// options of its own once it is one.
ServedGame game_of(ServeOptions& options, RankCommand& command) {
  ServedGame played = served_game(options);
  if (options.is_rank) become_rank(options, command.begin());
  require_room(options, played.scene);
  if (is_node(options))
    options.cell_size = cell_size_of_nodes(played.scene, options.scheme, options.cell_size);
  const auto objection = objection_to_threads(options.threads, count_of(played.scene.bodies));
  if (objection) throw std::runtime_error("--threads: " + *objection);
  return played;
}

/// How far beyond its region a client may be shown something by the filter of the options. Schemes
/// that look ahead, and swept regions, ask how fast other bodies are, so all must be there.
SchemeReach reach_of_clients(const ServeOptions& options, const SharedGame& game) {
  constexpr double everywhere = std::numeric_limits<double>::infinity();
  const im::FilterSettings settings =
      federation_settings(game.scene(), options.scheme, options.cell_size).filter_settings;
  const im::Traits traits = im::make_filter(options.scheme, settings)->traits();
  // What else than places decides cannot be tried out.
  if (options.sweep_ticks > 0 || traits.uses_flights || traits.uses_facts ||
      !settings.plugins.empty())
    return {everywhere, everywhere};
  return reach_of(options.scheme, settings, game.extent_max());
}

/// How the server meets others. Null for a server alone.
std::unique_ptr<Meeting> meeting_of(const ServeOptions& options, RankCommand& command) {
  if (!is_node(options)) return nullptr;
  const auto terms = [&](std::uint32_t nodes) {
    const double tick_s = 1.0 / options.rate_hz;
    Terms all = options.hosted.empty()
                    ? terms_of_nodes(nodes, options.duration_s, tick_s, options.balance_windows)
                    : terms_of_matches(nodes, tick_s, options.balance_windows);
    all.is_replicated = options.is_replicated;
    return all;
  };
  if (options.is_rank) return std::make_unique<RankMeeting>(command.ranks(), terms(1));
  const Place place = listening_place(options.node_listen, options.join, true,
                                      {.listen = "--node-listen", .join = "--join"});
  if (options.join.empty()) return std::make_unique<SocketMeeting>(place, terms(options.nodes));
  const auto [address, port] = address_and_port("--join", options.join);
  return std::make_unique<SocketMeeting>(place, Place{address, port});
}

/// The node that plays the game together with others, once all have met; its terms hold. Null for
/// a server alone.
std::unique_ptr<Node> node_of(ServeOptions& options, std::optional<SharedGame>& game,
                              Meeting* meeting, std::function<std::string()> players_place) {
  if (!game || meeting == nullptr) return nullptr;
  NodeSettings settings;
  const bool is_hosting = !options.hosted.empty();
  settings.player_count = is_hosting ? 0 : options.clients;
  if (is_hosting)
    settings.hosting = {.countdown_s = options.countdown_s, .patience_s = options.absence_s};
  settings.patience_s = options.node_patience_s, settings.gathering_s = options.patience_s;
  settings.reach = reach_of_clients(options, *game);
  settings.absence_s = options.absence_s;
  settings.notify = [](const std::string& news) { warn(news); };
  settings.players_place = std::move(players_place);
  auto node = std::make_unique<Node>(*game, *meeting, settings, now_s);
  if (const std::optional<Place> place = meeting->place()) {
    std::printf("nodes reach this one at %s\n", place->text().c_str());
    std::fflush(stdout);
  }
  node->meet();
  std::printf("this is node %u of %u, with %u players from bat %u on\n", node->number(),
              node->terms().peer_count, node->player_count(), node->first_player());
  std::fflush(stdout);
  if (!is_hosting) options.duration_s = node->terms().until;
  options.rate_hz = 1.0 / node->terms().window;
  return node;
}

double mean(std::uint64_t sum, std::uint64_t count) {
  return static_cast<double>(sum) / static_cast<double>(std::max<std::uint64_t>(1, count));
}

/// What all nodes have played together is what this one has shown, bit for bit.
ExitStatus end_together(Node& node, ServerProcess& process) {
  process.show_rest();
  if (is_interrupted || !process.server().error().empty()) return ExitStatus::ok;
  const PlayedPart& part = node.finish();
  const std::string hash = hexadecimal(part.hash);
  std::printf("node %u of %u: hash %s at %g s, %zu keys, goals %u:%u\n", node.number(),
              node.terms().peer_count, hash.c_str(), part.time, part.keys.size(), part.score.left,
              part.score.right);
  const TellingCounters& told = node.telling();
  std::printf("told others of %.1f bodies a window, in %.0f bytes; zones shifted %llu times\n",
              mean(told.bodies, told.windows), mean(told.bytes, told.windows),
              static_cast<unsigned long long>(part.counters.shifts));
  std::fflush(stdout);
  if (const std::uint64_t shown = process.server().game().hash(); shown != part.hash)
    throw SessionError(ExitStatus::failed, "this node has shown another game than was played: " +
                                               hexadecimal(shown) + " instead of " + hash);
  if (!part.may_have_split) return ExitStatus::ok;
  warn("this node went on alone, and the other may have done so too: the hash is that of one part");
  return ExitStatus::may_have_split;
}

/// A process that stood still has lost its own federate too: what the other nodes made of that
/// comes first, if they soon say it.
std::exception_ptr why_lost(Node& node, std::exception_ptr otherwise) {
  try {
    for (const double until = now_s() + 1.0; now_s() < until; node.check())
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
  } catch (const std::exception&) {
    return std::current_exception();
  }
  return otherwise;
}

/// The user has interrupted this server, which ends its node.
ExitStatus interrupted(Node* node) {
  if (node != nullptr) try {
      node->finish();
    } catch (const SessionError& error) {
      if (error.status() != ExitStatus::may_have_split) return ExitStatus::interrupted;
      warn(error.what());
      return error.status();
    } catch (const std::exception&) {  // it is over
    }
  return ExitStatus::interrupted;
}

/// Where players of other machines reach this server; who listens at every address is reached at
/// that of its node.
std::string players_place(const ServeOptions& options, const Meeting& meeting, std::uint16_t port) {
  const std::optional<Place> place = meeting.place();
  const bool is_everywhere = options.address == "0.0.0.0" || options.address == "::";
  return Place{is_everywhere && place ? place->address : options.address, port}.text();
}

/// Answers windows of the local network that look for a match; null where nobody is to be answered.
std::unique_ptr<Announcing> announced(const ServeOptions& options, std::uint16_t port) {
  if (options.hosted.empty() || !options.is_announced || is_node(options)) return nullptr;
  char machine[256] = {};
  ::gethostname(machine, sizeof machine - 1);
  std::random_device random;
  const std::string& at = options.address;
  return std::make_unique<Announcing>(
      AnnouncedMatch{.name = match_name(options.name.empty() ? machine : options.name),
                     .host = std::uint64_t{random()} << 32 | random(),
                     .port = port,
                     .is_local_only = at.starts_with("127.") || at == "localhost" || at == "::1"},
      discovery_group(), now_s);
}

ExitStatus serve(ServeOptions& options, RankCommand& command) {
  if (!options.status.empty()) return show_status(options);
  for (const std::string& file : options.plugins) load_plugin(file);
  const rti::FederationFile file = follow_federation_file(options);
  const std::string& federation = file.federation;
  const rti::Fom fom = load_rink_fom(file.fom);
  for (const std::string& warning : fom.warnings()) warn(warning);
  ServedGame played = game_of(options, command);
  std::optional<SharedGame> shared;
  if (is_node(options)) shared.emplace(played.scene, std::vector<InputEvent>{});
  ThreadTeam team(options.threads);
  played.scene.world.slabs = physics::SlabPlan{.workers = &team};
  constexpr std::uint32_t bundles = 960;  // of clients that share sockets; more wait to be accepted
  rti::ensure_file_limit(
      64u + (options.transport == "bundle" ? std::min(options.clients, bundles) : options.clients));
  const std::unique_ptr<Meeting> meeting = meeting_of(options, command);
  std::string served_at;  // known before anybody plays
  const std::unique_ptr<Node> node =
      node_of(options, shared, meeting.get(), [&served_at] { return served_at; });
  played.shared = node.get();
  ServerProcess process(options, fom, played, federation);
  const std::uint16_t port = process.listen();
  const std::string rank = options.is_rank ? "rank " + std::to_string(node->number()) + ": " : "";
  std::printf("%slistening on %s:%u\n", rank.c_str(), options.address.c_str(),
              static_cast<unsigned>(port));
  std::fflush(stdout);
  const std::unique_ptr<Announcing> announcing = announced(options, port);
  if (node) served_at = players_place(options, *meeting, port);
  process.try_records();
  const bool is_complete = process.start();
  const std::uint32_t came = process.server().seats().player_count();  // before they leave
  const std::string missing = is_complete ? "" : process.missing();
  ExitStatus ending = ExitStatus::ok;
  std::exception_ptr lost;  // what ended a shared game early: reports and records come first
  if (is_complete) try {
      process.run();
      if (node && options.hosted.empty()) ending = end_together(*node, process);
    } catch (const std::exception&) {
      if (!node) throw;
      lost = std::current_exception();
    }
  if (node && (lost || !process.server().error().empty())) lost = why_lost(*node, lost);
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
         options.hosted.empty()
             ? " key changes above --key-limit were not felt"
             : " key changes or pushes above --key-limit or --push-limit were not felt");
  process.end();
  add_totals(report, process.totals());
  if (!options.report.empty()) write_file(options.report, report.dump(2));
  if (trace) write_trace(options.trace, *trace);
  if (!options.record.empty() && options.hosted.empty()) write_key_log(options.record, log);
  if (is_interrupted) return interrupted(node.get());
  if (lost) std::rethrow_exception(lost);
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
  return ending;
}

int status_of(const std::exception& error) {
  if (const auto status = session_status(error)) return static_cast<int>(*status);
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
                            serve_among_ranks(flags, options);
                            require_heeded(flags, options);
                            RankCommand command(status_of);
                            return command.run([&] { return serve(options, command); });
                          },
                      .status_of = status_of});
}
