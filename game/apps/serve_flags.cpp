// Defines the flags of rink serve and its help text.
#include "game/apps/serve_flags.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "game/apps/plugin_flag.h"
#include "game/apps/rank_command.h"
#include "game/net/exit_status.h"
#include "game/net/limits.h"
#include "game/net/peer/network/greetings.h"
#include "game/net/relevant_kinds.h"
#include "game/process/thread_team.h"
#include "im/expression_fault.h"
#include "im/filter.h"
#include "rti/transport/socket_transport.h"

namespace rink::game {
namespace {

std::vector<std::string> transport_names() {
  std::vector<std::string> names(rti::socket_transport_names.begin(),
                                 rti::socket_transport_names.end());
  names.emplace_back("mpi");
  return names;
}

}  // namespace

void add_options(Flags& flags, ServeOptions& options) {
  flags.description(
      "The server federate: simulates a scene exactly and sends each client what lies in its "
      "interest.");
  flags.footer(std::string("Example: rink serve --scene crowd --clients 100 --scheme region "
                           "--duration 30 --report server.json\n"
                           "Nodes as ranks of MPI (docs/cluster.md): mpirun -np 4 --oversubscribe "
                           "build/bin/rink-serve --transport mpi --scene arena --duration 20\n\n") +
               exit_status_help);
  flags.name("rink serve");
  flags.option(
      "match", options.hosted,
      "host matches of this scene, match, paper or another one for two, one after the other, "
      "until interrupted; by default with policy on-event at 60 ticks per second "
      "(docs/play.md)");
  flags.option("--countdown", options.countdown_s, "length of the countdown of hosted matches [s]")
      .check(number_from(0.0, 60.0))
      .shows_default();
  flags
      .option(
          "--absence", options.absence_s,
          "how long a hosted match waits for a player that has left, and nodes keep its bat [s]")
      .check(number_from(0.0, 3600.0))
      .shows_default();
  flags
      .option("--name", options.name,
              "name by which windows on the local network list a hosted match (default: that of "
              "this machine)")
      .check(not_empty());
  flags.flag("!--no-discovery", options.is_announced,
             "do not answer windows that ask the local network for matches");
  flags
      .option("--continue", options.continued,
              "record of a hosted match that was not played to its end: score, time and places are "
              "as at its end once both players are here")
      .value_name("FILE")
      .check(existing_file());
  flags.option("--scene", options.scene, "preset (match, paper, crowd) or TOML file")
      .shows_default();
  flags
      .option("--bats", options.bats,
              "scale the scene to so many bats at its own density; 0: as it is")
      .check(number_from(0, bats_max))
      .shows_default();
  flags
      .option("--bat-count", options.bat_count,
              "number of bats on the scene's own field instead; 0: as it is")
      .check(number_from(0, bats_max))
      .shows_default();
  flags
      .option("--puck-count", options.puck_count,
              "number of pucks on the scene's own field instead; 0: as it is")
      .check(number_from(0, pucks_max))
      .shows_default();
  flags.option("--seed", options.seed, "seed of the scene's populations; 0: the scene's own")
      .shows_default();
  const Flag file =
      flags.option("--federation", options.federation_file,
                   "TOML file with federation, fom, and either address and port or a list of "
                   "nodes; the server then waits for these and admits no others (docs/rti.md)");
  flags.option("--address", options.address, "address to listen on")
      .check(not_empty())
      .excludes(file)
      .shows_default();
  flags
      .option("--port", options.port,
              "port to listen on; 0: any free one, printed; with --transport mpi rank K listens "
              "at this port + K, without --port at any free one")
      .excludes(file)
      .shows_default();
  flags
      .option("--transport", options.transport,
              "tcp; udp: best-effort attributes by UDP beside it; bundle: the clients of a process "
              "share "
              "its sockets; shm: shared memory, clients "
              "of this machine only, by the port; mpi: all ranks of an mpirun are nodes, with "
              "clients by TCP or UDP (docs/cluster.md)")
      .check(one_of(transport_names()))
      .shows_default();
  flags
      .option("--key-file", options.key_file,
              "admit only clients with the same file (docs/rti.md, Admission); without it: all")
      .check(existing_file());
  flags
      .option("--address-limit", options.address_limit,
              "connections that one address may have; 0: any; by default half of the files "
              "that this process may open, for addresses of other machines alone")
      .check(whole_number_from(0, 1'000'000));
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
              "key changes per second that a player may send; others are counted and reported, "
              "but have no effect; 0: any; of a match, by default 120")
      .check(zero_or_number_from(1.0, 1e9))
      .shows_default();
  flags
      .option("--push-limit", options.push_limit_per_s,
              "in a match, pushes per second that a player may send by a pointer or a gamepad; "
              "others as above; 0: any")
      .check(zero_or_number_from(1.0, 1e9))
      .shows_default();
  flags
      .option("--budget", options.events_per_s,
              "events of the physics per simulated second; where more come, the game goes on more "
              "slowly instead of keeping everybody waiting, which is said and counted")
      .check(whole_number_from(1, 1'000'000'000'000))
      .shows_default();
  flags
      .option("--scheme", options.scheme,
              "interest management: a scheme, or several with and, or, not, and stages after "
              "with (docs/im.md)")
      .check({[](const std::string& text) {
                const auto fault = im::fault_in(text);  // plugins may be named later
                return fault ? fault->what : std::string();
              },
              "SCHEME"})
      .shows_default();
  add_plugin_option(flags, options.plugins);
  flags
      .option("--cell-size", options.cell_size,
              "side of the cells of schemes that have some [m]; 0: chosen")
      .check(zero_or_number_from(cell_size_min, 1e6))
      .shows_default();
  flags
      .option("--always", options.always,
              "kinds of bodies that the scheme always lets through: puck, bat, post (default: "
              "posts, and the pucks of a match to a number of goals)")
      .check(one_of(relevant_kind_names))
      .delimiter(',');
  flags.flag("--second-core", options.has_second_core,
             "let another thread take half of each match of interest where that is faster "
             "(docs/im.md); the decisions are the same");
  flags
      .option("--threads", options.threads,
              "threads that play parts of a field of free pucks at once, with the same results "
              "(docs/physics.md)")
      .check(whole_number_from(1, ThreadTeam::count_max))
      .shows_default();
  flags
      .option("--sweep-ticks", options.sweep_ticks,
              "ticks ahead over which an entity's update region is swept; 0: its present place")
      .check(number_from(0, sweep_ticks_max))
      .shows_default();
  flags.option("--policy", options.policy, "update policy: when and how motion is sent")
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
      .option(
          "--output-rate", options.output_rate_hz,
          "updates a second to each client, at most --rate and spread over the ticks; events of "
          "its own bat are sent at the next tick all the same; 0: an update at each tick")
      .check(zero_or_number_from(0.1, 1000.0))
      .shows_default();
  flags.flag("--bytes-by-field", options.counts_fields,
             "the report says where the payload goes, by message and field; it costs time, since "
             "all is read again");
  flags
      .option("--spread", options.spread,
              "part of a tick over which its writes are staggered, each client's at a phase of "
              "its own; 0: all at once")
      .check(number_from(0.0, 0.9))
      .shows_default();
  flags
      .option("--pace", options.pace,
              "realtime: by the clock; synchronous: a tick when every player has sent Update")
      .check(one_of({"realtime", "synchronous"}))
      .shows_default();
  flags.flag("--time-management", options.is_time_managed,
             "send states, and in synchronous pace keys and turns, in time-stamp order: the RTI "
             "decides when a tick may be played or delivered (docs/rti.md)");
  flags.option("--duration", options.duration_s, "simulated seconds; 0: until interrupted")
      .check(number_from(0.0, seconds_max))
      .shows_default();
  flags.option("--warm-up", options.warm_up_s, "simulated seconds before anything is measured")
      .check(number_from(0.0, seconds_max))
      .shows_default();
  flags.option("--clients", options.clients, "players to wait for before the start")
      .check(number_from(0, bats_max))
      .shows_default();
  flags
      .option("--patience", options.patience_s,
              "seconds to wait for these players, for other nodes, and for their players")
      .check(number_from(0.001, seconds_max))
      .shows_default();
  const Flag join = flags.option(
      "--join", options.join,
      "HOST:PORT of any node: share its simulation, whose --duration and --rate hold (docs/"
      "peer-to-peer.md, Nodes); --clients players are seated here");
  flags
      .option("--nodes", options.nodes,
              "number of servers that share the simulation, of which this is the first; 0: no "
              "others")
      .check(number_from(0, peers_max))
      .excludes(join)
      .shows_default();
  flags
      .option("--balance", options.balance_windows,
              "period [ticks] in which the nodes' zones shift toward equal numbers of events, if "
              "these are uneven; 0: they stay; set by the first node")
      .check(whole_number_from(0, 1'000'000u))
      .excludes(join)
      .shows_default();
  flags
      .flag("!--unmirrored", options.is_replicated,
            "keep no replicas of other nodes' parts: a lost or interrupted node ends all; set by "
            "the first node; ranks of MPI have none")
      .excludes(join);
  flags.option("--node-listen", options.node_listen,
               "ADDRESS:PORT at which other nodes reach this one; port 0: any free one, printed");
  flags
      .option("--node-patience", options.node_patience_s,
              "seconds of silence after which another node is lost")
      .check(number_from(0.001, seconds_max))
      .shows_default();
  flags
      .option("--keys", options.keys,
              "recorded key log that moves the bats instead of the players' keys")
      .check(existing_file());
  flags
      .option("--from-state", options.from_state,
              "saved game from which to begin, as rink compare writes it beside a key log; only "
              "later --keys are played, and --duration and --warm-up count from its instant")
      .check(existing_file());
  flags.option(
      "--record", options.record,
      "file for the key log of this run; folder for those of hosted matches, by default matches");
  flags.option(
      "--evidence", options.trace,
      "file for the trace of this run, for its re-simulation (docs/metrics.md), as JSON lines");
  flags
      .option("--status", options.status,
              "ADDRESS:PORT of a running server: print the report of its federations and federates "
              "and end, without serving. --transport and --key-file as the server's")
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
  if (!flags.is_given("--key-limit")) options.key_limit_per_s = match_key_limit_default;
  if (!flags.is_given("--rate")) options.rate_hz = 60.0;
  if (!flags.is_given("--record")) options.record = "matches";
}

void serve_among_ranks(const Flags& flags, ServeOptions& options) {
  if (options.transport != "mpi") return;
  if (flags.is_given("--nodes") || flags.is_given("--join") || flags.is_given("--node-listen"))
    throw said_by_launcher("--nodes, --join, --node-listen");
  if (flags.is_given("--unmirrored"))
    throw std::invalid_argument(
        "--unmirrored: MPI ends all ranks if one is lost, so they keep no replicas: it can't be "
        "given with --transport mpi");
  options.is_rank = true;
  // Who asks for a server's status needs no datagrams.
  options.transport = options.status.empty() ? "udp" : "tcp";
  if (!flags.is_given("--port")) options.port = 0;
}

void require_heeded(const Flags& flags, const ServeOptions& options) {
  if (is_node(options) && flags.is_given("--budget"))
    throw std::runtime_error(
        "--budget: nodes play each window whole, or others would have to wait for what one has put "
        "off: it can't be given with --nodes, --join and --transport mpi");
  if (!options.join.empty() && flags.is_given("--absence"))
    throw std::runtime_error(
        "--absence: the first node, which gives out the bats, decides how long one is kept: it "
        "can't be given with --join");
}

}  // namespace rink::game
