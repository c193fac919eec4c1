// What a federation execution keeps of one federate's best-effort updates by datagram.
#pragma once

#include <cstdint>
#include <vector>

#include "rti/objects/arrival_order.h"
#include "rti/wire/datagram.h"

namespace rink::rti {

/// Made by its first datagram.
struct UpwardWay {
  static constexpr std::size_t held_max =
      256;  ///< datagrams that wait for their frames; more are lost, and come again
  UpwardWay(const Fom& fom, std::uint32_t frames) : arrivals(fom), first_frames(frames) {}

  ArrivalOrder arrivals;       ///< of the objects that it has updated since
  std::uint32_t first_frames;  ///< frames that had come by then: of what was said before nothing is
                               ///< known, so an older datagram is as good as lost
  DatagramReceipts receipts;
  double due_since = 0.0;  ///< the first of them [s]
  std::vector<std::vector<std::byte>> held;

  /// Those of `set` that are not older than what is known.
  AttributeSet accept(ObjectHandle object, std::uint16_t object_class, AttributeSet set,
                      std::uint64_t order) {
    if (!arrivals.contains(object))
      arrivals.enter(object, object_class, order_of_frame(first_frames));
    return arrivals.accept(object, object_class, set, order);
  }
};

}  // namespace rink::rti
