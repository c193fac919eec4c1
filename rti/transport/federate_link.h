// Carries one federate's bytes between its ambassador and a transport's connection.
#pragma once

#include <vector>

#include "rti/ambassador.h"
#include "rti/transport/transport.h"

namespace rink::rti {

/// Sends the ambassador's waiting bytes as one write, and its datagrams if there is a channel.
void send_waiting(Ambassador& ambassador, Transport& transport, ConnectionId connection);

/// One ambassador on one connection. Many links may share one transport through a `FederateLinks`.
class FederateLink {
 public:
  FederateLink(Ambassador& ambassador, Transport& transport, ConnectionId connection)
      : ambassador_(ambassador), transport_(transport), connection_(connection) {}

  ConnectionId connection() const { return connection_; }
  Ambassador& ambassador() { return ambassador_; }
  bool is_open() const { return is_open_; }  ///< connected and not yet closed
  bool is_finished() const {
    return is_finished_;
  }  ///< closed, or never opened; nothing more will happen
  CloseReason close_reason() const { return close_reason_; }

  /// Handle the transport's events of this connection. Bytes that the ambassador rejects close it.
  void opened() { is_open_ = true; }
  void received(Bytes bytes);
  void received_datagram(Bytes datagram) { ambassador_.receive_datagram(datagram); }
  void closed(CloseReason reason, const std::string& detail);

  /// Advances the ambassador's clock and sends what waits, as one write, once the connection is
  /// open.
  void flush(double now);
  /// Sends what waits and closes.
  void close();

 private:
  Ambassador& ambassador_;
  Transport& transport_;
  ConnectionId connection_;
  bool is_open_ = false, is_finished_ = false;
  CloseReason close_reason_ = CloseReason::closed_by_us;
};

/// The listener of a transport that carries any number of federates, as 500 bots in one process do.
class FederateLinks final : public TransportListener {
 public:
  /// The link must outlive its presence here.
  void add(FederateLink& link);
  void remove(const FederateLink& link);
  void on_open(ConnectionId connection) override;
  void on_bytes(ConnectionId connection, Bytes bytes) override;
  void on_close(ConnectionId connection, CloseReason reason, const std::string& detail) override;
  void on_datagram(ConnectionId connection, Bytes datagram) override;
  /// Flushes every link.
  void flush(double now);

 private:
  FederateLink* find(ConnectionId connection) {
    return connection < links_.size() ? links_[connection] : nullptr;
  }
  std::vector<FederateLink*> links_;  ///< by connection
};

}  // namespace rink::rti
