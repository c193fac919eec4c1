// Words between peers beside the protocol's mail, which nobody waits for.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "game/peer/protocol.h"

namespace rink::game {

/// They go whole and in order, with the mail: what was said aside before a message was sent is
/// heard before that message is.
class SideChannel {
 public:
  virtual ~SideChannel() = default;
  /// To one who is gone: does nothing.
  virtual void send_aside(peer::PeerNumber to, std::vector<std::uint8_t> bytes) = 0;
  /// Called while the mail is waited for; what comes as long as it is empty waits. False for what
  /// no peer says: its sender is given up.
  std::function<bool(peer::PeerNumber from, std::vector<std::uint8_t> bytes)> receive_aside;
};

}  // namespace rink::game
