// Watches what passes between a host of federates and its transport, and keeps a ledger of it.
#pragma once

#include <memory>
#include <vector>

#include "rti/ledger/conversation_fields.h"
#include "rti/transport/staged/staged_transport.h"

namespace rink::rti {

/// Changes nothing. As the lowest stage it counts the very bytes that the transport counts as
/// payload, sent when they are given to it. A transport without it pays nothing.
class LedgerStage final : public TransportStage {
 public:
  /// `fom` must outlive it. `make_content` reads what the host itself sends to one federate; null
  /// if nobody can.
  explicit LedgerStage(const Fom& fom, MakeHostContent make_content = nullptr);

  void send(ConnectionId connection, std::span<const Bytes> parts) override;
  void send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) override;
  void close(ConnectionId connection) override;

  /// All rows so far. Their sum is the payload: a row `unfinished` has what waits to be a frame.
  std::vector<LedgerRow> rows() const;

 private:
  struct Conversation {
    ConversationFields down, up;
  };
  void on_open(ConnectionId connection) override;
  void on_bytes(ConnectionId connection, Bytes bytes) override;
  void on_datagram(ConnectionId connection, Bytes datagram) override;
  void on_close(ConnectionId connection, CloseReason reason, const std::string& detail) override;
  Conversation* find(ConnectionId connection) {
    return connection < conversations_.size() ? conversations_[connection].get() : nullptr;
  }
  void end(ConnectionId connection);

  const Fom& fom_;
  ResidualModel residuals_;
  MakeHostContent make_content_;
  ByteLedger ledger_;
  std::vector<std::unique_ptr<Conversation>> conversations_;  ///< null once closed
  std::vector<std::byte> datagram_;
};

}  // namespace rink::rti
