// rink peer: one of the processes that share a simulation without a server, equal to one engine's
// bit for bit.
#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <thread>

#include "game/control/key_log.h"
#include "game/control/seed_flag.h"
#include "game/model/scene_file.h"
#include "game/net/address.h"
#include "game/net/exit_status.h"
#include "game/net/flags.h"
#include "game/net/interrupt.h"
#include "game/net/peer/crowd.h"
#include "game/net/peer/interest/viewing_options.h"
#include "game/net/peer/meeting/listening_place.h"
#include "game/net/peer/meeting/meeting.h"
#include "game/net/peer/meeting/rank_mail.h"
#include "game/net/peer/shared_game.h"
#include "game/net/record_file.h"
#include "game/net/scene_choice.h"
#include "game/net/speak_as.h"
#include "game/version/version.h"

namespace {

using namespace rink;
using Json = nlohmann::ordered_json;

struct Options {
  std::string scene, keys, listen, join, record, report, pace = "free", transport = "tcp";
  std::vector<std::string> players{"chaser"};
  std::uint64_t seed = 0;
  std::uint32_t bats = 0, bat_count = 0, puck_count = 0, bots = 0;
  bool says_peers = false;  ///< --peers was given
  double patience_s = 30.0;
  game::Terms terms{.peer_count = 2, .until = 10.0, .window = 0.02, .balance_windows = 25};
  game::ViewingOptions viewing;
};

double now_s() {
  return 1e-9 * static_cast<double>(std::chrono::duration_cast<std::chrono::nanoseconds>(
                                        std::chrono::steady_clock::now().time_since_epoch())
                                        .count());
}

double processor_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string player_names() {
  std::string names;
  for (const std::string& name : game::player_kinds()) names += ", " + name;
  return names;
}

game::SharedGame game_of(const Options& options) {
  game::Scene scene = game::chosen_scene({.scene = options.scene,
                                          .bats = options.bats,
                                          .bat_count = options.bat_count,
                                          .puck_count = options.puck_count,
                                          .seed = options.seed});
  std::vector<game::InputEvent> recorded;
  if (!options.keys.empty()) {
    game::KeyLog log = game::read_key_log(std::filesystem::path(options.keys));
    game::require_fit(log, scene, options.keys);
    recorded = std::move(log.events);
  }
  return game::SharedGame(std::move(scene), recorded);
}

/// Goes last, where readers look for it.
void add_hash(Json& report, const game::PlayedPart& part) {
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016" PRIx64, part.hash);
  report["hash"] = hash;
}

/// Of a part that was played among those who met, by whichever transport; without the hash.
template <class Meeting>
Json report_of(const game::PlayedPart& part, const Meeting& meeting, std::uint32_t bots,
               double playing_s) {
  const peer::PeerCounters& counters = part.counters.peer;
  return {{"peer", meeting.number()},
          {"peers", part.members},
          {"time", part.time},
          {"windows", counters.windows},
          {"repeats", counters.repeats},
          {"owned", part.owned},
          {"ghosts", part.ghosts},
          {"mean_ghosts",
           static_cast<double>(counters.ghost_windows) / static_cast<double>(counters.windows + 1)},
          {"held_max", counters.held_max},
          {"halo", part.halo},
          {"own_events", counters.own_events},
          {"ghost_events", counters.ghost_events},
          {"hand_overs", counters.hand_overs},
          {"bots", bots},
          {"key_presses", part.presses},
          {"arrival_bytes", counters.arrival_bytes},
          {"claim_bytes", counters.claim_bytes},
          {"verdict_bytes", counters.verdict_bytes},
          {"result_bytes", part.result_bytes},
          {"bytes_sent", meeting.bytes_sent()},
          {"strangers_dismissed", meeting.dismissed()},
          {"wall_s", playing_s},
          {"cpu_s", processor_s()},
          {"rss_bytes", game::resident_bytes()},
          {"lost", part.lost},
          {"recoveries", part.counters.recoveries},
          {"shifts", part.counters.shifts},
          {"mirror_bytes", part.counters.mirror_bytes},
          {"recovery_bytes", part.counters.recovery_bytes},
          {"entry_bytes", part.counters.entry_bytes}};
}

void write_record(const Options& options, const game::SharedGame& shared,
                  const game::PlayedPart& part) {
  if (options.record.empty()) return;
  game::write_key_log(std::filesystem::path(options.record),
                      shared.record_of(part, game::scene_text(options.scene)));
}

/// Until all who begin are there, or those who play already have told us of each other.
void meet(const Options& options, const game::Terms& terms, game::Meeting& meeting) {
  if (options.join.empty()) {
    meeting.found(terms);
  } else {
    const auto [address, port] = game::address_and_port("--join", options.join);
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
    throw game::Parting(game::ExitStatus::not_admitted,
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

game::PlayedPart play(const Options& options, game::SharedGame& shared, game::Meeting& meeting,
                      const game::Viewing& viewing, double start_s) {
  // Whoever measures how old a window is when it is known plays it when its end has come, as a
  // server its ticks.
  Pace pace(viewing.witness ? std::optional(start_s + meeting.terms().window) : std::nullopt);
  game::Manner manner{.players = options.players,
                      .before_window = {},
                      .wants_to_leave = [] { return game::is_interrupted != 0; },
                      .tell = [](const std::string& what) { spdlog::warn("{}", what); },
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

/// What a run leaves, of which what cannot be had again comes first should a file refuse.
game::ExitStatus report(const Options& options, const game::SharedGame& shared,
                        const game::Meeting& meeting, const game::Viewing& viewing,
                        const game::PlayedPart& part, double playing_s) {
  Json report = report_of(part, meeting, meeting.guests()[meeting.number()].bat_count, playing_s);
  if (viewing.viewer) report["view"] = game::report_of(*viewing.viewer);
  report["transport"] = game::report_of(meeting.transported());
  if (!part.has_left) add_hash(report, part);
  if (!options.report.empty()) game::write_file(options.report, report.dump(2));
  else std::printf("%s\n", report.dump(2).c_str());
  const bool is_told = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (!is_told) spdlog::error("the report could not be written to the standard output");
  if (!part.has_left) write_record(options, shared, part);
  if (part.may_have_split && !part.has_left) {
    spdlog::warn(
        "this peer went on alone, and the other may have done so too: the hash is that of one "
        "part");
    return game::ExitStatus::may_have_split;
  }
  return part.has_left ? game::ExitStatus::interrupted
         : is_told     ? game::ExitStatus::ok
                       : game::ExitStatus::failed;
}

/// From the first word to the last; whoever is connected is told why it ends early. Throws
/// peer::SentAway of a newcomer that may ask again.
game::ExitStatus share(const Options& options, const game::Terms& terms, game::SharedGame& shared,
                       game::Meeting& meeting) {
  try {
    meet(options, terms, meeting);
    const game::Viewing viewing = game::make_viewing(shared, meeting, options.viewing, now_s);
    const double start_s =
        meeting.terms().starts_together ? game::start_together(meeting, now_s) : now_s();
    if (viewing.witness) viewing.witness->start_at(start_s);
    meeting.begin();
    const game::PlayedPart part = play(options, shared, meeting, viewing, start_s);
    const double playing_s = now_s() - start_s;
    if (viewing.witness)
      game::write_evidence(options.viewing.evidence, viewing.witness->evidence());
    meeting.leave({});
    if (part.has_left)
      spdlog::warn(
          "interrupted at {:.9g} s: {}", part.time,
          part.was_last ? "nobody was left to go on" : "all that this peer had is with others");
    return report(options, shared, meeting, viewing, part, playing_s);
  } catch (const game::Parting& parting) {
    spdlog::error("{}", parting.what());
    meeting.leave({parting.status() == game::ExitStatus::interrupted
                       ? game::FarewellKind::interrupted
                       : game::FarewellKind::trouble,
                   parting.what()});
    return parting.status();
  } catch (const peer::SentAway&) {
    meeting.abandon();
    throw;
  } catch (const peer::Halt& halt) {
    spdlog::error("{}", halt.what());
    meeting.leave({game::FarewellKind::trouble, halt.what()});
    return game::ExitStatus::connection_lost;
  } catch (const peer::ProtocolError& error) {
    spdlog::error("{}", error.what());
    meeting.leave({game::FarewellKind::trouble, error.what()});
    return game::ExitStatus::failed;
  }
}

/// Looks again at once as long as an answer may be a matter of microseconds, then leaves the
/// processor to others, of whom there may be more than processors.
void wait_for_ranks(std::uint32_t looks) {
  if (looks < 64) return;
  if (looks < 256) return std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::microseconds(20));
}

/// What each rank did, told by the first one.
void report_ranks(const Json& own, game::RankMail& mail) {
  const std::string text = own.dump();
  if (mail.number() != 0) return mail.send(0, {text.begin(), text.end()});
  Json all = {{"peers", mail.terms().peer_count},
              {"time", own["time"]},
              {"collectives", mail.collectives()},
              {"hash", own["hash"]},
              {"ranks", Json::array({own})}};
  for (peer::PeerNumber from = 1; from < mail.terms().peer_count; ++from)
    all["ranks"].push_back(Json::parse(mail.receive(from)));
  std::printf("%s\n", all.dump(2).c_str());
}

/// The whole part of one rank; a rank that must end early ends all.
game::ExitStatus share_among_ranks(Options options) {
  if (!options.join.empty() || !options.listen.empty() || options.says_peers)
    throw std::invalid_argument(
        "--listen, --join, --peers: with --transport mpi the launcher says how many there are and "
        "brings them together (mpirun -np 4): expected none of these");
  if (options.bots > 0 || !options.record.empty() || options.pace != "free" ||
      options.terms.is_seated || options.terms.interest.is_wanted())
    throw std::invalid_argument(
        "--bots, --record, --pace, --scheme, --seated: ranks of --transport mpi only compute, as "
        "fast as they can: expected none of these");
  game::SharedGame shared = game_of(options);
  rti::Ranks ranks;
  options.terms.peer_count = ranks.count();
  options.terms.balance_windows = 0;  // zones stay: ranks have said nothing of that to each other
  options.terms.is_mirrored = false;  // MPI ends all of them if one is lost
  game::RankMail mail(ranks, options.patience_s, now_s, wait_for_ranks);
  try {
    mail.agree(shared.luggage(), options.terms);
  } catch (const game::Parting& parting) {
    if (ranks.number() == 0) spdlog::error("{}", parting.what());
    if (parting.status() != game::ExitStatus::wrong_version &&
        parting.status() != game::ExitStatus::not_admitted)
      ranks.abort(static_cast<int>(parting.status()));
    ranks.finish();
    return parting.status();
  }
  try {
    const double start_s = now_s();
    const game::Manner manner{.players = options.players,
                              .before_window = {},
                              .wants_to_leave = {},
                              .tell = {},
                              .when_taken = [&shared] { shared.forget_start(); }};
    const game::PlayedPart part = shared.play(
        options.terms, std::vector<game::Guest>(ranks.count()), mail.number(), mail, manner);
    Json report = report_of(part, mail, 0, now_s() - start_s);
    add_hash(report, part);
    report_ranks(report, mail);
    mail.flush();
    ranks.finish();
    return game::ExitStatus::ok;
  } catch (const game::Parting& parting) {
    spdlog::error("rank {}: {}", mail.number(), parting.what());
    ranks.abort(static_cast<int>(parting.status()));
  } catch (const peer::ProtocolError& error) {
    spdlog::error("rank {}: {}", mail.number(), error.what());
    ranks.abort(static_cast<int>(game::ExitStatus::failed));
  }
}

game::ExitStatus run(const Options& options) {
  const game::RecordFile record("--record", options.record);
  game::require_writable("--report", options.report);
  game::require_writable("--evidence", options.viewing.evidence);
  if (!options.viewing.evidence.empty() &&
      (options.pace != "realtime" || options.transport == "mpi"))
    throw std::invalid_argument(
        "--evidence: latencies are those of the clock: expected --pace realtime, and no mpi");
  if (options.transport == "mpi") return share_among_ranks(options);
  game::SharedGame shared = game_of(options);
  if (options.join.empty()) shared.require_window(options.terms.window);
  if (options.bots > shared.bat_count())
    throw std::invalid_argument("--bots: " + std::to_string(options.bots) +
                                " wanted, the scene has " + std::to_string(shared.bat_count()) +
                                " bats");
  game::require_viewing(options.terms, options.viewing, shared, options.bots);
  if (options.bots > 0 && shared.has_keys())
    throw std::invalid_argument(
        "--bots: the scene or the key log has keys already, and nobody can play beside them");
  game::Terms terms = options.terms;
  terms.interest.always = game::relevant_kinds_of(shared.scene(), options.viewing.always).bits();
  terms.starts_together = !options.viewing.evidence.empty();
  game::Place place =
      game::listening_place(options.listen, options.join, options.transport == "tcp");
  rti::SocketTransport sockets(options.transport);
  place.port = sockets.listen(place.address, place.port);
  std::printf("listening on %s\n", place.text().c_str());
  std::fflush(stdout);
  const auto number_that_nobody_guesses = [] {
    std::random_device device;
    const std::uint64_t upper = device();
    return upper << 32 | device();
  };
  for (int tries = 1;; ++tries) {
    const game::Guest self{.place = place,
                           .bat_count = options.bots,
                           .puck_count = game::Crowd::pucks_wanted(shared.scene(), options.players),
                           .token = number_that_nobody_guesses()};
    game::Meeting meeting(sockets,
                          {.self = self,
                           .bats = shared.bat_count(),
                           .luggage = shared.luggage(),
                           .session = number_that_nobody_guesses(),
                           .patience_s = options.patience_s},
                          now_s);
    try {
      return share(options, terms, shared, meeting);
    } catch (const peer::SentAway& sent) {
      constexpr int tries_max = 10;
      spdlog::warn("{}; {}", sent.what(),
                   tries < tries_max ? "asking again" : "that was the last try");
      if (tries == tries_max) return game::ExitStatus::not_admitted;
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      if (!shared.has_start()) shared = game_of(options);
    }
  }
}

game::ExitStatus run_or_explain(const Options& options) {
  try {
    return run(options);
  } catch (const rti::TransportError& error) {
    spdlog::error("{}", error.what());
    using Kind = rti::TransportError::Kind;
    return error.kind() == Kind::in_use || error.kind() == Kind::no_such_address ||
                   error.kind() == Kind::no_permission
               ? game::ExitStatus::address_in_use
               : game::ExitStatus::failed;
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return game::ExitStatus::bad_input;
  }
}

void add_options(CLI::App& app, Options& options) {
  app.description(
      "One of the peers that share a simulation without a server: each owns and simulates the "
      "bodies in its part of the field, and all together have, bit for bit, what\n"
      "one engine has. The first one says how many begin and how long they play; all others join "
      "through any that is there, before the start or while they play. In the\n"
      "end each prints what it did and the hash of the whole, which is that of rink simulate.");
  app.name("rink peer");
  app.add_option("--scene", options.scene, "a scene file or the name of a preset; the same for all")
      ->required();
  app.add_option(
      "--keys", options.keys,
      "a recorded key log to play, the same for all (default: the scene's scripted keys only)");
  app.add_option("--bots", options.bots,
                 "how many bats this peer plays, the next ones that are free; 0: it only computes")
      ->check(CLI::Range(0u, game::bats_max))
      ->capture_default_str();
  app.add_option("--players", options.players,
                 "who plays them, in turn, separated by commas: random" + player_names() +
                     "; seeded like the scene")
      ->delimiter(',')
      ->check([](const std::string& name) {
        return game::is_player_kind(name)
                   ? std::string()
                   : "'" + name + "' is no player: expected random" + player_names();
      })
      ->capture_default_str();
  app.add_option("--pace", options.pace, "realtime: by the clock; free: as fast as they can")
      ->check(CLI::IsMember({"realtime", "free"}))
      ->capture_default_str();
  app.add_option("--record", options.record,
                 "write everybody's keys and the final hash to this key log; rink replay plays it "
                 "again, and so does rink simulate --keys");
  app.add_option("--report", options.report,
                 "file for what this peer did, as JSON (default: the standard output)");
  app.add_option("--seed", options.seed, "seed of the scene's populations; 0: the scene's own")
      ->check(game::seed_number())
      ->capture_default_str();
  app.add_option("--bats", options.bats,
                 "scale the crowd to so many bats at constant density; 0: as it is")
      ->check(CLI::Range(0u, game::bats_max))
      ->capture_default_str();
  app.add_option("--bat-count", options.bat_count,
                 "so many bats on the scene's own field; 0: as it is")
      ->check(CLI::Range(0u, game::bats_max))
      ->capture_default_str();
  app.add_option("--puck-count", options.puck_count, "likewise pucks")
      ->check(CLI::Range(0u, game::pucks_max))
      ->capture_default_str();
  app.add_option("--listen", options.listen,
                 "where others reach this peer; port 0 takes any free one (default of those who "
                 "join a peer of this machine: 127.0.0.1:0)")
      ->type_name("ADDRESS:PORT");
  CLI::Option* join =
      app.add_option("--join", options.join,
                     "any peer that is there already; without this, become the first one")
          ->type_name("HOST:PORT");
  app.add_option("--peers", options.terms.peer_count,
                 "how many are waited for before the start, while more may come later; the first "
                 "peer's to say")
      ->check(CLI::Range(1u, game::peers_max))
      ->excludes(join)
      ->capture_default_str();
  app.add_option("--until", options.terms.until,
                 "simulated time at which to stop [s]; the first peer's to say")
      ->check(game::number_from(1e-6, game::seconds_max))
      ->excludes(join)
      ->capture_default_str();
  app.add_option("--window", options.terms.window,
                 "simulated time from one agreement to the next [s]; the first peer's to say")
      ->check(game::number_from(1e-4, 10.0))
      ->excludes(join)
      ->capture_default_str();
  app.add_option("--balance", options.terms.balance_windows,
                 "after so many windows zones shift toward equal numbers of events, if these are "
                 "uneven; 0: they stay; the first peer's to say")
      ->check(CLI::Range(0u, 1'000'000u))
      ->excludes(join)
      ->capture_default_str();
  app.add_flag("!--unmirrored", options.terms.is_mirrored,
               "no peer keeps another's part: who is lost or interrupted ends all, and nobody "
               "joins later; the first peer's to say")
      ->excludes(join);
  game::add_viewing_options(app, options.viewing, options.terms, join);
  app.add_option(
         "--transport", options.transport,
         "what carries the bytes: tcp; shm between processes of this machine, where a port is a "
         "name; or mpi between the ranks of an mpirun, which all are peers; the same for all")
      ->check(CLI::IsMember({"tcp", "shm", "mpi"}))
      ->capture_default_str();
  app.add_option("--patience", options.patience_s,
                 "how long a peer whose word is due may be silent [s]")
      ->check(game::number_from(0.1, game::seconds_max))
      ->capture_default_str();
  app.footer(
      "Example, in two terminals:\n  ./rink peer --scene arena --peers 2 --until 5 --listen "
      "127.0.0.1:4800\n  ./rink peer --scene arena --join 127.0.0.1:4800\n"
      "As ranks of MPI (docs/cluster.md):\n  mpirun -np 4 --oversubscribe build/bin/rink-peer "
      "--transport mpi --scene arena --until 5\n"
      "Exit status: 0 done, 1 failed or a peer that said what cannot be, 2 bad flag or file, 10 "
      "address in use, 11 no peer there, 12 wrong protocol version, 14 not let in,\n"
      "16 a peer is gone, 130 interrupted.");
}

}  // namespace

int main(int count, char** values) {
  game::speak_as("rink-peer");
  CLI::App app;
  app.set_version_flag("--version", game::version_line("rink-peer"));
  Options options;
  add_options(app, options);
  try {
    app.parse(count, values);
    options.says_peers = app.count("--peers") > 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(game::ExitStatus::bad_input);
  }
  game::hear_interrupts();
  return static_cast<int>(run_or_explain(options));
}
