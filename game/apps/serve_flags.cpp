// Defines the flags of rink serve and its help text.
#include "game/apps/serve_flags.h"

#include "game/net/exit_status.h"
#include "game/net/limits.h"
#include "game/net/relevant_kinds.h"
#include "im/filter.h"
#include "rti/transport/socket_transport.h"

namespace rink::game {

void add_options(Flags& flags, ServeOptions& options) {
  flags.description(
      "The server federate: simulates a scene exactly and tells each client what lies in its "
      "interest.");
  flags.footer(std::string("Example: rink serve --scene crowd --clients 100 --scheme region "
                           "--duration 30 --report server.json\n\n") +
               exit_status_help);
  flags.name("rink serve");
  flags.option("match", options.hosted,
               "host matches of this scene, one after the other, until interrupted: on-event, 60 "
               "ticks per second unless said otherwise (docs/play.md)");
  flags.option("--countdown", options.countdown_s, "of hosted matches [s]")
      .check(number_from(0.0, 60.0))
      .shows_default();
  flags
      .option("--absence", options.absence_s,
              "how long a hosted match waits for a player who has left [s]")
      .check(number_from(0.0, 3600.0))
      .shows_default();
  flags.option("--scene", options.scene, "preset (match, crowd) or TOML file").shows_default();
  flags
      .option("--bats", options.bats,
              "the same scene with so many bats, at its own density; 0: as it is")
      .check(number_from(0, bats_max))
      .shows_default();
  flags
      .option("--bat-count", options.bat_count,
              "so many bats on the same field instead; 0: as it is")
      .check(number_from(0, bats_max))
      .shows_default();
  flags
      .option("--puck-count", options.puck_count,
              "so many pucks on the same field instead; 0: as it is")
      .check(number_from(0, pucks_max))
      .shows_default();
  flags.option("--seed", options.seed, "of the scene's populations; 0: the scene's own")
      .check(seed_number())
      .shows_default();
  const Flag file =
      flags.option("--federation", options.federation_file,
                   "TOML file with federation, fom, and either address and port or a list of "
                   "nodes, who then are waited for and nobody else let in (docs/rti.md)");
  flags.option("--address", options.address, "to listen on")
      .check(not_empty())
      .excludes(file)
      .shows_default();
  flags.option("--port", options.port, "to listen on; 0: any free one, printed")
      .excludes(file)
      .shows_default();
  flags
      .option("--transport", options.transport,
              "tcp; udp: best-effort attributes by UDP beside it; shm: shared memory, clients "
              "of this machine only, by the port")
      .check(one_of({rti::socket_transport_names.begin(), rti::socket_transport_names.end()}))
      .shows_default();
  flags
      .option("--key-file", options.key_file,
              "let in only clients that have the same file (docs/rti.md, Admission); none: all")
      .check(existing_file());
  flags
      .option("--rate-limit", options.rate_limit_bytes_per_s,
              "bytes per second that a client may send before it is dropped; 0: any")
      .check(number_from(0.0, 1e12))
      .shows_default();
  flags
      .option("--frame-limit", options.frame_limit_per_s,
              "frames per second that a client may send before it is dropped; 0: any")
      .check(zero_or_number_from(1.0, 1e9))
      .shows_default();
  flags
      .option("--key-limit", options.key_limit_per_s,
              "key changes per second that a player may send; what is more is not felt, but "
              "counted and said; 0: any")
      .check(zero_or_number_from(1.0, 1e9))
      .shows_default();
  flags
      .option(
          "--budget", options.events_per_s,
          "events of the physics per simulated second; where more come, the game goes on more "
          "slowly instead of keeping everybody waiting, which is said and counted; not by turns "
          "nor with --time-management")
      .check(whole_number_from(1, 1'000'000'000'000))
      .shows_default();
  flags
      .option("--scheme", options.scheme,
              "interest management: a scheme, or several with and, or, not, and stages after "
              "with (docs/im.md)")
      .check({[](const std::string& text) { return im::complaint_about(text, {}).value_or(""); },
              "SCHEME"})
      .shows_default();
  flags.option("--cell-size", options.cell_size, "of schemes with cells [m]; 0: chosen")
      .check(zero_or_number_from(cell_size_min, 1e6))
      .shows_default();
  flags
      .option("--always", options.always,
              "kinds of bodies that the scheme always lets through: puck, bat, post; unless "
              "said otherwise posts, and the pucks of a match to a number of goals")
      .check(one_of(relevant_kind_names))
      .delimiter(',');
  flags.flag("--second-core", options.has_second_core,
             "another thread takes half of each match of interest that is large enough to gain "
             "by it (docs/im.md); the decisions are the same");
  flags
      .option("--sweep-ticks", options.sweep_ticks,
              "ticks ahead over which an entity's update region is swept; 0: where it is now")
      .check(number_from(0, sweep_ticks_max))
      .shows_default();
  flags.option("--policy", options.policy, "when motion is sent")
      .check(one_of(update_policy_names()))
      .shows_default();
  flags
      .option("--threshold", options.threshold,
              "under dead-reckoning and dead-reckoning-drag: how far clients may be off before "
              "a new update is sent [m]")
      .check(number_from(1e-4, 10.0))
      .shows_default();
  flags.option("--rate", options.rate_hz, "ticks per second")
      .check(number_from(1.0, 1000.0))
      .shows_default();
  flags
      .option("--spread", options.spread,
              "part of a tick over which its writes are staggered, each client's at a phase of "
              "its own; 0: all at once")
      .check(number_from(0.0, 0.9))
      .shows_default();
  flags
      .option("--pace", options.pace,
              "realtime: by the clock; synchronous: a tick when every player has said Update")
      .check(one_of({"realtime", "synchronous"}))
      .shows_default();
  flags.flag("--time-management", options.is_time_managed,
             "states, and in synchronous pace keys and turns, go in time-stamp order: the RTI "
             "says when a tick may be played or heard (docs/rti.md)");
  flags.option("--duration", options.duration_s, "simulated seconds; 0: until interrupted")
      .check(number_from(0.0, seconds_max))
      .shows_default();
  flags.option("--warm-up", options.warm_up_s, "simulated seconds before anything is measured")
      .check(number_from(0.0, seconds_max))
      .shows_default();
  flags.option("--clients", options.clients, "players to wait for before the start")
      .check(number_from(0, bats_max))
      .shows_default();
  flags.option("--patience", options.patience_s, "seconds to wait for them")
      .check(number_from(0.001, seconds_max))
      .shows_default();
  flags
      .option("--keys", options.keys,
              "recorded key log that moves the bats instead of the players' keys")
      .check(existing_file());
  flags
      .option("--from-state", options.from_state,
              "saved game from which to begin, as rink compare writes it beside a key log; of "
              "--keys those after its instant, and --duration and --warm-up count from there")
      .check(existing_file());
  flags.option(
      "--record", options.record,
      "file for the key log of this run; folder for those of hosted matches, by default matches");
  flags.option("--evidence", options.trace,
               "file for what a re-simulation of this run needs (docs/metrics.md), as JSON lines");
  flags
      .option(
          "--status", options.status,
          "ADDRESS:PORT of a running server: print what it says of its federations and federates, "
          "and end; nothing is served. --transport and --key-file as the server's")
      .check(not_empty());
  flags
      .option("--every", options.every_s,
              "seconds after which --status prints again, until interrupted; 0: once")
      .check(number_from(0.0, 3600.0))
      .needs(flags.find("--status"))
      .shows_default();
  flags.option("--report", options.report, "file for the measurements, as JSON");
}

void host_by_default(const Flags& flags, ServeOptions& options) {
  if (options.hosted.empty()) return;
  options.scene = options.hosted;
  if (!flags.is_given("--policy")) options.policy = "on-event";
  if (!flags.is_given("--rate")) options.rate_hz = 60.0;
  if (!flags.is_given("--record")) options.record = "matches";
}

}  // namespace rink::game
