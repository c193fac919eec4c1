// rink peer: one of the processes that share a simulation without a server, equal to one engine's
// bit for bit.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

#include "game/apps/command.h"
#include "game/apps/peer_flags.h"
#include "game/apps/peer_ranks.h"
#include "game/apps/peer_report.h"
#include "game/apps/rank_command.h"
#include "game/control/key_log_file.h"
#include "game/control/match_flow.h"
#include "game/model/report_fields.h"
#include "game/model/scene_file.h"
#include "game/net/address.h"
#include "game/net/exit_status.h"
#include "game/net/interrupt.h"
#include "game/net/peer/crowd.h"
#include "game/net/peer/network/listening_place.h"
#include "game/net/peer/network/peer_network.h"
#include "game/net/peer/network/session_error.h"
#include "game/net/peer/network/unguessable_number.h"
#include "game/net/peer/shared_game.h"
#include "game/net/peer/start_together.h"
#include "game/net/record_file.h"
#include "game/node/match/match_bots.h"
#include "game/node/node.h"
#include "game/node/socket_meeting.h"
#include "game/version/version.h"
#include "rti/transport/socket_transport.h"

namespace rink::game {
namespace {

using Json = nlohmann::ordered_json;

void write_record(const PeerOptions& options, const SharedGame& shared, const PlayedPart& part) {
  if (options.record.empty()) return;
  write_key_log(std::filesystem::path(options.record),
                shared.record_of(part, scene_text(options.scene)));
}

/// Waits until all first peers are connected, or until the playing peers have introduced each
/// other.
void meet(const PeerOptions& options, const Terms& terms, PeerNetwork& network) {
  if (options.join.empty()) {
    network.found(terms);
  } else {
    const auto [address, port] = address_and_port("--join", options.join);
    network.join({address, port});
    if (network.members().empty())
      std::printf("peer %u of %u\n", network.number(), network.terms().peer_count);
    else std::printf("peer %u, beside %zu who play\n", network.number(), network.members().size());
    std::fflush(stdout);
  }
  if (network.members().empty()) network.gather();
  std::printf("playing\n");
  std::fflush(stdout);
  if (network.terms().is_seated && options.bots > 0)
    throw SessionError(ExitStatus::not_admitted,
                       "--bots: the peers there are --seated, each with the player in its zone: "
                       "expected no --bots");
}

/// Maps simulated time to the clock, from the first request on if no start is given.
class Pace {
 public:
  explicit Pace(std::optional<double> offset_s) : offset_s_(offset_s) {}
  double clock_s(double time) {
    if (!offset_s_) offset_s_ = now_s() - time;
    return *offset_s_ + time;
  }

