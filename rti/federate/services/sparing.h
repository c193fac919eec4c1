// Keeps updates back to which nobody subscribes (docs/rti.md, "Nobody listens").
#pragma once

#include <cstddef>
#include <vector>

#include "rti/federate/ambassador_basis.h"
#include "rti/federate/delivery/callback_gate.h"
#include "rti/federate/delivery/update_sender.h"
#include "rti/objects/spared_values.h"

namespace rink::rti {

/// The newest of the kept values are sent as soon as another federate subscribes.
class Sparing {
 public:
  struct Uses {
    const DeclaredClasses& classes;
    const OwnershipBook& ownership;
    const CallbackGate& gate;
    SentUpdates& sent;
    UpdateSender& sender;
  };
  Sparing(const AmbassadorBasis& basis, const Uses& uses)
      : basis_(basis), uses_(uses), values_(basis.fom) {}

  /// Call it before each update: false if others subscribe to all of it and nothing of it is kept
  /// back, so nothing else is needed.
  bool concerns(ObjectClassHandle object_class, AttributeSet attributes) const {
    return (attributes & uses_.classes.subscribed(object_class)).is_empty() ||
           !(attributes & values_.in_class(object_class)).is_empty();
  }
  /// False if the update must be sent, which makes values kept back of it out of date. `values` are
  /// as the federate gave them.
  bool spares(const UpdateHeader& header, ObjectHandle object, bool is_own, Bytes values);
  bool spares(InteractionClassHandle interaction_class);
  /// Sends what was kept back of an object, of `subscribed` attributes of a class, or of all: the
  /// newest state with the newest stamp.
  void release(ObjectHandle object);
  void release(ObjectClassHandle object_class, AttributeSet subscribed);
  void release_all() { release(ObjectClassHandle{}, AttributeSet::all()); }
  /// While bytes wait unread, news of a subscriber would wait too.
  void gate_closed() {
    if (!may_spare()) release_all();
  }
  void forget(ObjectHandle object) { values_.forget(object); }
  void forget_all() {
    for (const ObjectHandle each : values_.list({}, AttributeSet::all())) values_.forget(each);
  }
  std::size_t memory_bytes() const { return values_.memory_bytes() + coded_.capacity(); }

 private:
  bool may_spare() const;

  AmbassadorBasis basis_;
  Uses uses_;
  SparedValues values_;
  std::vector<std::byte> coded_;  ///< of the values that are being released
};

}  // namespace rink::rti
