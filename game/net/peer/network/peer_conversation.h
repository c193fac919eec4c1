// The mail between connected peers, what comes beside it, and their farewells.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "game/net/peer/network/deferred_asides.h"
#include "game/net/peer/network/patience.h"
#include "game/net/peer/network/peer_links.h"
#include "game/net/peer/network/peer_losses.h"
#include "game/net/peer/network/peer_roster.h"

namespace rink::game {

/// Inboxes are in the links, which outlive it as do the roster and the losses.
class PeerConversation {
 public:
  using SideListener = std::function<bool(peer::PeerNumber from, std::vector<std::uint8_t> bytes)>;

  PeerConversation(PeerLinks& links, const PeerRoster& roster, PeerLosses& losses);

  /// A frame of a peer. False for one that no peer would send.
  bool handle(rti::ConnectionId connection, PeerLink& link, Frame frame);

  /// A peer that is expected and has not connected yet gets it then; others that are not connected
  /// never do.
  void send(peer::PeerNumber to, std::vector<std::uint8_t> bytes);
  /// The next mail of `from`, if it is here. Throws peer::PeerGone for a peer that is lost, and
  /// peer::SentAway if this newcomer was not admitted.
  std::optional<std::vector<std::uint8_t>> take_mail(peer::PeerNumber from);
  /// The same, also of a peer that is lost, and of no other peer's loss anything.
  std::optional<std::vector<std::uint8_t>> next_mail(peer::PeerNumber from);
  /// Throws as `take_mail` does for peers that are lost.
  void check_losses() const;
  /// Without mail of `from`: throws peer::PeerGone or SessionError if none will come, and loses it
  /// if it was silent for too long. True if more may come.
  bool may_still_come(peer::PeerNumber from, const Patience& patience);
  /// Gives waiting side messages to `listener` in order.
  void deliver_deferred(const SideListener& listener);
  /// Keeps a side message that came too early.
  void defer(peer::PeerNumber from, std::vector<std::uint8_t> bytes) {
    deferred_.keep(from, std::move(bytes));
  }

  /// As of peer::Mail.
  void part(peer::PeerNumber peer, bool is_lost);
  void rejoin(peer::PeerNumber peer);
  /// To all peers.
  void bid_farewell(const Farewell& farewell);
  /// True if a connected peer has not sent its farewell.
  bool awaits_farewell() const;

 private:
  bool take_aside(const PeerLink& link, Frame frame);
  bool take_farewell(rti::ConnectionId connection, PeerLink& link, const Frame& frame);
  bool be_sent_away(const PeerLink& link, const Frame& frame);

  PeerLinks& links_;
  const PeerRoster& roster_;
  PeerLosses& losses_;
  DeferredAsides deferred_;
  std::string sent_away_;  ///< why this newcomer was not admitted
};

}  // namespace rink::game
