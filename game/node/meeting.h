// How a node meets the others of its session: the one place that knows what carries their messages.
#pragma once

#include <memory>
#include <optional>

#include "game/net/peer/network/session_network.h"

namespace rink::game {

class Meeting {
 public:
  virtual ~Meeting() = default;
  /// Where others reach this node, if that is a place.
  virtual std::optional<Place> place() const { return std::nullopt; }
  /// Whether others can go on when a node is lost.
  virtual bool survives_losses() const { return true; }
  /// Asks to be a member of the session, with `self` but for its place; returns the network, whose
  /// number and terms are known then. The network must not outlive this. Throws SessionError.
  virtual std::unique_ptr<SessionNetwork> enter(PeerNetworkSettings self, double (*now_s)()) = 0;
};

}  // namespace rink::game
