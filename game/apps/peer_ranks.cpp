// Runs rink peer as ranks of MPI, of which only the first prints to the terminal.
#include "game/apps/peer_ranks.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "game/apps/command.h"
#include "game/apps/peer_report.h"
#include "game/net/interrupt.h"
#include "game/net/peer/ranks/rank_network.h"
#include "game/net/peer/shared_game.h"

namespace rink::game {
namespace {

using Json = nlohmann::ordered_json;

void require_ranks(const PeerOptions& options) {
  if (!options.join.empty() || !options.listen.empty() || options.given.count("--peers") != 0)
    throw said_by_launcher("--listen, --join, --peers");
  if (options.bots > 0 || !options.record.empty() || options.pace != "free" ||
      options.terms.is_seated || options.terms.interest.is_wanted())
    throw std::invalid_argument(
        "--bots, --record, --pace, --scheme, --seated: ranks of --transport mpi only compute, as "
        "fast as they can: expected none of these");
}

/// The report of all ranks, printed by the first one.
void report_ranks(const Json& own, RankNetwork& network) {
  const std::string text = own.dump();
  if (network.number() != 0) return network.send(0, {text.begin(), text.end()});
  Json all = {{"peers", network.terms().peer_count},
              {"time", own["time"]},
              {"collectives", network.collectives()},
              {"hash", own["hash"]},
              {"ranks", Json::array({own})}};
  for (peer::PeerNumber from = 1; from < network.terms().peer_count; ++from)
    all["ranks"].push_back(Json::parse(network.receive(from)));
  std::printf("%s\n", all.dump(2).c_str());
}

void play(const PeerOptions& options, SharedGame& shared, RankNetwork& network) {
  const double start_s = now_s();
  const PartOptions part_options{.players = options.players,
                                 .before_window = {},
                                 .wants_to_leave = {},
                                 .notify = {},
                                 .when_taken = [&shared] { shared.forget_start(); }};
  const PlayedPart part =
      shared.play(network.terms(), network.peer_infos(), network.number(), network, part_options);
  Json report = report_of(part, network, 0, now_s() - start_s);
  add_hash(report, part);
  report_ranks(report, network);
}

}  // namespace

ExitStatus share_among_ranks(PeerOptions options, RankCommand& command) {
  require_ranks(options);
  SharedGame shared = game_of(options);
  shared.require_divisible();
  options.terms.is_replicated = false;  // MPI ends all of them if one is lost
  RankNetwork network(command.begin(),
                      {.self = {},
                       .bats = shared.bat_count(),
                       .session_fingerprint = shared.session_fingerprint(),
                       .patience_s = options.patience_s},
                      now_s);
  network.agree(options.terms);
  try {
    play(options, shared, network);
  } catch (const std::exception& error) {
    network.leave(
        {is_interrupted ? FarewellKind::interrupted : FarewellKind::trouble, error.what()});
    throw;
  }
  network.leave({});
  return ExitStatus::ok;
}

}  // namespace rink::game
