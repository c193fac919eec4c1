// The flags of rink serve.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "game/control/seed_flag.h"
#include "game/net/exit_status.h"
#include "game/net/flags.h"
#include "game/net/relevant_kinds.h"
#include "game/net/server/server.h"
#include "game/replication/update_policy.h"
#include "rti/federation_execution.h"
#include "rti/transport/socket_transport.h"

namespace rink::game {

struct ServeOptions {
  std::string scene = "crowd", federation_file, address = "127.0.0.1", scheme = "region",
              policy = "periodic", keys, record, report, evidence, status, pace = "realtime",
              transport = "tcp", hosted;
  std::string key_file, from_state;
  std::vector<std::string> always{};   ///< kinds that are relevant to everybody; none: the scene's
  std::vector<std::string> members{};  ///< of the federation file's list, if it has one
  std::uint16_t port = 4711;
  std::uint32_t bats = 0, bat_count = 0, puck_count = 0, clients = 0, sweep_ticks = 0;
  std::uint64_t seed = 0;
  bool is_time_managed = false, has_second_core = false;
  double rate_hz = 30.0, duration_s = 0.0, warm_up_s = 0.0, cell_size = 0.0, patience_s = 30.0,
         countdown_s = 3.0, absence_s = 30.0, every_s = 0.0;
  double spread = 0.0;
  double threshold = threshold_default;                          ///< m
  double rate_limit_bytes_per_s = 0.0, frame_limit_per_s = 0.0;  ///< of each client; 0: none
  double key_limit_per_s = key_limit_default;                    ///< of each player; 0: none
};

inline void add_options(CLI::App& app, ServeOptions& options) {
  app.description(
      "The server federate: simulates a scene exactly and tells each client what lies in its "
      "interest.");
  app.footer(std::string("Example: rink serve --scene crowd --clients 100 --scheme region "
                         "--duration 30 --report server.json\n\n") +
             exit_status_help);
  app.add_option("match", options.hosted,
                 "host matches of this scene, one after the other, until interrupted: on-event, 60 "
                 "ticks per second unless said otherwise (docs/play.md)");
  app.add_option("--countdown", options.countdown_s, "of hosted matches [s]")
      ->check(number_from(0.0, 60.0))
      ->capture_default_str();
  app.add_option("--absence", options.absence_s,
                 "how long a hosted match waits for a player who has left [s]")
      ->check(number_from(0.0, 3600.0))
      ->capture_default_str();
  app.add_option("--scene", options.scene, "preset (match, crowd) or TOML file")
      ->capture_default_str();
  app.add_option("--bats", options.bats,
                 "the same scene with so many bats, at its own density; 0: as it is")
      ->check(number_from(0, bats_max))
      ->capture_default_str();
  app.add_option("--bat-count", options.bat_count,
                 "so many bats on the same field instead; 0: as it is")
      ->check(number_from(0, bats_max))
      ->capture_default_str();
  app.add_option("--puck-count", options.puck_count,
                 "so many pucks on the same field instead; 0: as it is")
      ->check(number_from(0, pucks_max))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "of the scene's populations; 0: the scene's own")
      ->check(seed_number())
      ->capture_default_str();
  CLI::Option* const file =
      app.add_option("--federation", options.federation_file,
                     "TOML file with federation, fom, and either address and port or a list of "
                     "nodes, who then are waited for and nobody else let in (docs/rti.md)");
  app.add_option("--address", options.address, "to listen on")
      ->check(not_empty())
      ->excludes(file)
      ->capture_default_str();
  app.add_option("--port", options.port, "to listen on; 0: any free one, printed")
      ->excludes(file)
      ->capture_default_str();
  app.add_option("--transport", options.transport,
                 "tcp; udp: best-effort attributes by UDP beside it; shm: shared memory, clients "
                 "of this machine only, by the port")
      ->check(CLI::IsMember(std::vector<std::string>(rti::socket_transport_names.begin(),
                                                     rti::socket_transport_names.end())))
      ->capture_default_str();
  app.add_option("--key-file", options.key_file,
                 "let in only clients that have the same file (docs/rti.md, Admission); none: all")
      ->check(CLI::ExistingFile);
  app.add_option("--rate-limit", options.rate_limit_bytes_per_s,
                 "bytes per second that a client may send before it is dropped; 0: any")
      ->check(number_from(0.0, 1e12))
      ->capture_default_str();
  app.add_option("--frame-limit", options.frame_limit_per_s,
                 "frames per second that a client may send before it is dropped; 0: any")
      ->check(zero_or_number_from(1.0, 1e9))
      ->capture_default_str();
  app.add_option("--key-limit", options.key_limit_per_s,
                 "key changes per second that a player may send; what is more is not felt, but "
                 "counted and said; 0: any")
      ->check(zero_or_number_from(1.0, 1e9))
      ->capture_default_str();
  app.add_option("--scheme", options.scheme,
                 "interest management: a scheme, or several with and, or, not, and stages after "
                 "with (docs/im.md)")
      ->check([](const std::string& text) { return im::complaint_about(text, {}).value_or(""); },
              "SCHEME")
      ->capture_default_str();
  app.add_option("--cell-size", options.cell_size, "of schemes with cells [m]; 0: chosen")
      ->check(zero_or_number_from(cell_size_min, 1e6))
      ->capture_default_str();
  app.add_option("--always", options.always,
                 "kinds of bodies that the scheme always lets through: puck, bat, post; unless "
                 "said otherwise posts, and the pucks of a match to a number of goals")
      ->check(CLI::IsMember(relevant_kind_names))
      ->delimiter(',');
  app.add_flag("--second-core", options.has_second_core,
               "another thread takes half of each match of interest that is large enough to gain "
               "by it (docs/im.md); the decisions are the same");
  app.add_option("--sweep-ticks", options.sweep_ticks,
                 "ticks ahead over which an entity's update region is swept; 0: where it is now")
      ->check(number_from(0, sweep_ticks_max))
      ->capture_default_str();
  app.add_option("--policy", options.policy, "when motion is sent")
      ->check(CLI::IsMember(update_policy_names()))
      ->capture_default_str();
  app.add_option("--threshold", options.threshold,
                 "under dead-reckoning and dead-reckoning-drag: how far clients may be off before "
                 "they are told anew [m]")
      ->check(number_from(1e-4, 10.0))
      ->capture_default_str();
  app.add_option("--rate", options.rate_hz, "ticks per second")
      ->check(number_from(1.0, 1000.0))
      ->capture_default_str();
  app.add_option("--spread", options.spread,
                 "part of a tick over which its writes are staggered, each client's at a phase of "
                 "its own; 0: all at once")
      ->check(number_from(0.0, 0.9))
      ->capture_default_str();
  app.add_option("--pace", options.pace,
                 "realtime: by the clock; synchronous: a tick when every player has said Update")
      ->check(CLI::IsMember({"realtime", "synchronous"}))
      ->capture_default_str();
  app.add_flag("--time-management", options.is_time_managed,
               "states, and in synchronous pace keys and turns, go in time-stamp order: the RTI "
               "says when a tick may be played or heard (docs/rti.md)");
  app.add_option("--duration", options.duration_s, "simulated seconds; 0: until interrupted")
      ->check(number_from(0.0, seconds_max))
      ->capture_default_str();
  app.add_option("--warm-up", options.warm_up_s, "simulated seconds before anything is measured")
      ->check(number_from(0.0, seconds_max))
      ->capture_default_str();
  app.add_option("--clients", options.clients, "players to wait for before the start")
      ->check(number_from(0, bats_max))
      ->capture_default_str();
  app.add_option("--patience", options.patience_s, "seconds to wait for them")
      ->check(number_from(0.001, seconds_max))
      ->capture_default_str();
  app.add_option("--keys", options.keys,
                 "recorded key log that moves the bats instead of the players' keys")
      ->check(CLI::ExistingFile);
  app.add_option("--from-state", options.from_state,
                 "saved game from which to begin, as rink compare writes it beside a key log; of "
                 "--keys those after its instant, and --duration and --warm-up count from there")
      ->check(CLI::ExistingFile);
  app.add_option(
      "--record", options.record,
      "file for the key log of this run; folder for those of hosted matches, by default matches");
  app.add_option(
      "--evidence", options.evidence,
      "file for what a re-simulation of this run needs (docs/metrics.md), as JSON lines");
  app.add_option(
         "--status", options.status,
         "ADDRESS:PORT of a running server: print what it says of its federations and federates, "
         "and end; nothing is served. --transport and --key-file as the server's")
      ->check(not_empty());
  app.add_option("--every", options.every_s,
                 "seconds after which --status prints again, until interrupted; 0: once")
      ->check(number_from(0.0, 3600.0))
      ->needs("--status")
      ->capture_default_str();
  app.add_option("--report", options.report, "file for the measurements, as JSON");
}

}  // namespace rink::game
