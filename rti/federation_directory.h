// Several federation executions in one central component: they are created, listed and destroyed by
// name, and each connection is routed to the one that it joins.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rti/federation_execution.h"
#include "rti/pre_join_limits.h"
#include "rti/wire/silence.h"

namespace rink::rti {

struct DirectorySettings {
  FederationSettings federation;   ///< of every execution; the name is replaced
  FederationServices services;     ///< of every execution: its replaceable parts
  std::size_t execution_max = 64;  ///< that exist at once
};

/// A host of one fixed federation uses a `FederationExecution` instead and pays nothing for this.
/// Here a federate pays one look-up per batch of bytes. Executions are independent of each other:
/// several may have federates, handles and objects of equal names.
class FederationDirectory final : public CentralComponent {
 public:
  explicit FederationDirectory(DirectorySettings settings = {});
  ~FederationDirectory() override;

  /// Executions may be created with this object model from now on; it must outlive the directory. A
  /// federate names it by its hash.
  void offer(const Fom& fom);
  /// The services that federates request; the host itself may call them too.
  /// FederationExecutionAlreadyExists, CouldNotOpenFDD if no such model is offered, IllegalName for
  /// an empty name, RTIinternalError beyond `execution_max`.
  HlaError create(std::string_view federation, std::uint64_t fom_hash);
  /// FederationExecutionDoesNotExist, FederatesCurrentlyJoined. The name is free at once.
  HlaError destroy(std::string_view federation);
  /// In the order of creation.
  std::vector<FederationExecutionInformation> list() const;
  /// Null if there is none of that name. Valid until it is destroyed and flushed.
  FederationExecution* find(std::string_view federation) const;

  void connect(ConnectionId connection) override;
  void receive(ConnectionId connection, Bytes bytes) override;
  void receive_datagram(ConnectionId connection, Bytes datagram) override;
  void disconnect(ConnectionId connection, std::string_view why) override;
  std::optional<ConnectionId> oldest_stranger(const ConnectionTest& test) const override;
  void advance_clock(double now, bool is_behind) override;
  using CentralComponent::advance_clock;
  void match() override;
  void flush(Outlet& outlet) override;

  /// Connections dropped here, before they were routed to any execution.
  std::uint64_t drops() const { return drops_; }

 private:
  class JoinRouter;
  struct Connection {
    bool is_connected = false;
    FederationExecution* execution = nullptr;  ///< null until it asks to join one
    std::vector<std::byte> waiting;            ///< bytes received before that which are no whole
                                               ///< frame
    double since = 0.0;                        ///< when it was made [s]
    Silence silence;
    PreJoinLimits limits;
  };
  struct Answer {
    ConnectionId connection;
    std::vector<std::byte> bytes;
    bool is_last = false;
  };
  bool handle_waiting(ConnectionId id);
  bool handle_frame(ConnectionId id, Bytes frame);
  bool lead(ConnectionId id, Bytes frame);
  void refuse(ConnectionId id, Refusal refusal, const std::string& why);
  void drop(ConnectionId id);
  void answer_queries(Outlet& outlet);
  template <class Message>
  void answer(ConnectionId id, Message message);

  DirectorySettings settings_;
  std::vector<const Fom*> models_;
  std::vector<std::unique_ptr<FederationExecution>> executions_, destroyed_;
  std::vector<Connection> connections_;  ///< by id
  std::vector<Answer> answers_;
  std::vector<ConnectionId> management_queries_;  ///< that wait for the next flush
  std::uint64_t drops_ = 0;
  double now_ = 0.0;
};

}  // namespace rink::rti
