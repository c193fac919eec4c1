// Nodes meet as ranks of MPI.
#pragma once

#include <memory>
#include <string>

#include "game/net/peer/ranks/rank_network.h"
#include "game/node/meeting.h"

namespace rink::game {

class RankMeeting final : public Meeting {
 public:
  /// `ranks` must outlive it. The terms, but for the number of nodes, must be those of all ranks.
  /// MPI ends all of them if one is lost, so none keeps copies of others.
  RankMeeting(rti::Ranks& ranks, const Terms& terms) : ranks_(ranks), terms_(terms) {
    terms_.is_replicated = false;
  }
  bool survives_losses() const override { return false; }

  std::unique_ptr<SessionNetwork> enter(PeerNetworkSettings self, double (*now_s)()) override {
    if (ranks_.count() > peers_max)
      throw RanksDiffer(ExitStatus::not_admitted, std::to_string(ranks_.count()) +
                                                      " ranks: expected at most " +
                                                      std::to_string(peers_max) + " nodes");
    auto network = std::make_unique<RankNetwork>(ranks_, self, now_s);
    network->agree(terms_);
    return network;
  }

 private:
  rti::Ranks& ranks_;
  Terms terms_;
};

}  // namespace rink::game
