// What becomes of a match that nodes host when one of them is lost: the first that is left is the
// referee, and releases the keys of the lost one's players. docs/peer-to-peer.md, "Nodes".
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "game/net/peer/network/session_network.h"
#include "game/net/peer/shared_game.h"
#include "game/node/match/match_members.h"
#include "game/node/match/referee_log.h"
#include "game/node/node_match.h"
#include "game/node/node_seats.h"

namespace rink::game {

/// Nothing is undone: all that are left have the match, and come to know the same words of the lost
/// node. The session's thread uses it.
class MatchRecovery {
 public:
  struct Parts {
    SessionNetwork& network;
    const SharedGame& game;
    NodeSeats& seats;
    NodeMatch& match;
  };
  struct Hooks {
    std::function<double()> clock_s;                  ///< since the start
    std::function<peer::Session*()> session;          ///< null between sessions
    std::function<bool(const SeatDecision&)> decide;  ///< false for what no referee decides
    std::function<bool(peer::PeerNumber, const std::vector<std::uint8_t>&)> receive;
    std::function<void(const std::string&)> notify;  ///< the user; may be empty
  };
  MatchRecovery(const Parts& parts, Hooks hooks);

  MatchMembers& members() { return members_; }
  bool is_referee() const { return members_.referee() == members_.number(); }
  /// Side messages of nodes that know of more losses than this one wait: then the answer is that of
  /// a handler. Nothing if the message is to be handled now.
  std::optional<bool> sort(peer::PeerNumber from, const std::vector<std::uint8_t>& bytes);

  /// At the referee: tells all.
  void say(const std::vector<SeatDecision>& decisions);
  void say(const MatchNews& news);
  /// What a node has said as the referee. False for what none says.
  bool hear_decisions(peer::PeerNumber from, std::span<const std::uint8_t> content);
  bool hear_news(peer::PeerNumber from, std::span<const std::uint8_t> content);
  /// The words of a round have had their effect.
  void finish_round() {
    parts_.seats.finish_round();
    members_.finish_round(), log_.finish_round();
  }

 private:
  static constexpr std::size_t early_max = 4096;

  bool hear_last(const RefereeWords& words);
  void when_recovered();
  void release(peer::PeerNumber lost);
  void tell_of_losses();

  Parts parts_;
  Hooks hooks_;
  MatchMembers members_;
  RefereeLog log_;
  std::size_t lost_count_ = 0;  ///< of which the user knows
  std::deque<std::pair<peer::PeerNumber, std::vector<std::uint8_t>>> early_;
};

}  // namespace rink::game
