// Connections from their first bytes to their end: frames of federates are forwarded, requests of
// unjoined connections answered.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "rti/central_component.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/federation_connection.h"
#include "rti/federation/management/federation_census.h"
#include "rti/federation/membership.h"
#include "rti/federation/status.h"
#include "rti/management/federation_report.h"

namespace rink::rti {

/// The federation as its connections see it.
class FrameHandler {
 public:
  virtual ~FrameHandler() = default;
  /// Admits a federate and returns its slot.
  virtual std::uint32_t admit(ConnectionId connection, const JoinMessage& message) = 0;
  virtual void remove(std::uint32_t slot, ResignReason reason) = 0;
  /// A frame of a federate that has joined: its beginning, each message, and its end.
  virtual void begin_frame(std::uint32_t slot) = 0;
  virtual Status handle_message(std::uint32_t slot, Reader& reader) = 0;
  virtual void end_frame(std::uint32_t slot) = 0;
  virtual void handle_datagram(std::uint32_t slot, Bytes datagram) = 0;
};

class Connections {
 public:
  Connections(const FederationBasis& basis, const Membership& membership,
              const FederationCensus& census, FrameHandler& handler)
      : basis_(basis), membership_(membership), census_(census), handler_(handler) {}

  void connect(ConnectionId id);
  void disconnect(ConnectionId id);
  std::optional<ConnectionId> oldest_stranger(const CentralComponent::ConnectionTest& test) const;
  void receive(ConnectionId id, Bytes bytes);
  void receive_datagram(ConnectionId id, Bytes datagram);
  /// Drops connections that have been silent for too long; see CentralComponent.
  void advance_clock(bool is_behind);
  void expel(ConnectionId id, Violation violation, ResignReason reason, std::string_view why);
  Status resign(ConnectionId id);
  /// Takes all of `former`, whose federates have the slots that `slots` gives for their present
  /// ones.
  void take_over(Connections& former, const std::vector<std::uint32_t>& slots);
  /// The next flush answers.
  Status query_report(ConnectionId id);
  FederationReport report(const Outlet* outlet) const;

  /// Answers to unjoined connections are sent at once, reports to federates by their outboxes.
  void send_answers(Outlet& outlet);
  void close_pending(Outlet& outlet);

 private:
  using Phase = FederationConnection::Phase;
  bool is_joined(ConnectionId id) const { return connections_[id].phase == Phase::joined; }
  bool is_unknown(ConnectionId id) const {
    return id >= connections_.size() || connections_[id].phase == Phase::unknown;
  }
  void forget_words(ConnectionId id);
  void punish(ConnectionId id, Framing framing, const Status& status);
  Status handle_frame(ConnectionId id, Bytes frame);
  Status handle_message(ConnectionId id, Reader& reader);
  Status join(ConnectionId id, Reader& reader);
  void refuse(ConnectionId id, const Membership::Objection& objection);
  std::vector<std::byte> framed_digest() const;
  Status answer_unjoined(ConnectionId id, MessageKind kind, Reader& reader);
  template <class Message>
  Status answer(ConnectionId id, Message message);
  Status list_executions(ConnectionId id);
  void send_reports(Outlet& outlet);

  FederationBasis basis_;
  std::optional<double> advanced_s_;  ///< when `advance_clock` was called last
  const Membership& membership_;
  const FederationCensus census_;
  FrameHandler& handler_;
  std::vector<FederationConnection> connections_;  ///< by id
  std::vector<ConnectionId> report_queries_;       ///< that wait for the next flush
  std::vector<PendingClose> pending_closes_,
      answers_;  ///< answers go to unjoined connections, which stay open
};

}  // namespace rink::rti
