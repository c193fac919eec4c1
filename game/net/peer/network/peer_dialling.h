// A newcomer's way in: it asks any peer, again and again for a while, and connects to all that the
// answer names.
#pragma once

#include <string>

#include "game/net/peer/network/peer_links.h"
#include "game/net/peer/network/peer_losses.h"
#include "game/net/peer/network/peer_roster.h"

namespace rink::game {

/// All but its attempts is in the links, the roster and the losses, which outlive it.
class PeerDialling {
 public:
  PeerDialling(PeerLinks& links, PeerRoster& roster, PeerLosses& losses);

  /// Asks the peer at `any` for the first time.
  void ask(const Place& any, double now_s);
  /// Asks again when it is due. Throws SessionError if nobody has answered for too long, or if a
  /// peer that may let this one in later has not done so in `patience_s`.
  void ask_again(double patience_s, double now_s);
  /// A connection that asks is open.
  void introduce(rti::ConnectionId connection);
  /// The answer's frame. False for one that no peer would send.
  bool handle(rti::ConnectionId connection, const Frame& frame);
  /// A connection that asks is closed.
  void note_unanswered(const PeerLink& link, const std::string& why);

 private:
  bool be_refused(rti::ConnectionId connection, const Frame& frame);
  bool go_elsewhere(rti::ConnectionId connection, const Frame& frame);
  bool enter(rti::ConnectionId connection, const Frame& frame);
  void dial();

  PeerLinks& links_;
  PeerRoster& roster_;
  PeerLosses& losses_;
  Place any_;
  double begin_s_ = 0.0, asked_s_ = 0.0;
  std::string unanswered_;  ///< why this peer must try again
  bool may_ask_again_ = false, was_redirected_ = false;
};

}  // namespace rink::game
