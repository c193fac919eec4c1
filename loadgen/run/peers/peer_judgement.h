// Combines the reports of a run's peers into those of a server and its bots, for peers in this
// process and in their own.
#pragma once

#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/net/bots_trace.h"
#include "game/net/server_trace.h"
#include "loadgen/run/cell_runner.h"
#include "loadgen/run/peers/peer_report.h"

namespace rink::loadgen {

/// The trace of a run under recorded `keys` up to its last window; decisions are added later.
game::ServerTrace trace_of(const Experiment& experiment, const Cell& cell, const game::Game& start,
                           const std::vector<game::InputEvent>& keys,
                           const std::string& state_hash);
/// An empty trace of bots for the run of `server`.
game::BotsTrace bots_trace_of(const game::ServerTrace& server);

/// The combined results of peers.
struct PeersFindings {
  const PeerTotals& totals;
  const Measurements& measured;
  const game::ServerTrace& server;
  game::BotsTrace bots;
};

/// Writes NAME.peers.json, NAME.bots.json and, where truth is wanted, both kinds of traces; and
/// evaluates the run by them.
void judge_peers(const RunnerSettings& settings, const Experiment& experiment, RunRecord& record,
                 PeersFindings&& findings);

}  // namespace rink::loadgen
