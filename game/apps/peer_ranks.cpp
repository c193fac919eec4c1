// Runs rink peer as ranks of MPI, of which only the first prints to the terminal.
#include "game/apps/peer_ranks.h"

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "game/apps/command.h"
#include "game/apps/peer_report.h"
#include "game/net/peer/network/rank_mail.h"
#include "game/net/peer/shared_game.h"

namespace rink::game {
namespace {

using Json = nlohmann::ordered_json;

/// Looks again at once while an answer may take microseconds only, then yields the processor to
/// other ranks, since there may be more ranks than processors.
void wait_for_ranks(std::uint32_t looks) {
  if (looks < 64) return;
  if (looks < 256) return std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::microseconds(20));
}

/// The report of all ranks, printed by the first one.
void report_ranks(const Json& own, RankMail& mail) {
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

}  // namespace

ExitStatus share_among_ranks(PeerOptions options) {
  if (!options.join.empty() || !options.listen.empty() || options.says_peers)
    throw std::invalid_argument(
        "--listen, --join, --peers: with --transport mpi the launcher says how many there are and "
        "brings them together (mpirun -np 4): expected none of these");
  if (options.bots > 0 || !options.record.empty() || options.pace != "free" ||
      options.terms.is_seated || options.terms.interest.is_wanted())
    throw std::invalid_argument(
        "--bots, --record, --pace, --scheme, --seated: ranks of --transport mpi only compute, as "
        "fast as they can: expected none of these");
  SharedGame shared = game_of(options);
  rti::Ranks ranks;
  options.terms.peer_count = ranks.count();
  options.terms.balance_windows = 0;    // zones stay: ranks do not agree on a balance
  options.terms.is_replicated = false;  // MPI ends all of them if one is lost
  RankMail mail(ranks, options.patience_s, now_s, wait_for_ranks);
  try {
    mail.agree(shared.session_fingerprint(), options.terms);
  } catch (const SessionError& error) {
    if (ranks.number() == 0) complain(error.what());
    if (error.status() != ExitStatus::wrong_version && error.status() != ExitStatus::not_admitted)
      ranks.abort(static_cast<int>(error.status()));
    ranks.finish();
    return error.status();
  }
  try {
    const double start_s = now_s();
    const PartOptions part_options{.players = options.players,
                                   .before_window = {},
                                   .wants_to_leave = {},
                                   .notify = {},
                                   .when_taken = [&shared] { shared.forget_start(); }};
    const PlayedPart part = shared.play(options.terms, std::vector<PeerInfo>(ranks.count()),
                                        mail.number(), mail, part_options);
    Json report = report_of(part, mail, 0, now_s() - start_s);
    add_hash(report, part);
    report_ranks(report, mail);
    mail.flush();
    ranks.finish();
    return ExitStatus::ok;
  } catch (const SessionError& error) {
    complain("rank ", mail.number(), ": ", error.what());
    ranks.abort(static_cast<int>(error.status()));
  } catch (const peer::ProtocolError& error) {
    complain("rank ", mail.number(), ": ", error.what());
    ranks.abort(static_cast<int>(ExitStatus::failed));
  }
}

}  // namespace rink::game
