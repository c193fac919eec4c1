// Best-effort updates by datagram from federates: applied unless something newer is known,
// acknowledged so that they need not be sent again.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "rti/central_component.h"
#include "rti/federation/delivery/arrival_orders.h"
#include "rti/federation/delivery/best_effort_sender.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/known_objects.h"
#include "rti/federation/services/newest_stamps.h"
#include "rti/federation/services/transportation_types.h"
#include "rti/federation/services/update_service.h"
#include "rti/ownership/ownership.h"
#include "rti/wire/datagram.h"

namespace rink::rti {

/// No datagram, however malformed, costs its sender the connection.
class BestEffortReceiver {
 public:
  struct Uses {
    const TransportationTypes& types;
    const Ownership& ownership;
    KnownObjects& known;
    NewestStamps& newest;
    ArrivalOrders& arrivals;
    BestEffortSender& sender;
    UpdateService& updates;
  };
  BestEffortReceiver(const FederationBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}

  void receive(std::uint32_t slot, Bytes datagram);
  /// Handles datagrams that waited for a frame that has come.
  void handle_held(std::uint32_t slot);
  /// Acknowledges when many datagrams are due, one is missing, or the first has waited for long
  /// enough.
  void acknowledge(std::uint32_t slot, Outlet& outlet);
  void joined(std::uint32_t slot);
  void left(std::uint32_t slot) { federates_[slot].reset(); }

 private:
  static constexpr std::size_t held_max =
      256;  ///< datagrams that wait for their frames; more are lost, and come again
  struct Received {
    DatagramReceipts receipts;
    double due_since = 0.0;  ///< the first of them [s]
    std::vector<std::vector<std::byte>> held;
  };
  bool admit(std::uint32_t slot, const DatagramHead& head, Bytes datagram);
  bool take(std::uint32_t slot, Bytes datagram);
  bool handle_message(std::uint32_t slot, const DatagramHead& head, std::optional<Stamp>& stamp,
                      Reader& reader);
  bool handle_updates(std::uint32_t slot, const DatagramHead& head, const Stamp& stamp,
                      Reader& reader);
  /// The attributes whose values are newer than the known ones, if the object is of the block's
  /// class.
  AttributeSet accept(std::uint32_t slot, const DatagramHead& head, ObjectSlot object,
                      AttributeSet attributes);

  FederationBasis basis_;
  Uses uses_;
  std::vector<std::unique_ptr<Received>> federates_;  ///< by slot; null until a datagram comes
};

}  // namespace rink::rti
