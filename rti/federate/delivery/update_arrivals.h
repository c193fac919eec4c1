// Which of two values of an object is newer, when one came in a frame and one in a datagram.
#pragma once

#include <cstddef>
#include <cstdint>

#include "rti/objects/arrival_order.h"
#include "rti/wire/datagram.h"

namespace rink::rti {

/// Counts the frames of the RTI: each datagram carries the number of frames that were sent before
/// it.
class UpdateArrivals {
 public:
  explicit UpdateArrivals(const Fom& fom) : order_(fom) {}

  const ArrivalOrder& order() const { return order_; }
  /// Frames received, from the one that accepted the join, which is the first.
  std::uint32_t frames_received() const { return frames_received_; }
  void count_frame() { ++frames_received_; }
  /// The frame that accepts the join has come.
  void begin() { frames_received_ = 1; }
  /// A datagram may come: from now on the order of frames is noted too.
  void expect_datagrams() { has_datagrams_ = true; }

  void enter(ObjectHandle object, std::uint16_t object_class) {
    order_.enter(object, object_class, order_of_frame(frames_received_));
  }
  void leave(ObjectHandle object) { order_.leave(object); }
  /// Notes values from the present frame, which are newer than any before.
  void note_from_frame(ObjectHandle object, std::uint16_t object_class, AttributeSet attributes) {
    if (has_datagrams_)
      order_.accept(object, object_class, attributes, order_of_frame(frames_received_));
  }
  /// The attributes whose values are not older than the known ones.
  AttributeSet accept(ObjectHandle object, std::uint16_t object_class, AttributeSet attributes,
                      const DatagramHead& head) {
    return order_.accept(object, object_class, attributes, order_of_datagram(head));
  }
  std::size_t memory_bytes() const { return order_.memory_bytes(); }

 private:
  ArrivalOrder order_;
  std::uint32_t frames_received_ = 0;
  bool has_datagrams_ = false;
};

}  // namespace rink::rti
