// rink peer: one of the processes that share a simulation without a server, equal to one engine's
// bit for bit.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <thread>

#include "game/apps/command.h"
#include "game/apps/peer_flags.h"
#include "game/apps/peer_ranks.h"
#include "game/apps/peer_report.h"
#include "game/control/key_log_file.h"
#include "game/model/report_fields.h"
#include "game/model/scene_file.h"
#include "game/net/address.h"
#include "game/net/exit_status.h"
#include "game/net/interrupt.h"
#include "game/net/peer/crowd.h"
#include "game/net/peer/meeting/listening_place.h"
#include "game/net/peer/meeting/meeting.h"
#include "game/net/peer/shared_game.h"
#include "game/net/record_file.h"
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

/// Until all who begin are there, or those who play already have told us of each other.
void meet(const PeerOptions& options, const Terms& terms, Meeting& meeting) {
  if (options.join.empty()) {
    meeting.found(terms);
  } else {
    const auto [address, port] = address_and_port("--join", options.join);
    meeting.join({address, port});
    if (meeting.members().empty())
      std::printf("peer %u of %u\n", meeting.number(), meeting.terms().peer_count);
    else std::printf("peer %u, beside %zu who play\n", meeting.number(), meeting.members().size());
    std::fflush(stdout);
  }
  if (meeting.members().empty()) meeting.gather();
  std::printf("playing\n");
  std::fflush(stdout);
  if (meeting.terms().is_seated && options.bots > 0)
    throw Parting(ExitStatus::not_admitted,
                  "--bots: the peers there are --seated, each with the player in its zone: "
                  "expected no --bots");
}

/// When the clock shows that simulated time, if need be from the first time that is asked for on.
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

PlayedPart play(const PeerOptions& options, SharedGame& shared, Meeting& meeting,
                const Viewing& viewing, double start_s) {
  // Whoever measures how old a window is when it is known plays it when its end has come, as a
  // server its ticks.
  Pace pace(viewing.witness ? std::optional(start_s + meeting.terms().window) : std::nullopt);
  Manner manner{.players = options.players,
                .before_window = {},
                .wants_to_leave = [] { return is_interrupted != 0; },
                .tell = [](const std::string& what) { warn(what); },
                .members = meeting.members(),
                .when_taken = {},
                .listener = viewing.viewer.get()};
  // Who shows what others have looks up there what bodies are.
  if (!viewing.viewer) manner.when_taken = [&shared] { shared.forget_start(); };
  manner.before_window = [&](double time) {
    meeting.note_window();
    if (options.pace == "realtime") meeting.rest_until(pace.clock_s(time));
  };
  peer::Mail& mail = viewing.witness ? viewing.witness->mail() : meeting;
  return shared.play(meeting.terms(), meeting.guests(), meeting.number(), mail, manner);
}

Json whole_report(const PlayedPart& part, const Meeting& meeting, const Viewing& viewing,
                  double playing_s) {
  Json report = report_of(part, meeting, meeting.guests()[meeting.number()].bat_count, playing_s);
  if (viewing.viewer) report["view"] = report_of(*viewing.viewer);
  report[report::transport] = report_of(meeting.transported());
  if (!part.has_left) add_hash(report, part);
  return report;
}

/// What a run leaves, of which what cannot be had again comes first should a file refuse.
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

/// From the first word to the last; a connected peer learns why it ends early. Throws
/// peer::SentAway of a newcomer that may ask again.
ExitStatus share(const PeerOptions& options, const Terms& terms, SharedGame& shared,
                 Meeting& meeting) {
  try {
    meet(options, terms, meeting);
    const Viewing viewing = make_viewing(shared, meeting, options.viewing, now_s);
    const double start_s =
        meeting.terms().starts_together ? start_together(meeting, now_s) : now_s();
    if (viewing.witness) viewing.witness->start_at(start_s);
    meeting.begin();
    const PlayedPart part = play(options, shared, meeting, viewing, start_s);
    const double playing_s = now_s() - start_s;
    if (viewing.witness) write_evidence(options.viewing.evidence, viewing.witness->evidence());
    meeting.leave({});
    if (part.has_left)
      warn("interrupted at ", std::setprecision(9), part.time, " s: ",
           part.was_last ? "nobody was left to go on" : "all that this peer had is with others");
    return leave_behind(options, shared, part, whole_report(part, meeting, viewing, playing_s));
  } catch (const Parting& parting) {
    complain(parting.what());
    meeting.leave({parting.status() == ExitStatus::interrupted ? FarewellKind::interrupted
                                                               : FarewellKind::trouble,
                   parting.what()});
    return parting.status();
  } catch (const peer::SentAway&) {
    meeting.abandon();
    throw;
  } catch (const peer::Halt& halt) {
    complain(halt.what());
    meeting.leave({FarewellKind::trouble, halt.what()});
    return ExitStatus::connection_lost;
  } catch (const peer::ProtocolError& error) {
    complain(error.what());
    meeting.leave({FarewellKind::trouble, error.what()});
    return ExitStatus::failed;
  }
}

ExitStatus run(const PeerOptions& options) {
  const RecordFile record("--record", options.record);
  require_writable("--report", options.report);
  require_writable("--evidence", options.viewing.evidence);
  if (!options.viewing.evidence.empty() &&
      (options.pace != "realtime" || options.transport == "mpi"))
    throw std::invalid_argument(
        "--evidence: latencies are those of the clock: expected --pace realtime, and no mpi");
  if (options.transport == "mpi") return share_among_ranks(options);
  SharedGame shared = game_of(options);
  if (options.join.empty()) shared.require_window(options.terms.window);
  if (options.bots > shared.bat_count())
    throw std::invalid_argument("--bots: " + std::to_string(options.bots) +
                                " wanted, the scene has " + std::to_string(shared.bat_count()) +
                                " bats");
  require_viewing(options.terms, options.viewing, shared, options.bots);
  if (options.bots > 0 && shared.has_keys())
    throw std::invalid_argument(
        "--bots: the scene or the key log has keys already, and nobody can play beside them");
  Terms terms = options.terms;
  terms.interest.always = relevant_kinds_of(shared.scene(), options.viewing.always).bits();
  terms.starts_together = !options.viewing.evidence.empty();
  Place place = listening_place(options.listen, options.join, options.transport == "tcp");
  rti::SocketTransport sockets(options.transport);
  place.port = sockets.listen(place.address, place.port);
  std::printf("listening on %s\n", place.text().c_str());
  std::fflush(stdout);
  const auto unpredictable_number = [] {
    std::random_device device;
    const std::uint64_t upper = device();
    return upper << 32 | device();
  };
  for (int tries = 1;; ++tries) {
    const Guest self{.place = place,
                     .bat_count = options.bots,
                     .puck_count = Crowd::pucks_wanted(shared.scene(), options.players),
                     .token = unpredictable_number()};
    Meeting meeting(sockets,
                    {.self = self,
                     .bats = shared.bat_count(),
                     .luggage = shared.luggage(),
                     .session = unpredictable_number(),
                     .patience_s = options.patience_s},
                    now_s);
    try {
      return share(options, terms, shared, meeting);
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
                            options.says_peers = flags.is_given("--peers");
                            return static_cast<int>(run(options));
                          },
                      .status_of = status_of});
}
