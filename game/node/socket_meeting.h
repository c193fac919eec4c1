// Nodes meet over TCP or shared memory.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "game/node/meeting.h"
#include "rti/transport/socket_transport.h"

namespace rink::game {

class SocketMeeting final : public Meeting {
 public:
  /// Listens at `place`, of which port 0 is any free one. The first node sets the terms; another
  /// one asks any node, at `join`. Throws TransportError.
  SocketMeeting(const Place& place, const Terms& terms, const std::string& transport = "tcp");
  SocketMeeting(const Place& place, const Place& join, const std::string& transport = "tcp");

  std::optional<Place> place() const override { return place_; }
  std::unique_ptr<SessionNetwork> enter(PeerNetworkSettings self, double (*now_s)()) override;

 private:
  rti::SocketTransport sockets_;
  Place place_;
  Terms terms_;
  std::optional<Place> join_;
};

}  // namespace rink::game
