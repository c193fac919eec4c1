// Best-effort updates by datagram, where a federate has a channel for them: what is sent, what was
// lost, and falling back to the stream.
#pragma once

#include <cstdint>
#include <vector>

#include "rti/buffering/buffering.h"
#include "rti/buffering/datagram_batch.h"
#include "rti/central_component.h"
#include "rti/federation/delivery/flush_context.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/transportation_types.h"

namespace rink::rti {

class BestEffortSender {
 public:
  BestEffortSender(const FederationBasis& basis, const TransportationTypes& types,
                   Buffering& buffering)
      : basis_(basis), types_(types), buffering_(buffering) {}
  /// The federates' channels end with it, since they refer to its lists of what was sent.
  ~BestEffortSender() {
    for (JoinedFederate& each : basis_.federates) each.channel.reset();
  }
  BestEffortSender(const BestEffortSender&) = delete;
  BestEffortSender& operator=(const BestEffortSender&) = delete;

  /// Adds an update to the next flush, in two parts where some attributes travel by datagram and
  /// others do not.
  void append(const ObjectUpdate& update);
  /// False if it acknowledges a datagram that was never sent.
  bool acknowledge(std::uint32_t slot, Reader& reader);

  void begin_flush() { batch_.begin_tick(); }
  /// The federate's datagram channel in this flush, null if it has none.
  DatagramPath begin(JoinedFederate& federate, Outlet& outlet);
  /// Adds a state that was lost; false if it does not travel by datagram.
  bool add(const FlushContext& context, ObjectSlot object, AttributeSet set, const Stamp& stamp,
           Bytes values);
  /// Adds run number `index` of the flush; false if it does not travel by datagram.
  bool gather(std::size_t index, FlushContext& context);
  void send(FlushContext& context, Outlet& outlet);

 private:
  void append_apart(const ObjectUpdate& update);
  bool is_usable(JoinedFederate& federate, bool is_open, Outlet& outlet);
  void probe(JoinedFederate& federate, Outlet& outlet);

  FederationBasis basis_;
  const TransportationTypes& types_;
  Buffering& buffering_;
  bool has_channels_ = false;  ///< some federate had one
  DatagramBatch batch_;
  std::vector<std::byte> values_;  ///< of one record
};

}  // namespace rink::rti
