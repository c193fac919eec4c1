// Which of two updates of a federate was sent later, where one came by its stream and the other by
// a datagram.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <vector>

#include "rti/objects/arrival_order.h"

namespace rink::rti {

/// Kept for federates that have sent a datagram; of others only the frames are counted.
class ArrivalOrders {
 public:
  explicit ArrivalOrders(const Fom& fom) : fom_(fom) {}

  void joined(std::uint32_t slot) {
    if (slot >= federates_.size()) federates_.resize(slot + 1);
    federates_[slot] = {};
  }
  void left(std::uint32_t slot) { federates_[slot] = {}; }
  void count_frame(std::uint32_t slot) {
    assert(slot < federates_.size());
    ++federates_[slot].frames;
  }
  /// Frames received after the one that asked to join.
  std::uint32_t frames_received(std::uint32_t slot) const { return federates_[slot].frames; }

  /// The federate's first datagram has come. The order of what came before is not known, so an
  /// older datagram is treated as lost.
  void begin(std::uint32_t slot) {
    if (is_kept(slot)) return;
    federates_[slot].orders = std::make_unique<ArrivalOrder>(fom_);
    federates_[slot].first_frames = federates_[slot].frames;
  }
  bool is_kept(std::uint32_t slot) const { return federates_[slot].orders != nullptr; }
  /// The number of frames that had come when the first datagram did.
  std::uint32_t first_frames(std::uint32_t slot) const { return federates_[slot].first_frames; }

  /// The stream has just brought values of `set`.
  void accept_frame(std::uint32_t slot, ObjectHandle object, std::uint16_t object_class,
                    AttributeSet set) {
    if (is_kept(slot))
      accept(slot, object, object_class, set, order_of_frame(federates_[slot].frames));
  }
  /// The attributes of `set` whose values, at a datagram's `order`, are not older than the known
  /// ones.
  AttributeSet accept(std::uint32_t slot, ObjectHandle object, std::uint16_t object_class,
                      AttributeSet set, std::uint64_t order) {
    assert(is_kept(slot));
    ArrivalOrder& orders = *federates_[slot].orders;
    if (!orders.contains(object))
      orders.enter(object, object_class, order_of_frame(federates_[slot].first_frames));
    return orders.accept(object, object_class, set, order);
  }
  void forget(ObjectHandle object) {
    for (Arrivals& each : federates_)
      if (each.orders) each.orders->leave(object);
  }

 private:
  struct Arrivals {
    std::uint32_t frames = 0, first_frames = 0;
    std::unique_ptr<ArrivalOrder> orders;  ///< of the objects that it has updated since; null
                                           ///< until a datagram of its comes
  };
  const Fom& fom_;
  std::vector<Arrivals> federates_;  ///< by slot
};

}  // namespace rink::rti