 private:
  std::optional<double> offset_s_;
};

PlayedPart play(const PeerOptions& options, SharedGame& shared, PeerNetwork& network,
                const Viewing& viewing, double start_s) {
  // A peer that measures the age of windows plays each when its end has come, as a server plays its
  // ticks.
  Pace pace(viewing.recorder ? std::optional(start_s + network.terms().window) : std::nullopt);
  PartOptions part_options{.players = options.players,
                           .before_window = {},
                           .wants_to_leave = [] { return is_interrupted != 0; },
                           .notify = [](const std::string& what) { warn(what); },
                           .members = network.members(),
                           .when_taken = {},
                           .observer = viewing.viewer.get()};
  // A viewer that shows others' bodies looks up their kinds in the start.
  if (!viewing.viewer) part_options.when_taken = [&shared] { shared.forget_start(); };
  part_options.before_window = [&](double time) {
    network.note_window();
    if (options.pace == "realtime") network.rest_until(pace.clock_s(time));
  };
  peer::Mail& mail = viewing.recorder ? viewing.recorder->mail() : network;
  return shared.play(network.terms(), network.peer_infos(), network.number(), mail, part_options);
}

Json whole_report(const PlayedPart& part, const PeerNetwork& network, const Viewing& viewing,
                  double playing_s) {
  Json report =
      report_of(part, network, network.peer_infos()[network.number()].bat_count, playing_s);
  if (viewing.viewer) report["view"] = report_of(*viewing.viewer);
  report[report::transport] = report_of(network.transported());
  if (!part.has_left) add_hash(report, part);
  return report;
}

/// Writes the results of a run; those that cannot be recomputed come first in case a file cannot be
/// written.
ExitStatus leave_behind(const PeerOptions& options, const SharedGame& shared,
                        const PlayedPart& part, const Json& report) {
  if (!options.report.empty()) write_file(options.report, report.dump(2));
  else std::printf("%s\n", report.dump(2).c_str());
  const bool is_told = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (!is_told) complain("the report could not be written to the standard output");
  if (!part.has_left) write_record(options, shared, part);
  if (part.may_have_split && !part.has_left) {
    warn(
        "this peer went on alone, and the other may have done so too: the hash is that of one "
        "part");
    return ExitStatus::may_have_split;
  }
  return part.has_left ? ExitStatus::interrupted : is_told ? ExitStatus::ok : ExitStatus::failed;
}

/// Runs the whole session; connected peers are sent the reason of an early end. Throws
/// peer::SentAway for a newcomer that may try again.
ExitStatus share(const PeerOptions& options, const Terms& terms, SharedGame& shared,
                 PeerNetwork& network) {
  try {
    meet(options, terms, network);
    const Viewing viewing = make_viewing(shared, network, options.viewing, now_s);
    const double start_s =
        network.terms().starts_together ? start_together(network, now_s) : now_s();
    if (viewing.recorder) viewing.recorder->start_at(start_s);
    network.begin();
    const PlayedPart part = play(options, shared, network, viewing, start_s);
    const double playing_s = now_s() - start_s;
    if (viewing.recorder) write_trace(options.viewing.trace, viewing.recorder->trace());
    network.leave({});
    if (part.has_left)
      warn("interrupted at ", std::setprecision(9), part.time, " s: ",
           part.was_last ? "nobody was left to go on" : "all that this peer had is with others");
    return leave_behind(options, shared, part, whole_report(part, network, viewing, playing_s));
  } catch (const SessionError& error) {
    complain(error.what());
    network.leave({error.status() == ExitStatus::interrupted ? FarewellKind::interrupted
                                                             : FarewellKind::trouble,
                   error.what()});
    return error.status();
  } catch (const peer::SentAway&) {
    network.abandon();
    throw;
  } catch (const peer::Halt& halt) {
    complain(halt.what());
    network.leave({FarewellKind::trouble, halt.what()});
    return ExitStatus::connection_lost;
  } catch (const peer::ProtocolError& error) {
    complain(error.what());
    network.leave({FarewellKind::trouble, error.what()});
    return ExitStatus::failed;
  }
}

/// A match is small, and each peer plays the whole of one: they tell each other keys alone.
bool is_match(const PeerOptions& options, const SharedGame& shared) {
  return options.transport != "mpi" && !shared.has_keys() && !match_objection(shared.scene());
}

void require_match_options(const PeerOptions& options) {
  if (!options.terms.interest.scheme.empty() || options.terms.is_seated ||
      !options.viewing.trace.empty() || !options.viewing.always.empty())
    throw std::invalid_argument("--scheme, --always, --seated, --evidence: in a match, scene '" +
                                options.scene +
                                "', every peer has all bodies: expected none of these");
  for (const std::string flag :
       {"--balance", "--policy", "--cell-size", "--view", "--view-area", "--view-margin"})
    if (options.given.count(flag) != 0)
      throw std::invalid_argument(flag + ": in a match, scene '" + options.scene +
                                  "', every peer has all bodies: expected no " + flag);
  if (options.pace != "realtime" && options.given.count("--pace") != 0)
    throw std::invalid_argument("--pace: a match, scene '" + options.scene +
                                "', goes by the clock: expected realtime, not '" + options.pace +
                                "'");
}

std::unique_ptr<Meeting> meeting_of_match(const PeerOptions& options) {
  const Place place = listening_place(options.listen, options.join, options.transport == "tcp");
  if (!options.join.empty()) {
    const auto [address, port] = address_and_port("--join", options.join);
    return std::make_unique<SocketMeeting>(place, Place{address, port}, options.transport);
  }
  Terms terms = terms_of_matches(options.terms.peer_count, options.terms.window);
  terms.until = options.terms.until;
  terms.is_replicated = options.terms.is_replicated;
  return std::make_unique<SocketMeeting>(place, terms, options.transport);
}

Json report_of_match(const PlayedPart& part, const Node& node, const MatchBots& bots,
                     double playing_s) {
  std::uint64_t sent = 0;
  for (const rti::TransportCounters& to : node.sent()) sent += to.bytes_sent;
  Json report{{"peer", node.number()},
              {"peers", part.members},
              {"time", part.time},
              {"goals_left", part.score.left},
              {"goals_right", part.score.right},
              {"keys", part.keys.size()},
              {"key_presses", bots.presses()},
              {report::bytes_sent, sent},
              {"wall_s", playing_s},
              {"cpu_s", processor_s()},
              {report::rss_bytes, resident_bytes()},
              {"lost", part.lost}};
  add_hash(report, part);
  return report;
}

/// To the end of the first match, or from match to match if the first peer's terms are so.
ExitStatus play_match(const PeerOptions& options, SharedGame& shared) {
  require_match_options(options);
  const std::unique_ptr<Meeting> meeting = meeting_of_match(options);
  std::printf("listening on %s\n", meeting->place().value_or(Place{}).text().c_str());
  std::fflush(stdout);
  Node node(shared, *meeting,
            {.patience_s = options.patience_s,
             .gathering_s = std::numeric_limits<double>::infinity(),
             .hosting = FlowTimes{},
             .notify = [](const std::string& what) { warn(what); }},
            now_s);
  const auto rest = [] { std::this_thread::sleep_for(std::chrono::milliseconds(2)); };
  node.meet();
  if (!options.join.empty()) std::printf("peer %u of %u\n", node.number(), node.terms().peer_count);
  while (!node.may_begin()) rest();
  node.begin();
  std::printf("playing\n");
  std::fflush(stdout);
  const double begun_s = now_s();
  MatchBots bots(shared.scene(), node,
                 {.count = options.bots,
                  .kinds = options.players,
                  .seed = shared.scene().seed,
                  .window = node.terms().window});
  for (; !node.has_ended(); rest()) {
    bots.look();
    if (bots.state().number == 0 && now_s() > begun_s + options.patience_s)
      throw SessionError(ExitStatus::nobody_came,
                         "the match's two players did not come within " +
                             std::to_string(std::lround(options.patience_s)) + " s");
  }
  const PlayedPart& part = node.finish();
  return leave_behind(options, shared, part, report_of_match(part, node, bots, now_s() - begun_s));
}

ExitStatus run(const PeerOptions& options, RankCommand& command) {
  const RecordFile record("--record", options.record);
  require_writable("--report", options.report);
  require_writable("--evidence", options.viewing.trace);
  if (!options.viewing.trace.empty() && (options.pace != "realtime" || options.transport == "mpi"))
    throw std::invalid_argument(
        "--evidence: latencies are those of the clock: expected --pace realtime, and no mpi");
  if (options.transport == "mpi") return share_among_ranks(options, command);
  SharedGame shared = game_of(options);
  if (options.join.empty()) shared.require_window(options.terms.window);
  if (options.bots > shared.bat_count())
    throw std::invalid_argument("--bots: " + std::to_string(options.bots) +
                                " wanted, the scene has " + std::to_string(shared.bat_count()) +
                                " bats");
  if (is_match(options, shared)) return play_match(options, shared);
  shared.require_divisible();
  require_viewing(options.terms, options.viewing, shared, options.bots);
  if (options.bots > 0 && shared.has_keys())
    throw std::invalid_argument(
        "--bots: the scene or the key log has keys already, and nobody can play beside them");
  Terms terms = options.terms;
  terms.interest.always = relevant_kinds_of(shared.scene(), options.viewing.always).bits();
  terms.starts_together = !options.viewing.trace.empty();
  Place place = listening_place(options.listen, options.join, options.transport == "tcp");
  rti::SocketTransport sockets(options.transport);
  place.port = sockets.listen(place.address, place.port);
  std::printf("listening on %s\n", place.text().c_str());
  std::fflush(stdout);
  for (int tries = 1;; ++tries) {
    const PeerInfo self{.place = place,
                        .bat_count = options.bots,
                        .puck_count = Crowd::pucks_wanted(shared.scene(), options.players),
                        .token = unguessable_number()};
    PeerNetwork network(sockets,
                        {.self = self,
                         .bats = shared.bat_count(),
                         .session_fingerprint = shared.session_fingerprint(),
                         .session = unguessable_number(),
                         .patience_s = options.patience_s},
                        now_s);
    try {
      return share(options, terms, shared, network);
    } catch (const peer::SentAway& sent) {
      constexpr int tries_max = 10;
      warn(sent.what(), "; ", tries < tries_max ? "asking again" : "that was the last try");
      if (tries == tries_max) return ExitStatus::not_admitted;
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      if (!shared.has_start()) shared = game_of(options);
    }
  }
}

int status_of(const std::exception& error) {
  if (const auto status = session_status(error)) return static_cast<int>(*status);
  return static_cast<int>(exit_status(error, {.bad_address = ExitStatus::address_in_use,
                                              .too_many_files = ExitStatus::failed,
                                              .otherwise = ExitStatus::failed}));
}

}  // namespace
}  // namespace rink::game

int main(int count, char** words) {
  using namespace rink::game;
  speak_as("rink-peer");
  Flags flags;
  flags.version(version_line("rink-peer"));
  PeerOptions options;
  add_options(flags, options);
  return run_command(flags, count, words,
                     {.run =
                          [&] {
                            options.given = flags.given();
                            RankCommand command(status_of);
                            return command.run([&] { return run(options, command); });
                          },
                      .status_of = status_of});
}
