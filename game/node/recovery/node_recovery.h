// What becomes of a node's side of a session when another node is lost: what it showed, told and
// heard, and its players' keys, go back with the session. docs/peer-to-peer.md, "Loss of a node".
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "game/model/key.h"
#include "game/net/peer/shared_game.h"
#include "game/node/node_seats.h"
#include "game/node/node_subscription.h"
#include "game/node/part_receiver.h"
#include "game/node/part_teller.h"
#include "game/node/recovery/match_recovery.h"
#include "game/node/recovery/stand_in.h"
#include "game/node/seated_players.h"
#include "game/node/window_feed.h"

namespace rink::game {

/// A stretch that was shown is never undone: all have told of it, so all had played it. So no
/// client notices more of a loss than that time stands still.
class NodeRecovery final : public LossParticipant {
 public:
  struct Parts {
    SessionNetwork& network;
    const SharedGame& game;
    WindowFeed& feed;
    std::optional<PartReceiver>& receiver;  ///< these two are there where parts are replicated
    std::optional<PartTeller>& teller;
    NodeSeats& seats;
    SeatedPlayers& players;
    NodeSubscription& subscription;
  };
  /// Where this node hosts matches, their recovery takes the place of all that follows.
  void host(MatchRecovery::Hooks hooks, NodeMatch& match);
  MatchRecovery* matches() { return matches_ ? &*matches_ : nullptr; }
  /// False for what no node says.
  using Handler = std::function<bool(peer::PeerNumber from, const std::vector<std::uint8_t>&)>;
  NodeRecovery(const Parts& parts, Handler handle);

  /// Messages bear the number of recoveries of their sender. Those of before this node's last one
  /// are dropped, those of after the next one are kept: then the answer is that of a Handler.
  /// Nothing if the message is to be handled now.
  std::optional<bool> sort(peer::PeerNumber from, const std::vector<std::uint8_t>& bytes);
  /// As PartReceiver's; but where others can go on without a node whose part is faulty, it is lost.
  bool receive(peer::PeerNumber from, peer::PartChange change);
  void finish_window(peer::PartChange own, const peer::Session& session);
  /// Before each window: takes note of the keys that were felt, and at the referee releases those
  /// of lost nodes' players, who leave then.
  void follow();
  /// True if nobody is to be released any more: the referee gives away no bats before.
  bool is_settled() const { return inherited_.empty(); }

  void take_over(peer::PeerNumber lost, const peer::Part& part,
                 std::span<const peer::Key> keys) override;
  void seat_again(peer::Session& session, peer::Peer& peer) override;
  void go_back(peer::Session& session, std::span<const peer::Key> pending) override;

 private:
  static constexpr std::size_t early_max = 4096, stand_ins_max = 256;

  /// A lost node's player. Its keys may still come to be felt in the stretch after the loss.
  struct Inherited {
    SeatTable::Seated seated;
    std::uint64_t after = 0;  ///< this stretch
    bool is_released = false;
  };
  std::uint32_t bat_of(std::uint32_t player) const;
  void note_felt();
  static void add_all_own(peer::PartChange& own, const peer::Peer& peer);
  peer::PeerNumber keeper_of(peer::PeerNumber node) const;
  void close(const std::vector<peer::PeerNumber>& lost, std::uint64_t stretch);
  void handle_early();

  Parts parts_;
  Handler handle_;
  std::optional<MatchRecovery> matches_;
  std::deque<std::pair<peer::PeerNumber, std::vector<std::uint8_t>>> early_;
  std::vector<std::pair<peer::PeerNumber, StandIn>> stand_ins_;  ///< with who says it
  std::map<std::uint32_t, KeysHeld> held_;  ///< by bat, by the keys that were felt
  std::vector<Inherited> inherited_;        ///< at the referee
  bool is_anew_ = false;                    ///< since the last loss no window was played
};

}  // namespace rink::game
