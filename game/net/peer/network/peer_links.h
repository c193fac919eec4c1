// A peer's connections, the frames on their way out of it, and what was sent and dismissed.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "game/net/peer/network/peer_link.h"
#include "rti/transport/socket_transport.h"

namespace rink::game {

/// At most one connection is the peer's of a number; others are strangers', or of who asks.
class PeerLinks {
 public:
  using Links = std::map<rti::ConnectionId, PeerLink>;

  /// `sockets` outlive it.
  PeerLinks(rti::SocketTransport& sockets, double (*now_s)());

  Links& all() { return links_; }
  /// Null if there is none, or none any more.
  PeerLink* find(rti::ConnectionId connection);
  PeerLink* at(peer::PeerNumber number);
  const PeerLink* at(peer::PeerNumber number) const;
  /// True if peers 0 to `count` - 1 but `own` are connected.
  bool are_open(peer::PeerNumber count, peer::PeerNumber own) const;

  rti::ConnectionId dial(const PeerInfo& info, LinkRole role);
  /// The transport has opened the connection. One that was not dialled is a stranger's, and is
  /// dismissed where there are too many of them.
  void open(rti::ConnectionId connection);
  /// The bytes wait in the connection's frames. A connection of nobody's for which too many wait is
  /// dismissed.
  void add(rti::ConnectionId connection, rti::Bytes bytes);
  /// The connection is the peer's of this number from now on, and carries what waited for it.
  void identify(rti::ConnectionId connection, peer::PeerNumber number, const PeerInfo& info);
  /// Nobody is the peer of this number any more.
  void release(peer::PeerNumber number);

  /// Without effect on a closed connection.
  void send(rti::ConnectionId connection, FrameKind kind, const std::vector<std::uint8_t>& content);
  /// False if no connection is the peer's of this number.
  bool send_to(peer::PeerNumber number, FrameKind kind, const std::vector<std::uint8_t>& content);
  /// Mail for a peer that will connect, sent by `identify`.
  void keep_for(peer::PeerNumber number, std::vector<std::uint8_t> mail);
  /// Gives the transport as much as it takes.
  void push_all();
  bool is_sending() const;
  /// True if bytes wait here or in the transport for a connection that can still send them.
  bool has_unsent() const;
  /// A sign of life to each peer that was sent nothing for a quarter of its patience.
  void show_signs(double patience_s);

  /// The transport has closed the connection. It stays known if it was a peer's, or a stranger's
  /// whose greeting came early: that loss is reported when the peer is expected.
  void note_close(rti::ConnectionId connection);
  /// The connection stays known, and is neither read nor written any more.
  void close(rti::ConnectionId connection);
  void close_peer(peer::PeerNumber number) { close(peers_.at(number).value()); }
  /// The connection is known no more.
  void forget(rti::ConnectionId connection);
  /// As `forget`, and counts.
  void dismiss(rti::ConnectionId connection);
  void refuse(rti::ConnectionId connection, RefusalKind kind, const std::string& reason);
  /// Dismisses strangers without a message for some seconds, and those that `patience_s` has not
  /// made peers of though they introduced themselves.
  void dismiss_idle(double patience_s);
  /// Closes and forgets all.
  void abandon();

  std::uint64_t dismissed() const { return dismissed_; }
  std::uint64_t bytes_sent() const { return bytes_sent_; }  ///< of all frames to peers
  /// Of the connection that is the peer's of this number; zero if there is none.
  rti::TransportCounters counters_of(peer::PeerNumber number) const;

 private:
  void push(rti::ConnectionId connection, PeerLink& link);

  rti::SocketTransport& sockets_;
  double (*now_s_)();
  Links links_;
  std::vector<std::optional<rti::ConnectionId>> peers_;  ///< by number
  std::map<peer::PeerNumber, std::vector<std::vector<std::uint8_t>>> waiting_mail_;
  std::uint64_t dismissed_ = 0, bytes_sent_ = 0;
};

}  // namespace rink::game
