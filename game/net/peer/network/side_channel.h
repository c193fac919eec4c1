// A channel for messages between peers beside the protocol's mail, for which no peer waits.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "game/peer/protocol.h"

namespace rink::game {

/// Messages arrive whole and in order with the mail: a side message sent before a mail arrives
/// before it.
class SideChannel {
 public:
  virtual ~SideChannel() = default;
  /// Without effect if the receiver is gone.
  virtual void send_aside(peer::PeerNumber to, std::vector<std::uint8_t> bytes) = 0;
  /// How often its user has gone back after a loss, by which it tells what others said before that.
  std::uint16_t recoveries = 0;
  /// Called while the peer waits for mail; messages wait while it is empty. False for a message
  /// that no peer sends: its sender is dropped.
  std::function<bool(peer::PeerNumber from, std::vector<std::uint8_t> bytes)> receive_aside;
  /// If not empty, called before each wait, also for mail: does what is due, and returns when it
  /// must be called again [s of the clock].
  std::function<double()> before_wait;
};

}  // namespace rink::game
