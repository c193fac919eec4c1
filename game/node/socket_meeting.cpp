// Listens, and founds or joins a session.
#include "game/node/socket_meeting.h"

#include "game/net/peer/network/peer_network.h"

namespace rink::game {

SocketMeeting::SocketMeeting(const Place& place, const Terms& terms, const std::string& transport)
    : sockets_(transport), place_(place), terms_(terms) {
  place_.port = sockets_.listen(place.address, place.port);
}

SocketMeeting::SocketMeeting(const Place& place, const Place& join, const std::string& transport)
    : sockets_(transport), place_(place), join_(join) {
  place_.port = sockets_.listen(place.address, place.port);
}

std::unique_ptr<SessionNetwork> SocketMeeting::enter(PeerNetworkSettings self, double (*now_s)()) {
  self.self.place = place_;
  auto network = std::make_unique<PeerNetwork>(sockets_, self, now_s);
  if (join_) network->join(*join_);
  else network->found(terms_);
  return network;
}

}  // namespace rink::game
