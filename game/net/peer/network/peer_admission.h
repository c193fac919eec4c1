// Answers those that connect to a peer: newcomers, peers that introduce themselves, and candidates
// on which all peers decide.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "game/net/peer/network/peer_links.h"
#include "game/net/peer/network/peer_roster.h"

namespace rink::game {

/// Its state is in the links and the roster, which outlive it.
class PeerAdmission {
 public:
  PeerAdmission(PeerLinks& links, PeerRoster& roster, double (*now_s)());

  /// Who asks while others play is refused from now on, for this reason.
  void refuse_late(std::function<std::string()> reason) { late_refusal_ = std::move(reason); }
  /// A stranger's frame. False for one that no peer would send.
  bool handle(rti::ConnectionId connection, const Frame& frame);
  /// What came before the own number was known is answered now. Connections that are peers' since
  /// then may have more to be read.
  std::vector<rti::ConnectionId> answer_early();

  /// The newcomers that have asked here since the last call.
  std::vector<peer::Newcomer> callers();
  void refuse_caller(std::uint64_t token, const std::string& reason, bool may_ask_again);
  /// All decide on a candidate, whose connection is the one of a peer from now on. Returns it if it
  /// may have more to be read.
  std::optional<rti::ConnectionId> expect(const peer::Candidate& candidate, bool has_asked_here,
                                          const peer::State& state);
  /// Whether a candidate is connected here.
  bool reaches(peer::PeerNumber candidate) const;
  /// The candidate is gone, or is none after `patience_s`.
  bool has_given_up(peer::PeerNumber candidate, double patience_s) const;
  /// All have decided: the candidate is a member, or is sent away.
  void decide(peer::PeerNumber candidate, bool is_in);

 private:
  void answer(rti::ConnectionId connection, const Hello& hello);
  void answer_in_play(rti::ConnectionId connection, const Hello& hello);
  void seat(rti::ConnectionId connection, const Hello& hello);
  void admit(rti::ConnectionId connection, const Greeting& greeting);

  PeerLinks& links_;
  PeerRoster& roster_;
  double (*now_s_)();
  std::function<std::string()> late_refusal_;
};

}  // namespace rink::game
