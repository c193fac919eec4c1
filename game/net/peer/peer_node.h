// One peer with a player: its windows, its player's keys, view and replicas. No clock, no socket;
// time and messages are arguments.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "game/net/peer/interest/shared_interest.h"
#include "game/net/peer/shared_game.h"
#include "game/net/peer/traffic.h"
#include "game/peer/standby/standby_copy.h"
#include "game/peer/standby/standby_feed.h"
#include "game/peer/window_play.h"

namespace rink::game {

/// The keys are those of the shared game, which all know; the player's keys are sent for
/// measurements (SharedInterest).
class PeerNode {
 public:
  using Send = SharedInterest::Send;
  PeerNode(const SharedGame& game, const InterestSettings& settings, const peer::Division& division,
           peer::PeerNumber number, Send send);
  PeerNode(const PeerNode&) = delete;
  PeerNode& operator=(const PeerNode&) = delete;

  /// The own bodies' states at the end of a window are final; and, when all updates of others about
  /// it have come, the whole picture of it is.
  std::function<void()> on_final, on_commit;

  /// The instant of the next window's end has come: it is played now, or as soon as the one before
  /// it is done. Throws peer::ProtocolError, as `receive` does.
  void due();
  /// False for a malformed message.
  bool receive(peer::PeerNumber from, Traffic about, std::vector<std::uint8_t> content);
  /// The own player pressed or released a key.
  void press() { interest_.press(); }

  std::uint32_t windows_final() const { return final_; }
  bool is_idle() const { return !play_.is_playing() && waiting_ == 0; }

  const peer::Peer& peer() const { return *peer_; }
  SharedInterest& interest() { return interest_; }
  const SharedInterest& interest() const { return interest_; }
  /// Bytes sent, each message with its purpose and frame, and messages, by purpose.
  const TrafficBytes& sent() const { return sent_; }
  const TrafficBytes& messages_sent() const { return messages_sent_; }

 private:
  void count_and_send(peer::PeerNumber to, Traffic about, std::vector<std::uint8_t> content);
  void tell_standby();
  bool hear_standby();
  void play_next();
  void finish();
  double end_of(std::uint64_t window) const { return static_cast<double>(window) / rate_hz_; }

  double rate_hz_;
  peer::Division division_;
  Send send_;
  std::unique_ptr<peer::Peer> peer_;
  peer::WindowPlay play_;
  SharedInterest interest_;
  peer::Validator validator_;
  peer::StandbyFeed feed_{peer::StandbyLimits{}};
  peer::StandbyCopy kept_;  ///< of the part of the peer before this one
  std::deque<std::vector<std::uint8_t>>
      unheard_;  ///< what that peer has sent of it since, which may be a window ahead
  std::uint32_t pieces_due_ = 0;  ///< of a snapshot, before the next record
  std::uint32_t begun_ = 0, final_ = 0, committed_ = 0,
                waiting_ = 0;  ///< windows; the last: windows whose end has come and that are not
                               ///< played yet
  TrafficBytes sent_{}, messages_sent_{};
};

}  // namespace rink::game
