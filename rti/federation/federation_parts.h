// What a federation execution is made of; for its own sources only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rti/buffering/buffering.h"
#include "rti/central_component.h"
#include "rti/federation/delivery/best_effort_receiver.h"
#include "rti/federation/delivery/sender.h"
#include "rti/federation/federate_table.h"
#include "rti/federation/federation_connection.h"
#include "rti/federation/joined_federate.h"
#include "rti/federation/management/federation_census.h"
#include "rti/federation/management/management_interactions.h"
#include "rti/federation/management/management_objects.h"
#include "rti/federation/outcome.h"
#include "rti/federation/services/declarations.h"
#include "rti/federation/services/interactions.h"
#include "rti/federation/services/object_names.h"
#include "rti/federation/services/object_service.h"
#include "rti/federation/services/ownership_service.h"
#include "rti/federation/services/publications.h"
#include "rti/federation/services/region_service.h"
#include "rti/federation/services/synchronization.h"
#include "rti/federation/services/time_service.h"
#include "rti/federation/services/update_requests.h"
#include "rti/federation_counters.h"
#include "rti/federation_services.h"
#include "rti/federation_settings.h"
#include "rti/management/federation_report.h"
#include "rti/management/management_handles.h"
#include "rti/objects/object_map.h"
#include "rti/objects/object_table.h"
#include "rti/ownership/ownership.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/message.h"
#include "rti/wire/object_messages.h"
#include "rti/wire/ownership_messages.h"

namespace rink::rti {

class FederationParts {
 public:
  FederationParts(const Fom& fom, const FederationSettings& settings,
                  const FederationServices& services, std::unique_ptr<im::Filter> filter);
  ~FederationParts();

  using Federate = JoinedFederate;
  using Connection = FederationConnection;
  using Phase = Connection::Phase;

  // Connections and membership (federation_membership.cpp).
  void connect(ConnectionId connection);
  void disconnect(ConnectionId connection, std::string_view why);
  void advance_clock(double now);
  Outcome join(ConnectionId connection, Reader& reader);
  void refuse(ConnectionId connection, Refusal refusal) {
    refuse(connection, refusal, to_string(refusal));
  }
  void refuse(ConnectionId connection, Refusal refusal, const std::string& why);
  std::vector<std::byte> framed_digest() const;
  void admit(ConnectionId connection, const JoinMessage& message);
  void remove_federate(std::uint32_t slot, ResignReason reason);
  void expel(ConnectionId connection, Violation violation, ResignReason reason,
             std::string_view why);
  Outcome resign(std::uint32_t slot);
  Outcome watch(Federate& federate);
  void subscribed(std::uint32_t slot);
  Expulsion expulsion();

  // Federation management (federation_management.cpp).
  Outcome answer_stranger(ConnectionId connection, MessageKind kind, Reader& reader);
  template <class Message>
  void answer(ConnectionId connection, Message message);
  Outcome query_management(ConnectionId connection);
  void send_answers(Outlet& outlet);
  FederationReport report(const Outlet* outlet) const;
  void answer_queries(Outlet& outlet);

  // What a federate says (federation_receive.cpp).
  void receive(ConnectionId connection, Bytes bytes);
  void receive_datagram(ConnectionId connection, Bytes datagram);
  Outcome take_frame(ConnectionId connection, Bytes frame);

  // What goes out (federation_flush.cpp).
  void flush(Outlet& outlet);

  template <class Message>
  static void say(std::vector<std::byte>& bytes, Message message) {
    write(bytes, message);
  }

  const Fom& fom_;
  FederationSettings settings_;
  FederationCounters counters_;
  double now_ = 0.0;
  FederateTable federates_;
  Publications publications_;
  ObjectNames names_;
  Synchronization synchronization_{federates_};
  ObjectTable objects_;
  Ownership ownership_;
  std::unique_ptr<DataDistribution> distribution_;
  DataDistribution& interest_;  ///< the same
  std::unique_ptr<Buffering> buffering_;
  FederationBasis basis_{fom_, settings_, federates_, objects_, counters_, now_};
  KnownObjects known_;
  NewestStamps newest_;
  ArrivalOrders arrivals_;
  TransportationTypes transportation_;
  BestEffortSender best_effort_sender_;
  UpdateService updates_;
  BestEffortReceiver best_effort_receiver_;
  std::unique_ptr<GroupCommunication> groups_;
  Interactions interactions_;
  UpdateRequests update_requests_;
  ObjectService object_service_;
  RegionService regions_;
  OwnershipService owners_;
  Declarations declarations_;
  Announcements announcements_;
  PeriodicWriter periodic_;
  TurnWriter turns_;
  Sender sender_;
  TimeService time_;
  ManagementHandles management_;
  ManagementObjects management_objects_;
  ManagementInteractions management_interactions_;
  FederationCensus census_;
  std::vector<Connection> connections_;           ///< by id
  std::vector<ConnectionId> management_queries_;  ///< that wait for the next flush
  std::vector<Farewell> farewells_,
      answers_;  ///< answers go to those who have not joined, and don't end their connection
};

}  // namespace rink::rti
