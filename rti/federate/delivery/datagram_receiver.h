// Datagrams of the RTI: applied unless something newer is known, acknowledged so that the RTI need
// not send them again.
#pragma once

#include <cstddef>
#include <vector>

#include "rti/federate/ambassador_basis.h"
#include "rti/federate/delivery/link_watch.h"
#include "rti/federate/delivery/update_arrivals.h"
#include "rti/federate/delivery/update_receiver.h"
#include "rti/federate/delivery/update_sender.h"
#include "rti/wire/datagram.h"

namespace rink::rti {

class DatagramReceiver {
 public:
  struct Uses {
    const LinkWatch& watch;
    UpdateArrivals& arrivals;
    UpdateReceiver& updates;
    UpdateSender& sender;
  };
  DatagramReceiver(const AmbassadorBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}

  /// Must be joined. It may speak of objects that a frame on its way tells of: then it waits for
  /// that, and while the gate is closed, for frames are held back too.
  void receive(Bytes datagram, bool is_gate_open);
  /// Frames have come, or the gate has opened.
  void apply_held();
  void advance_clock();
  /// What is to go out, empty if nothing; until it has gone.
  Bytes acknowledgement() const { return acknowledgement_; }
  void clear_acknowledgement() { acknowledgement_.clear(); }
  std::size_t memory_bytes() const { return acknowledgement_.capacity(); }

 private:
  /// Datagrams that wait for their frames; more are lost, and come again.
  static constexpr std::size_t held_max = 256;
  void apply(Bytes datagram);
  bool read(const DatagramHead& head, Reader& reader);
  void acknowledge();

  AmbassadorBasis basis_;
  Uses uses_;
  DatagramReceipts receipts_;
  double due_since_ = 0.0;  ///< the oldest that is to be acknowledged [s]
  std::vector<std::vector<std::byte>> held_;
  std::vector<std::byte> acknowledgement_;
};

}  // namespace rink::rti
