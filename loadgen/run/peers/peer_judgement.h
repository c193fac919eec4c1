// What the peers of a run say together, as a server and its bots would have said it: for those in
// this process and for those in their own.
#pragma once

#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/net/peer/player_recorder.h"
#include "game/net/server_trace.h"
#include "loadgen/measure/truth/bots_trace.h"
#include "loadgen/run/cell_runner.h"
#include "loadgen/run/peers/peer_report.h"

namespace rink::loadgen {

/// Of a run under recorded `keys` up to its last window; decisions are still to be added.
game::ServerTrace trace_of(const Experiment& experiment, const Cell& cell, const game::Game& start,
                           const std::vector<game::InputEvent>& keys,
                           const std::string& state_hash);
/// Without bots.
BotsTrace bots_trace_of(const game::ServerTrace& server);
/// The next watched player.
void add_player(BotsTrace& bots, const game::PlayerTrace& player);

/// What peers say together.
struct PeersFindings {
  const PeerTotals& totals;
  const Measurements& measured;
  const game::ServerTrace& server;
  BotsTrace bots;
};

/// Writes NAME.peers.json, NAME.bots.json and, where truth is wanted, both kinds of evidence; and
/// judges the run by them.
void judge_peers(const RunnerSettings& settings, const Experiment& experiment, RunRecord& record,
                 PeersFindings findings);

}  // namespace rink::loadgen
