// The parts of a federation execution; for its own sources only.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "rti/federation/connections.h"
#include "rti/federation/delivery/announcements.h"
#include "rti/federation/delivery/periodic_writer.h"
#include "rti/federation/delivery/residual_writer.h"
#include "rti/federation/delivery/sender.h"
#include "rti/federation/delivery/turn_writer.h"
#include "rti/federation/delivery/update_rates.h"
#include "rti/federation/expulsion.h"
#include "rti/federation/federation_ground.h"
#include "rti/federation/management/federation_census.h"
#include "rti/federation/management/management_interactions.h"
#include "rti/federation/management/management_objects.h"
#include "rti/federation/membership.h"
#include "rti/federation/services/declarations.h"
#include "rti/federation/services/interactions.h"
#include "rti/federation/services/object_services.h"
#include "rti/federation/services/ownership_service.h"
#include "rti/federation/services/region_service.h"
#include "rti/federation/services/synchronization.h"
#include "rti/federation/time/time_service.h"
#include "rti/save/save_service.h"

namespace rink::rti {

/// Owns the services, each of which sees only those above it, and has the sequences whose order
/// shows on the wire: the steps when a federate leaves, and those of a flush.
class FederationParts final : private FrameHandler {
 public:
  FederationParts(const Fom& fom, const FederationSettings& settings,
                  const FederationServices& services, std::unique_ptr<im::Filter> filter);
  /// Takes the connections of a federation whose federates have restored themselves as this one's.
  /// It is fit for nothing but its destruction then.
  void take_over(FederationParts& former);
  void advance_clock(double now, bool is_behind);
  void match();
  void flush(Outlet& outlet);
  /// The federate is updated at `rate` from now on, with all in its scope anew at its next turn.
  void set_update_rate(std::uint32_t slot, UpdateRate rate);
  /// The federate's subscriptions have changed: notifies publishers at once, and the RTI's own
  /// objects, which get their handles now.
  void subscriptions_changed(std::uint32_t slot);
  /// Delivers an interaction that was read; one for the RTI is answered before it reaches others.
  /// `regions` are the sender's; if there are none, it has the default region, which overlaps all.
  Status send(std::uint32_t slot, InteractionMessage& message,
              std::span<const RegionHandle> regions);

  FederationGround ground;
  ObjectServices objects;
  Interactions interactions;
  RegionService regions;
  Synchronization synchronization;
  OwnershipService owners;
  Declarations declarations;
  Announcements announcements;
  PeriodicWriter periodic;
  TurnWriter turns;
  ResidualWriter residuals;
  EntryWriter entries;
  UpdateRates rates;
  Sender sender;
  TimeService time;
  ManagementObjects management_objects;
  ManagementInteractions management_interactions;
  Membership membership;
  SaveService saves;
  Connections connections;

 private:
  Expulsion expulsion();
  std::uint32_t admit(ConnectionId connection, const JoinMessage& message) override;
  void remove(std::uint32_t slot, ResignReason reason) override;
  void begin_frame(std::uint32_t slot) override;
  Status handle_message(std::uint32_t slot, Reader& reader) override;  ///< message_table.cpp
  void end_frame(std::uint32_t slot) override { objects.receiver.handle_held(slot); }
  /// A datagram that is older than the restore would bring back what was undone.
  void handle_datagram(std::uint32_t slot, Bytes datagram) override {
    if (!ground.federates[slot].was_restored) objects.receiver.receive(slot, datagram);
  }
};

}  // namespace rink::rti
