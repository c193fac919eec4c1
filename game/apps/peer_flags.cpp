// Defines the flags of rink peer and its help text.
#include "game/apps/peer_flags.h"

#include "game/net/limits.h"
#include "game/players/player_kinds.h"

namespace rink::game {
namespace {

std::string player_names() {
  std::string names;
  for (const std::string& name : game::player_kinds()) names += ", " + name;
  return names;
}

void add_evidence_options(Flags& flags, ViewingOptions& options) {
  Flag trace =
      flags.option("--evidence", options.trace,
                   "file for the trace of this peer's traffic, knowledge and player "
                   "(docs/metrics.md), as JSON lines; with --pace realtime and a first peer with "
                   "--scheme --seated --unmirrored --balance 0");
  flags
      .option("--warm-up", options.warm_up_s,
              "with --evidence: simulated seconds before anything is measured")
      .check(number_from(0.0, seconds_max))
      .needs(trace)
      .shows_default();
  flags
      .option("--evidence-seed", options.evidence_seed,
              "with --evidence: seed of the watched players and instants; the same for all")
      .needs(trace)
      .shows_default();
}

/// `join`: the flag beside which the first peer's cannot stand.
void add_viewing_options(Flags& flags, ViewingOptions& options, Terms& terms, const Flag& join) {
  InterestTerms& interest = terms.interest;
  flags
      .option("--scheme", interest.scheme,
              "the filter of the updates that peers send each other about bodies in their "
              "players' views (docs/im.md), e.g. region; without it, peers send no updates to "
              "each other; only the first peer may give it")
      .check(objection_to)
      .excludes(join);
  flags
      .option("--policy", interest.policy,
              "with --scheme: on-event, trajectories when they change; or periodic, positions "
              "in every window; set by the first peer")
      .check(one_of({"on-event", "periodic"}))
      .excludes(join)
      .shows_default();
  flags
      .option("--cell-size", interest.cell_size,
              "with --scheme: side of its cells [m]; 0 lets it choose; set by the first peer")
      .check(zero_or_number_from(cell_size_min, 1e6))
      .excludes(join)
      .shows_default();
  flags
      .option("--always", options.always,
              "with --scheme: kinds of bodies that the scheme always lets through: puck, bat, "
              "post (default: posts, and the pucks of a match to a number of goals); set by the "
              "first peer")
      .delimiter(',')
      .check(one_of(relevant_kind_names))
      .excludes(join);
  flags
      .flag(
          "--seated", terms.is_seated,
          "give each peer the player of one of the first bats, the one in its zone, and cut zones "
          "around these bats; their keys are those that all know; set by the first peer")
      .excludes(join);
  flags
      .option("--view", options.view_fraction,
              "area of the own player's view as a fraction of the field's; 1 or more: everything")
      .check(number_from(1e-9, 1e6))
      .shows_default();
  flags.option("--view-area", options.view_area, "area of that view [m^2] instead; 0: use --view")
      .check(number_from(0.0, view_area_max))
      .shows_default();
  add_evidence_options(flags, options);
  flags
      .option("--view-margin", options.view_margin,
              "margin around the view in the subscription region sent to other peers [m]; the "
              "region is sent again when the bat has moved by half the margin")
      .check(number_from(0.0, view_margin_max))
      .shows_default();
}

}  // namespace

void add_options(Flags& flags, PeerOptions& options) {
  flags.description(
      "One of the peers that share a simulation without a server: each owns and simulates the "
      "bodies in its part of the field, and all together compute, bit for bit, what\n"
      "one engine does. The first one sets how many begin and how long they play; all others join "
      "through any running one, before the start or during the game. In the\n"
      "end each prints its report and the hash of the whole, which is that of rink simulate.\n"
      "A match, such as the scene match, each plays whole, to its end or --until; rink play --peer "
      "joins it, and --record and --report then hold its last match alone.");
  flags.name("rink peer");
  flags.option("--scene", options.scene, "a scene file or the name of a preset; the same for all")
      .is_required();
  flags.option(
      "--keys", options.keys,
      "a recorded key log to play, the same for all (default: the scene's scripted keys only)");
  flags
      .option("--bots", options.bots,
              "number of bats that this peer plays, the next free ones; 0: it only computes")
      .check(whole_number_from(0, bats_max))
      .shows_default();
  flags
      .option("--players", options.players,
              "kinds of their players, in turn, separated by commas: random" + player_names() +
                  "; seeded like the scene")
      .delimiter(',')
      .check([](const std::string& name) {
        return is_player_kind(name)
                   ? std::string()
                   : "'" + name + "' is no player: expected random" + player_names();
      })
      .shows_default();
  flags
      .option("--pace", options.pace,
              "realtime: by the clock, as matches always are; free: as fast as they can")
      .check(one_of({"realtime", "free"}))
      .shows_default();
  flags.option("--record", options.record,
               "write the keys of all peers and the final hash to this key log; rink replay and "
               "rink simulate --keys play it again");
  flags.option("--report", options.report,
               "file for this peer's report, as JSON (default: the standard output)");
  flags.option("--seed", options.seed, "seed of the scene's populations; 0: the scene's own")
      .shows_default();
  flags
      .option("--bats", options.bats,
              "scale the crowd to so many bats at constant density; 0: as it is")
      .check(whole_number_from(0, bats_max))
      .shows_default();
  flags
      .option("--bat-count", options.bat_count,
              "number of bats on the scene's own field; 0: as it is")
      .check(whole_number_from(0, bats_max))
      .shows_default();
  flags
      .option("--puck-count", options.puck_count,
              "number of pucks on the scene's own field; 0: as it is")
      .check(whole_number_from(0, pucks_max))
      .shows_default();
  flags
      .option("--listen", options.listen,
              "where others reach this peer; port 0 takes any free one (default if it joins a "
              "peer of this machine: 127.0.0.1:0)")
      .value_name("ADDRESS:PORT");
  Flag join =
      flags.option("--join", options.join, "any running peer; without this, become the first one")
          .value_name("HOST:PORT");
  flags
      .option("--peers", options.terms.peer_count,
              "number of peers to wait for before the start, while more may come later; set by "
              "the first peer")
      .check(whole_number_from(1, peers_max))
      .excludes(join)
      .shows_default();
  flags
      .option("--until", options.terms.until,
              "simulated time at which to stop [s]; set by the first peer")
      .check(number_from(1e-6, seconds_max))
      .excludes(join)
      .shows_default();
  flags
      .option("--window", options.terms.window,
              "simulated time from one agreement to the next [s]; set by the first peer")
      .check(number_from(1e-4, 10.0))
      .excludes(join)
      .shows_default();
  flags
      .option("--balance", options.terms.balance_windows,
              "period [windows] in which zones shift toward equal numbers of events, if these "
              "are uneven; 0: they stay; set by the first peer")
      .check(whole_number_from(0, 1'000'000u))
      .excludes(join)
      .shows_default();
  flags
      .flag("!--unmirrored", options.terms.is_replicated,
            "keep no replicas of other peers' parts: a lost or interrupted peer ends all, and "
            "none can join later; set by the first peer")
      .excludes(join);
  add_viewing_options(flags, options.viewing, options.terms, join);
  flags
      .option("--transport", options.transport,
              "transport: tcp; shm between processes of this machine, where a port is a "
              "name; or mpi between the ranks of an mpirun, which all are peers; the same for all")
      .check(one_of({"tcp", "shm", "mpi"}))
      .shows_default();
  flags
      .option(
          "--patience", options.patience_s,
          "how long a peer whose message is due may be silent, and how long a match waits for its "
          "two players to come [s]")
      .check(number_from(0.1, seconds_max))
      .shows_default();
  flags.footer(
      "Example, in two terminals:\n  ./rink peer --scene arena --peers 2 --until 5 --listen "
      "127.0.0.1:4800\n  ./rink peer --scene arena --join 127.0.0.1:4800\n"
      "As ranks of MPI (docs/cluster.md):\n  mpirun -np 4 --oversubscribe build/bin/rink-peer "
      "--transport mpi --scene arena --until 5\n"
      "Exit status: 0 done, 1 failed or a peer that sent an impossible message, 2 bad flag or "
      "file, 10 "
      "address in use, 11 no peer there, 12 wrong protocol version, 14 not admitted,\n"
      "16 a peer is gone, 17 a match's players did not come, 19 this peer continued alone and the "
      "other may have done so too, 130 "
      "interrupted.");
}

}  // namespace rink::game
