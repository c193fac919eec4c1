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

  /// The federate must be joined. A datagram that names objects of a frame still on its way waits
  /// for the frame; it also waits while the gate is closed, since frames are held back too.
  void receive(Bytes datagram, bool is_gate_open);
  /// Frames have come, or the gate has opened.
  void apply_held();
  void advance_clock();
  /// The acknowledgement to send, empty if none; valid until it is cleared.
  Bytes acknowledgement() const { return acknowledgement_; }
  void clear_acknowledgement() { acknowledgement_.clear(); }
  std::size_t memory_bytes() const { return acknowledgement_.capacity(); }

 private:
  /// The most datagrams that wait for their frames; others are dropped, and sent again.
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
